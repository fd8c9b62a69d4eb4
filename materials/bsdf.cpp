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

std::optional<BsdfSample> sample_of(const Mirror& mirror, Direction to_viewer)
{
    if (mirror.reflectance.is_black())
        return {};
    return BsdfSample{mirrored(to_viewer), mirror.reflectance, 0, true, false};
}

Lobes delta_lobes(bool transparent_to_shadows)
{
    Lobes lobes;
    lobes.delta = true;
    lobes.transparent_to_shadows = transparent_to_shadows;
    return lobes;
}

} // namespace

Bsdf::Model Bsdf::model_of(const Material& material, bool from_front) noexcept
{
    // Hartmann's constant enters through the index at 500 nm, the mean wavelength; colours are not spread.
    constexpr double mean_wavelength_nm = 500;
    return std::visit(Overloaded{[](const Plastic& m) -> Model { return Layered(m); },
                                 [](const Metal& m) -> Model { return Layered(m); },
                                 [](const Trans& m) -> Model { return Layered(m); },
                                 [=](const Dielectric& m) -> Model {
                                     return DielectricBoundary(m.index + m.hartmann / mean_wavelength_nm, from_front);
                                 },
                                 [](const Glass& m) -> Model { return ThinGlass(m.transmissivity, m.index); },
                                 [](const Mirror& m) -> Model { return m; },
                                 [](const auto&) -> Model { return Black{}; }},
                      material);
}

Bsdf::Bsdf(const Material& material, bool from_front) noexcept : model_(model_of(material, from_front))
{
    lobes_ = std::visit(Overloaded{[](const Black&) { return Lobes{}; }, [](const Layered& m) { return m.lobes(); },
                                   [](const DielectricBoundary& m) { return delta_lobes(m.straight()); },
                                   [](const ThinGlass& m) { return delta_lobes(!m.opaque()); },
                                   [](const Mirror&) { return delta_lobes(false); }},
                        model_);
}

Spectrum Bsdf::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    const auto* layered = std::get_if<Layered>(&model_);
    return layered ? layered->value_per_sr(to_viewer, to_light, set) : Spectrum{};
}

double Bsdf::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    const auto* layered = std::get_if<Layered>(&model_);
    return layered ? layered->density_per_sr(to_viewer, to_light, set) : 0;
}

std::optional<BsdfSample> Bsdf::sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    const bool scatters_diffusely = std::holds_alternative<Layered>(model_);
    if (set == LobeSet::diffuse && !scatters_diffusely)
        return {};
    using Sample = std::optional<BsdfSample>;
    return std::visit(Overloaded{[](const Black&) -> Sample { return {}; },
                                 [&](const Layered& m) -> Sample { return m.sample(to_viewer, choice, u, set); },
                                 [&](const Mirror& m) -> Sample { return sample_of(m, to_viewer); },
                                 [&](const auto& m) -> Sample { return sample_of(m, to_viewer, choice); }},
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
    return std::visit(Overloaded{[&](const Layered& m) { return m.straight_transmittance(to_viewer); },
                                 [&](const ThinGlass& m) { return m.transmittance(to_viewer.z); },
                                 [&](const DielectricBoundary& m) {
                                     return m.straight() ? Spectrum::grey(m.radiance_transmittance(to_viewer.z))
                                                         : Spectrum{};
                                 },
                                 [](const auto&) { return Spectrum{}; }},
                      model_);
}

} // namespace lightwell
