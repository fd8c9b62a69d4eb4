#include "plugins/validation/room_formulas.h"

#include "engine/base/vector.h"
#include "plugins/validation/quadrature.h"

namespace lightwell {

double sphere_indirect(double radius, double reflectance, double flux_lm)
{
    return flux_lm * reflectance / (4 * pi * radius * radius * (1 - reflectance));
}

PlaneIlluminances parallel_planes(double exitance, double reflectance1, double reflectance2)
{
    const double on_second = exitance / (1 - reflectance1 * reflectance2);
    return {reflectance2 * on_second, on_second};
}

Corner::Strip Corner::make_strip(double width, double reflectance, double direct)
{
    constexpr int panels = 30, nodes = 12; // down to 1e-9 of the width, where nothing is left to gain
    Strip strip{reflectance, {}, {}, {}};
    double high = width;
    for (int panel = 0; panel < panels; ++panel) {
        const double low = panel + 1 < panels ? 0.5 * high : 0;
        for (const QuadratureNode& node : gauss_legendre(nodes, low, high)) {
            strip.place.push_back(node.x);
            strip.weight.push_back(node.weight);
            strip.value.push_back(direct);
        }
        high = low;
    }
    return strip;
}

double Corner::gathered(const Strip& from, double at)
{
    double sum = 0;
    for (std::size_t i = 0; i < from.place.size(); ++i) {
        const double z = from.place[i], r2 = at * at + z * z;
        sum += from.weight[i] * from.value[i] * at * z / (2 * r2 * std::sqrt(r2));
    }
    return from.reflectance * sum;
}

Corner::Corner(double floor_reflectance, double wall_reflectance, double wall_height, double direct)
    : direct_(direct), floor_(make_strip(1, floor_reflectance, direct)),
      wall_(make_strip(wall_height, wall_reflectance, direct))
{
    constexpr int sweeps = 24; // each takes the error down by rho1 rho2 / 4, at most a quarter
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t i = 0; i < floor_.place.size(); ++i)
            floor_.value[i] = on_floor(floor_.place[i]);
        for (std::size_t i = 0; i < wall_.place.size(); ++i)
            wall_.value[i] = on_wall(wall_.place[i]);
    }
}

double Corner::on_floor(double x) const
{
    return direct_ + gathered(wall_, x);
}

double Corner::on_wall(double z) const
{
    return direct_ + gathered(floor_, z);
}

double tilted_plane(SkyGradation sky, double tilt_rad)
{
    const double uniform = 0.5 * pi * (1 + std::cos(tilt_rad));
    if (sky == SkyGradation::uniform)
        return uniform;
    // The integral of (n . w)(z . w) over the part of the sky in front of the plane.
    const double graded = 2.0 / 3 * (std::sin(tilt_rad) + (pi - tilt_rad) * std::cos(tilt_rad));
    return (uniform + 2 * graded) / 3;
}

double sky_cone(SkyGradation sky, double half_angle_rad)
{
    const double c = std::cos(half_angle_rad), uniform = pi * (1 - c * c);
    return sky == SkyGradation::uniform ? uniform : (uniform + 4 * pi / 3 * (1 - c * c * c)) / 3;
}

} // namespace lightwell
