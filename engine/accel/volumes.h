#pragma once

#include "engine/accel/ray_queries.h"

#include <vector>

namespace lightwell {

/// The volumes of a scene that surfaces bound without being seen: antimatter and haze.
class Volumes {
public:
    static constexpr std::size_t most = 32;
    /// @throws InputError for more than 32 materials of these kinds
    explicit Volumes(const Scene& scene);

    bool any() const noexcept { return !materials_.empty(); }
    /// Whether surfaces of this modifier bound a volume.
    bool bounds(ModifierId id) const noexcept { return id != void_modifier && volume_of(id) >= 0; }
    /// Whether a ray that is in these volumes does not see surfaces of this modifier.
    bool erased(const InVolumes& in, ModifierId id) const noexcept
    {
        return in.inside != 0 && id != void_modifier && (in.inside & erased_by_[static_cast<std::size_t>(id)]) != 0;
    }
    /// Where a ray is behind a surface that bounds a volume, or that is erased.
    InVolumes behind(InVolumes in, ModifierId id, bool entering) const noexcept;
    /// What an erased body shows where it is cut by the volume that a ray leaves; void: nothing.
    ModifierId cut_face(const InVolumes& in, ModifierId boundary, bool entering) const noexcept;

    /// Haze along a ray: what the volumes that it is in add up to.
    struct Haze {
        Spectrum extinction_per_m, scattering_per_m;
        double eccentricity = 0; ///< mean of those that scatter
        bool thick() const noexcept { return !extinction_per_m.is_black(); }
    };
    Haze haze(const InVolumes& in) const noexcept;

private:
    int volume_of(ModifierId id) const noexcept { return volumes_[static_cast<std::size_t>(id)]; }

    std::vector<const Material*> materials_; ///< by volume
    std::vector<int> volumes_;               ///< by modifier; -1: none
    std::vector<std::uint32_t> erased_by_;   ///< by modifier: volumes
    std::vector<ModifierId> cut_faces_;      ///< by volume
};

/// Share of light left after so much haze.
Spectrum left_by_haze(const Spectrum& extinction_per_m, double length_m) noexcept;

} // namespace lightwell
