#include "plugins/validation/glass_formulas.h"

#include "engine/base/vector.h"
#include "plugins/validation/quadrature.h"

namespace lightwell {
namespace {

double square(double x)
{
    return x * x;
}

double mean_of_squares(double a, double b)
{
    return 0.5 * (a * a + b * b);
}

} // namespace

Reflectances boundary(double angle_rad, double index)
{
    const double sine = std::sin(angle_rad) / index;
    if (std::fabs(sine) >= 1)
        return {1, 1};
    const double refracted = std::asin(sine);
    if (angle_rad == 0)
        return {square((index - 1) / (index + 1)), square((index - 1) / (index + 1))};
    return {square(std::sin(angle_rad - refracted) / std::sin(angle_rad + refracted)),
            square(std::tan(angle_rad - refracted) / std::tan(angle_rad + refracted))};
}

double pane_transmittance(double transmissivity, double index, double angle_rad)
{
    const Reflectances r = boundary(angle_rad, index);
    const double t = std::pow(transmissivity, 1 / std::cos(std::asin(std::sin(angle_rad) / index)));
    const auto passed = [t](double rho) { return square(1 - rho) * t / (1 - square(rho * t)); };
    return 0.5 * (passed(r.senkrecht) + passed(r.parallel));
}

double pane_transmissivity(double normal_transmittance, double index)
{
    const double r = square((index - 1) / (index + 1)), through = square(1 - r);
    return 2 * normal_transmittance / (through + std::sqrt(through * through + square(2 * r * normal_transmittance)));
}

double diffuse_transmittance(double transmissivity, double index)
{
    double sum = 0;
    for (const QuadratureNode& node : gauss_legendre(200, 0, 0.5 * pi))
        sum += node.weight * std::sin(2 * node.x) * pane_transmittance(transmissivity, index, node.x);
    return sum;
}

BallPassage through_ball(double impact, double index)
{
    const double incidence = std::asin(impact), refracted = std::asin(impact / index);
    const Reflectances r = boundary(incidence, index);
    return {2 * (incidence - refracted), pi + 2 * incidence - 4 * refracted, r.mean(),
            mean_of_squares(1 - r.senkrecht, 1 - r.parallel),
            0.5 * (square(1 - r.senkrecht) * r.senkrecht + square(1 - r.parallel) * r.parallel)};
}

PrismPassage through_prism(double apex_rad, double index, double incidence_rad)
{
    const double inside = apex_rad - std::asin(std::sin(incidence_rad) / index), sine = index * std::sin(inside);
    if (std::fabs(sine) >= 1)
        return {true, 0, 0, 0};
    const double exit = std::asin(sine);
    const Reflectances first = boundary(std::fabs(incidence_rad), index),
                       second = boundary(std::fabs(inside), 1 / index);
    return {false, incidence_rad + exit - apex_rad, exit,
            0.5 * ((1 - first.senkrecht) * (1 - second.senkrecht) + (1 - first.parallel) * (1 - second.parallel))};
}

} // namespace lightwell
