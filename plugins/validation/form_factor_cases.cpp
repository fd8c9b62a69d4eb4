#include "plugins/validation/case.h"
#include "plugins/validation/lamp_formulas.h"
#include "plugins/validation/quadrature.h"

namespace lightwell {
namespace {

constexpr double accepted = 0.003, exitance = 1000;
constexpr unsigned direct = static_cast<unsigned>(Technique::direct);
/// Sensors a side: the rule is exact to 1e-4 of the mean for each case (tests/unit/validation).
constexpr int nodes = 12;

Scene one_polygon(const Perturbation& p, const std::vector<Point>& corners)
{
    Scene scene;
    scene.root.add_polygon(corners, scene.add_material("emitter", p.lamp(exitance / pi)), "emitter");
    return scene;
}

/// Sensors over the rectangle 0 < x < a, 0 < y < b of the floor, weighted to give the mean.
std::vector<WeightedSensor> over_rectangle(double a, double b)
{
    std::vector<WeightedSensor> sensors;
    for (const QuadratureNode& x : gauss_legendre(nodes, 0, a))
        for (const QuadratureNode& y : gauss_legendre(nodes, 0, b))
            sensors.push_back({{{x.x, y.x, 0}, {0, 0, 1}}, x.weight * y.weight / (a * b)});
    return sensors;
}

/// Sensors along a radius, weighted to give the mean over the disc.
std::vector<WeightedSensor> over_disc(double radius)
{
    std::vector<WeightedSensor> sensors;
    for (const QuadratureNode& r : gauss_legendre(4 * nodes, 0, 1))
        sensors.push_back({{{radius * r.x, 0, 0}, {0, 0, 1}}, 2 * r.x * r.weight});
    return sensors;
}

Check mean_check(double form_factor, std::vector<WeightedSensor> sensors)
{
    const double expected = form_factor * exitance;
    return {"mean for exitance 1000", expected, accepted * expected, std::move(sensors), {}, false, "lx"};
}

Case parallel_case(const std::string& id, double x, double y, double z)
{
    const double f = parallel_rectangles(x, y, z);
    const std::vector<Point> above{{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}};
    Case result{id, direct};
    result.setups.push_back(
        {[=](const Perturbation& p) { return one_polygon(p, above); }, {mean_check(f, over_rectangle(x, y))}});
    result.references = {{"F12", f}, {"mean_illuminance_for_exitance_1000", exitance * f}};
    return result;
}

Case perpendicular_case(const std::string& id, double l, double w, double h)
{
    const double f = perpendicular_rectangles(l, w, h);
    const std::vector<Point> wall{{0, 0, 0}, {0, 0, h}, {l, 0, h}, {l, 0, 0}}; // front towards +y
    Case result{id, direct};
    // The mean on the floor for an exitance of the wall is F12, from the floor to the wall.
    result.setups.push_back(
        {[=](const Perturbation& p) { return one_polygon(p, wall); }, {mean_check(f, over_rectangle(l, w))}});
    result.references = {{"F12", f}, {"F21", f * w / h}};
    return result;
}

Case discs_case(const std::string& id, double r1, double r2, double h)
{
    const double f = coaxial_discs(r1, r2, h);
    Case result{id, direct};
    result.setups.push_back({[=](const Perturbation& p) {
                                 Scene scene;
                                 scene.root.add_ring({{0, 0, h}, {0, 0, -1}, 0, r2},
                                                     scene.add_material("emitter", p.lamp(exitance / pi)), "emitter");
                                 return scene;
                             },
                             {mean_check(f, over_disc(r1))}});
    result.references = {{"F12", f}, {"F21", f * r1 * r1 / (r2 * r2)}};
    return result;
}

} // namespace

std::vector<Case> form_factor_cases()
{
    return {parallel_case("cl_ff_parallel_1x1x1", 1, 1, 1),
            parallel_case("cl_ff_parallel_2x1x0.5", 2, 1, 0.5),
            parallel_case("cl_ff_parallel_4x3x2.5", 4, 3, 2.5),
            perpendicular_case("cl_ff_perpendicular_l1_w1_h1", 1, 1, 1),
            perpendicular_case("cl_ff_perpendicular_l4_w4_h3", 4, 4, 3),
            perpendicular_case("cl_ff_perpendicular_l2_w0.5_h3", 2, 0.5, 3),
            discs_case("cl_ff_discs_1_1_1", 1, 1, 1),
            discs_case("cl_ff_discs_0.5_2_1", 0.5, 2, 1),
            discs_case("cl_ff_discs_3_0.2_0.7", 3, 0.2, 0.7)};
}

} // namespace lightwell
