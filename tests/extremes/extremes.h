#pragma once

#include "engine/simulate/simulate.h"

#include <string>
#include <vector>

namespace lightwell {

/// Illuminance at the sensors, found as users find it, lx, with one standard error each.
struct ExtremeValues {
    std::vector<double> values, errors;
};
ExtremeValues illuminance_at(const Scene& scene, const std::vector<Sensor>& sensors, int samples,
                             const Preparation& preparation = {});

/// Compares and keeps the largest deviation of a case for the table that is printed in the end.
/// @param radiance  what Radiance 6.1 gives on the like, from the measured figures; empty: not measured
class ExtremeRow {
public:
    ExtremeRow(std::string id, std::string item, std::string radiance = "");
    ~ExtremeRow();
    ExtremeRow(const ExtremeRow&) = delete;
    ExtremeRow& operator=(const ExtremeRow&) = delete;
    /// @param tolerance  relative
    void compare(double found, double expected, double tolerance, double standard_error = 0);
    /// The same for a value that may be noisier than the tolerance, as long as its interval holds the truth.
    void holds(double found, double expected, double tolerance, double standard_error);

private:
    std::string id_, item_, radiance_;
    double worst_ = 0, tolerance_ = 0, ratio_ = -1;
};

/// A polygon of a lamp of this luminance, cd/m^2, whose front faces `to`.
void add_lamp(Scene& scene, std::vector<Point> corners, double luminance, const Point& to);
/// A closed box that lets diffuse light in through its walls: their own exitance is 1 lx beside this reflectance.
/// @param at  of its corner
Scene white_box(double reflectance, const Vec3& at = {});
/// Radiance that a wide plate of white metal shows under this angle in surroundings of 1; its standard error too.
double seen_in_furnace(double roughness, double degrees, double& error);
/// The base scene of the table: a square lamp of 1 m over three sensors.
std::vector<Point> base_square();
std::vector<Sensor> base_sensors();

} // namespace lightwell
