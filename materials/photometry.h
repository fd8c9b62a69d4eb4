#pragma once

#include "engine/base/report.h"
#include "engine/base/vector.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A measured luminaire: luminous intensity by direction, and its luminous opening.
/// Frame  local: z up, the light goes towards -z; plane 0 looks along +x, plane 90 along +y
/// Source IES LM-63-2019; EULUMDAT (Stockmar 1990)
struct Photometry {
    /// How angles are meant. C: vertical from the nadir, planes about the vertical axis. B: planes about a horizontal
    /// axis (y), each with a vertical angle; horizontal angles lie within. A: planes about the x axis, each with a
    /// horizontal angle; vertical angles lie within. 0, 0 of A and B is the nadir.
    enum class Type { C, B, A };
    /// Where the light leaves; extents along plane 0 (x), plane 90 (y) and the vertical.
    struct Opening {
        enum class Shape {
            point,
            rectangle,
            ellipse,
            box,
            vertical_cylinder,
            sphere,
            cylinder_along_x,
            cylinder_along_y,
            ellipsoid
        } shape = Shape::point;
        double x_m = 0, y_m = 0, z_m = 0;
    };
    Type type = Type::C;
    std::string name;
    std::vector<double> horizontal_deg; ///< ascending; for C one (symmetric about the axis) or 0 to 360
    std::vector<double> vertical_deg;   ///< ascending
    std::vector<double> candela;        ///< [horizontal][vertical], all factors applied
    Opening opening;
    double lamp_lumens = 0; ///< of all lamps; 0: absolute photometry
    double watts = 0;
    std::string tilt_file;               ///< named by TILT=; read_photometry() reads it
    std::vector<double> tilt_deg;        ///< from the vertical, ascending; empty: the same however it is tilted
    std::vector<double> tilt_share = {}; ///< of the light, at each of tilt_deg

    /// Luminous intensity towards a direction, cd; 0 beyond the measured angles. Linear between angles.
    double candela_towards(const Direction& direction) const;
    /// Luminous flux of the whole distribution, lm.
    /// Error: exact for the linear interpolation within a plane; trapezoids across planes
    double lumens() const;
    /// Share of the light that lamps give when the luminaire's axis leaves the vertical by an angle.
    double share_tilted(double angle_deg) const;
    double greatest_candela() const;
    /// Angle between the two directions of half the greatest intensity in a plane of type C, degrees; measured over
    /// both sides of the axis. 0 when the light never falls to half.
    double beam_angle_deg(double plane_deg) const;
    bool sends_down() const; ///< any light below the horizontal
    bool sends_up() const;   ///< any light above it
};

/// Words for a shape: "rectangle", "vertical cylinder".
const char* to_text(Photometry::Opening::Shape shape);

/// Reads IES LM-63 (1986 to 2019) or EULUMDAT, told apart by their content.
/// @throws InputError with file and line: no number where one is expected, angles that do not ascend, a symmetry that
///         does not fit the planes, a file cut short, absurd counts
Photometry read_photometry(const std::filesystem::path& file, Report& report);

/// True for text with a line `TILT=`.
bool looks_like_ies(std::string_view text);
Photometry parse_ies(std::string_view text, const std::string& file_name, Report& report);
Photometry parse_eulumdat(std::string_view text, const std::string& file_name, Report& report);
/// The table that a file named by TILT= holds: lamp position, number of angles, angles, shares.
/// @throws InputError
void parse_tilt(std::string_view text, const std::string& file_name, Photometry& photometry);
/// Completes planes that a symmetry leaves out and checks the angles.
/// @throws InputError
void complete_planes(Photometry& photometry, const std::string& place);

} // namespace lightwell
