#pragma once

#include "engine/sampling/warps.h"

#include <string>
#include <vector>

namespace lightwell {

/// A hemisphere cut into rings of equal patches; the first patch of a ring is centred on azimuth 0.
class AngleBasis {
public:
    struct Ring {
        double lower_deg = 0, upper_deg = 0;
        int patches = 1;
    };
    /// @throws InputError for rings that do not cover 0 to 90 degrees, one after the other
    AngleBasis(std::string name, std::vector<Ring> rings, const std::string& place);
    /// Klems' bases of 145, 73 and 41 patches; nullptr for another name.
    static const AngleBasis* known(const std::string& name);

    const std::string& name() const noexcept { return name_; }
    int size() const noexcept { return size_; }
    /// The patch around a projected direction.
    int patch_at(const DiscPoint& p) const noexcept;
    /// Projected solid angle, sr.
    double projected_sr(int patch) const noexcept;
    /// A direction, even over the projected patch.
    DiscPoint within(int patch, UnitSquare u) const noexcept;

private:
    struct Band {
        double lower = 0, upper = 0; ///< squared sines
        int patches = 1, first = 0;
    };
    const Band& band_of(int patch) const noexcept;

    std::string name_;
    std::vector<Band> bands_;
    int size_ = 0;
};

} // namespace lightwell
