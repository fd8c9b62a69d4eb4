#pragma once

#include "engine/base/vector.h"
#include "materials/measured/direction_table.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lightwell {

/// Scattering of a sheet as a file tells it: reflection of either side, and transmission either way.
/// Frame  of the file: z out of the front of the sheet, y upwards; directions leave the sheet
/// Error: values are those of the file, constant over each patch or cell. Files that send back more light than they get
///        are scaled down (scaled_by()).
class MeasuredTable {
public:
    struct Parts {
        std::shared_ptr<const DirectionTable> front, back;           ///< reflection; null: black
        std::shared_ptr<const DirectionTable> from_front, from_back; ///< transmission of light that comes from there
        ColourTables beside_front = {}, beside_back = {}, beside_from_front = {}, beside_from_back = {};
    };
    /// What the file says beside its values.
    struct About {
        std::string name, manufacturer;
        double thickness_m = 0, width_m = 0, height_m = 0; ///< 0: not told
        std::string geometry_format, geometry;             ///< text of the sheet's inner geometry, if there is any
        std::string not_read;                              ///< wavelengths that were left out
    };
    MeasuredTable(Parts parts, About about);
    /// XML as WINDOW and genBSDF write it: Klems' full, half and quarter bases, bases of the file's own, trees of three
    /// and four coordinates. Visible light is read, and with CIE-X and CIE-Z its colour.
    /// @throws InputError with file and line: no XML, no visible data, counts that do not fit, values that are no
    ///         numbers
    static std::shared_ptr<const MeasuredTable> read(const std::filesystem::path& file);
    static std::shared_ptr<const MeasuredTable> parse(std::string_view xml, const std::string& file);

    /// @param incident, out  unit vectors
    double value_per_sr(const Direction& incident, const Direction& out) const noexcept;
    /// The part for light from one side; null: none.
    const DirectionTable* reflection(bool front) const noexcept { return (front ? parts_.front : parts_.back).get(); }
    const DirectionTable* transmission(bool from_front) const noexcept
    {
        return (from_front ? parts_.from_front : parts_.from_back).get();
    }
    const ColourTables& reflection_beside(bool front) const noexcept
    {
        return front ? parts_.beside_front : parts_.beside_back;
    }
    const ColourTables& transmission_beside(bool from_front) const noexcept
    {
        return from_front ? parts_.beside_from_front : parts_.beside_from_back;
    }
    /// Of all values, so that no more light leaves than arrives.
    double scaled_by() const noexcept { return scale_; }
    /// Of all colours, [0, 1], so that no primary is sent back more than it arrives.
    double saturation() const noexcept { return saturation_; }
    const About& about() const noexcept { return about_; }

private:
    void hold_energy();

    Parts parts_;
    About about_;
    double scale_ = 1, saturation_ = 1;
};

} // namespace lightwell
