#include "materials/bsdf.h"

#include "materials/mirror.h"

namespace lightwell {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// One mirrored and one transmitted ray, chosen by how much they carry.
std::optional<BsdfSample> mirror_or_pass(Direction to_viewer, double choice, Spectrum reflectance,
                                         Spectrum transmittance, double reflected_share, Direction passed,
                                         bool straight)
{
    if (choice < reflected_share)
        return BsdfSample{mirrored(to_viewer), reflectance / reflected_share, 0, true, false};
    if (!(reflected_share < 1) || transmittance.is_black())
        return {};
    return BsdfSample{passed, transmittance / (1 - reflected_share), 0, true, straight};
}

double mirrored_choice_of(const ThinGlass& glass, Direction to_viewer)
{
    const double reflected = photopic(glass.reflectance(to_viewer.z));
    const double passing = photopic(glass.transmittance(to_viewer.z));
    return reflected + passing > 0 ? reflected / (reflected + passing) : 0;
}

std::optional<BsdfSample> sample_of(const DielectricBoundary& boundary, Direction to_viewer, double choice)
{
    const double reflectance = boundary.reflectance(to_viewer.z);
    const double passing = boundary.radiance_transmittance(to_viewer.z);
    return mirror_or_pass(to_viewer, choice, Spectrum::grey(reflectance), Spectrum::grey(passing), reflectance,
                          boundary.refracted(to_viewer), boundary.straight());
}

std::optional<BsdfSample> sample_of(const ThinGlass& glass, Direction to_viewer, double choice)
{
    const Spectrum r = glass.reflectance(to_viewer.z), t = glass.transmittance(to_viewer.z);
    return mirror_or_pass(to_viewer, choice, r, t, mirrored_choice_of(glass, to_viewer), -to_viewer, true);
}

/// Models that scatter in lobes of their own, beside those that mirror or pass.
template <class Model>
concept Scattering = requires(const Model& m, Direction d)
{
    m.value_per_sr(d, d, LobeSet::all);
};

Lobes delta_lobes(bool transparent_to_shadows)
{
    Lobes lobes;
    lobes.delta = true;
    lobes.transparent_to_shadows = transparent_to_shadows;
    return lobes;
}

} // namespace

Bsdf::Model Bsdf::model_of(const Material& material, bool from_front, const Frame& frame) noexcept
{
    // Hartmann's constant enters through the index at 500 nm, the mean wavelength; colours are not spread.
    constexpr double mean_wavelength_nm = 500;
    return std::visit(
        Overloaded{
            [](const Plastic& m) -> Model { return Layered(m); }, [](const Metal& m) -> Model { return Layered(m); },
            [](const Trans& m) -> Model { return Layered(m); },
            [=](const Dielectric& m) -> Model {
                return DielectricBoundary(m.index + m.hartmann / mean_wavelength_nm, from_front);
            },
            [](const Glass& m) -> Model { return ThinGlass(m.transmissivity, m.index); },
            [](const Mirror& m) -> Model { return OnlyMirror{m.reflectance}; },
            [](const Brushed& m) -> Model { return Layered(m); },
            [](const Ashikhmin& m) -> Model { return AshikhminScattering(m); },
            [=](const Interface& m) -> Model { return DielectricBoundary(m.inner_index / m.outer_index, from_front); },
            [&](const Functional& m) -> Model { return FunctionalScattering(m, from_front, frame); },
            [=](const Measured& m) -> Model { return MeasuredScattering(m, from_front); },
            [=](const Wgmd& m) -> Model { return Layered(m, from_front); },
            [](const Mist& m) -> Model { return HazeScattering(m.eccentricity); },
            [](const auto&) -> Model { return Black{}; }},
        material);
}

Bsdf::Bsdf(const Material& material, bool from_front, const Frame& frame) noexcept
    : model_(model_of(material, from_front, frame))
{
    lobes_ = std::visit(Overloaded{[](const Black&) { return Lobes{}; },
                                   [](const DielectricBoundary& m) { return delta_lobes(m.straight()); },
                                   [](const ThinGlass& m) { return delta_lobes(!m.opaque()); },
                                   [](const OnlyMirror&) { return delta_lobes(false); },
                                   [](const auto& m) { return m.lobes(); }},
                        model_);
}

Spectrum Bsdf::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    return std::visit(
        [&](const auto& m) -> Spectrum {
            if constexpr (Scattering<decltype(m)>)
                return m.value_per_sr(to_viewer, to_light, set);
            else
                return {};
        },
        model_);
}

double Bsdf::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    return std::visit(
        [&](const auto& m) -> double {
            if constexpr (Scattering<decltype(m)>)
                return m.density_per_sr(to_viewer, to_light, set);
            else
                return 0;
        },
        model_);
}

std::optional<BsdfSample> Bsdf::sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    using Sample = std::optional<BsdfSample>;
    return std::visit(
        [&](const auto& m) -> Sample {
            using Kind = std::decay_t<decltype(m)>;
            if constexpr (Scattering<Kind>)
                return m.sample(to_viewer, choice, u, set);
            else if constexpr (std::is_same_v<Kind, Black>)
                return {};
            else if (set == LobeSet::diffuse)
                return {};
            else if constexpr (std::is_same_v<Kind, OnlyMirror>)
                return m.reflectance.is_black() ? Sample{}
                                                : BsdfSample{mirrored(to_viewer), m.reflectance, 0, true, false};
            else
                return sample_of(m, to_viewer, choice);
        },
        model_);
}

double Bsdf::mirrored_choice(Direction to_viewer) const noexcept
{
    if (!(to_viewer.z > 0))
        return 0;
    if (const auto* glass = std::get_if<ThinGlass>(&model_))
        return mirrored_choice_of(*glass, to_viewer);
    const auto* boundary = std::get_if<DielectricBoundary>(&model_);
    return boundary != nullptr ? boundary->reflectance(to_viewer.z) : 0;
}

Spectrum Bsdf::straight_transmittance(Direction to_viewer) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    return std::visit(Overloaded{[&](const ThinGlass& m) { return m.transmittance(to_viewer.z); },
                                 [&](const DielectricBoundary& m) {
                                     return m.straight() ? Spectrum::grey(m.radiance_transmittance(to_viewer.z))
                                                         : Spectrum{};
                                 },
                                 [&](const auto& m) {
                                     if constexpr (requires { m.straight_transmittance(to_viewer); })
                                         return m.straight_transmittance(to_viewer);
                                     else
                                         return Spectrum{};
                                 }},
                      model_);
}

} // namespace lightwell
