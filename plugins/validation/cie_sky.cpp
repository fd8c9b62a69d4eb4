#include "plugins/validation/cie_sky.h"

#include "engine/base/frame.h"
#include "materials/patterns/place_function.h"
#include "plugins/validation/quadrature.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {

SkyCoefficients sky_coefficients(int type)
{
    static constexpr SkyCoefficients table[general_skies] = {
        {4.0, -0.70, 0, -1.0, 0.00},   {4.0, -0.70, 2, -1.5, 0.15},   {1.1, -0.80, 0, -1.0, 0.00},
        {1.1, -0.80, 2, -1.5, 0.15},   {0.0, -1.00, 0, -1.0, 0.00},   {0.0, -1.00, 2, -1.5, 0.15},
        {0.0, -1.00, 5, -2.5, 0.30},   {0.0, -1.00, 10, -3.0, 0.45},  {-1.0, -0.55, 2, -1.5, 0.15},
        {-1.0, -0.55, 5, -2.5, 0.30},  {-1.0, -0.55, 10, -3.0, 0.45}, {-1.0, -0.32, 10, -3.0, 0.45},
        {-1.0, -0.32, 16, -3.0, 0.30}, {-1.0, -0.15, 16, -3.0, 0.30}, {-1.0, -0.15, 24, -2.8, 0.15}};
    return table[type - 1];
}

CieSkyFormula::CieSkyFormula(int type, const Direction& to_sun)
    : traditional_(type == traditional_overcast), to_sun_(to_sun)
{
    if (traditional_)
        return;
    k_ = sky_coefficients(type);
    scale_ = 1 / (indicatrix(std::acos(to_sun.z)) * (1 + k_.a * std::exp(k_.b)));
}

double CieSkyFormula::indicatrix(double angle) const
{
    const double cosine = std::cos(angle);
    return 1 + k_.c * (std::exp(k_.d * angle) - std::exp(0.5 * k_.d * pi)) + k_.e * cosine * cosine;
}

double CieSkyFormula::operator()(const Direction& direction) const
{
    if (!(direction.z > 0))
        return 0;
    if (traditional_)
        return (1 + 2 * direction.z) / 3;
    const double angle = std::acos(std::clamp(dot(direction, to_sun_), -1.0, 1.0));
    return scale_ * indicatrix(angle) * (1 + k_.a * std::exp(k_.b / direction.z));
}

namespace {

/// Where on a ring of angle `away` around the axis the plane's horizon lies, as angles in [0, 2 pi).
void add_horizon(double away, const Frame& frame, const Direction& up, std::vector<double>& cuts)
{
    const double a = std::sin(away) * dot(frame.x, up), b = std::sin(away) * dot(frame.y, up);
    const double level = std::cos(away) * dot(frame.z, up), reach = std::hypot(a, b);
    if (!(std::fabs(level) < reach))
        return;
    const double middle = std::atan2(b, a), half = std::acos(-level / reach);
    for (const double cut : {middle - half, middle + half})
        cuts.push_back(cut - 2 * pi * std::floor(cut / (2 * pi)));
}

/// Ends of panels over [0, pi] that grow smaller towards the angles at which a ring touches a horizon.
std::vector<double> ring_panels(const Direction& axis, const Direction& normal)
{
    std::vector<double> ends{0, pi};
    for (const Direction& up : {Direction{0, 0, 1}, normal}) {
        const double height = std::asin(std::clamp(dot(axis, up), -1.0, 1.0));
        ends.push_back(std::fabs(height));
        ends.push_back(pi - std::fabs(height));
    }
    std::sort(ends.begin(), ends.end());
    constexpr int parts = 24;
    std::vector<double> panels;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        for (int k = 0; k < parts; ++k)
            panels.push_back(ends[i] + (ends[i + 1] - ends[i]) * 0.5 * (1 - std::cos(pi * k / parts)));
    panels.push_back(pi);
    return panels;
}

} // namespace

double CieSkyFormula::on_plane(const Direction& normal) const
{
    // In rings about the sun, where the luminance has its cone; each ring is cut where it crosses a horizon.
    constexpr int nodes = 6, part_nodes = 24;
    const Frame frame = frame_about(to_sun_);
    const std::vector<double> panels = ring_panels(to_sun_, normal);
    double sum = 0;
    for (std::size_t p = 0; p + 1 < panels.size(); ++p)
        for (const QuadratureNode& away : gauss_legendre(nodes, panels[p], panels[p + 1])) {
            std::vector<double> cuts{0, 2 * pi};
            add_horizon(away.x, frame, {0, 0, 1}, cuts);
            add_horizon(away.x, frame, normal, cuts);
            std::sort(cuts.begin(), cuts.end());
            double around = 0;
            for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
                for (const QuadratureNode& turn : gauss_legendre(part_nodes, cuts[i], cuts[i + 1])) {
                    const Direction d = frame.z * std::cos(away.x) + frame.x * (std::sin(away.x) * std::cos(turn.x)) +
                                        frame.y * (std::sin(away.x) * std::sin(turn.x));
                    around += turn.weight * (*this)(d)*std::fmax(0, dot(d, normal));
                }
            sum += away.weight * std::sin(away.x) * around;
        }
    return sum;
}

namespace {

/// The general sky as a function of the direction, in the words of function files.
std::shared_ptr<const PlaceFunction> brightness(int type, const Direction& sun)
{
    const SkyCoefficients k = sky_coefficients(type);
    const double sun_angle = std::acos(sun.z), cosine = std::cos(sun_angle);
    const double offset = std::exp(0.5 * k.d * pi);
    const double at_sun = 1 + k.c * (std::exp(k.d * sun_angle) - offset) + k.e * cosine * cosine;
    Definitions definitions = standard_definitions();
    definitions.add(fmt::format("away = Dx * {:.17g} + Dy * {:.17g} + Dz * {:.17g};\n"
                                "held = if(away - 1, 1, if(-1 - away, -1, away));\n"
                                "chi = acos(held);\n"
                                "scattered = 1 + {:.17g} * (exp({:.17g} * chi) - {:.17g}) + {:.17g} * held * held;\n"
                                "graded = 1 + {:.17g} * exp({:.17g} / Dz);\n"
                                "brightness = if(Dz - 1e-9, scattered * graded * {:.17g}, 0);\n",
                                sun.x, sun.y, sun.z, k.c, k.d, offset, k.e, k.a, k.b,
                                1 / (at_sun * (1 + k.a * std::exp(k.b)))),
                    "cie_sky");
    return std::make_shared<PlaceFunction>(
        PlaceFunction::Formula{Program::compile(definitions, {"brightness"}, "", {}, "cie_sky")}, Affine{},
        PatternText{"brightfunc", {"brightness", "cie_sky.cal"}, {}, {}, "cie_sky", {}});
}

} // namespace

void add_cie_sky(Scene& scene, int type, const Direction& to_sun, double zenith)
{
    ModifierId pattern;
    if (type == traditional_overcast) {
        SkyBrightness overcast;
        overcast.kind = SkyBrightness::Kind::overcast;
        overcast.zenith = 1;
        overcast.sharp_horizon = true;
        pattern = scene.add_modifier({"skyfunc", overcast});
    } else {
        pattern = scene.add_modifier({"skyfunc", Varying{Varying::Kind::pattern, brightness(type, to_sun)}});
    }
    scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("sky_glow", Glow{Spectrum::grey(zenith), 0}, pattern),
                          "sky");
}

} // namespace lightwell
