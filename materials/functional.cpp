#include "materials/functional.h"

#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/patterns/place_program.h"
#include "materials/ward.h"

#include <cmath>

namespace lightwell {
namespace {

/// Of the highlight that directions are drawn from, beside the whole hemisphere: the lobes of measured lacquers and
/// brushed metals are about as wide.
constexpr double drawn_roughness = 0.15;
constexpr double drawn_highlight_share = 0.5;

bool is_metal(Functional::Kind kind)
{
    return kind == Functional::Kind::metfunc || kind == Functional::Kind::metdata;
}

} // namespace

FunctionalScattering::FunctionalScattering(const Functional& m, bool from_front, const Frame& frame) noexcept
    : material_(&m), frame_(frame)
{
    if (m.kind == Functional::Kind::BRTDfunc) {
        diffuse_reflectance_ = from_front ? m.front : m.back;
        diffuse_transmittance_ = m.through;
        reflected_ = transmitted_ = m.function->values_towards_light() > 0 ? Spectrum::grey(m.scale) : Spectrum{};
        mirrored_ = m.mirrored;
        passed_ = m.passed;
        return;
    }
    const double passing = m.transmission * (1 - m.specularity);
    diffuse_reflectance_ = m.colour * (1 - m.specularity - passing);
    diffuse_transmittance_ = m.colour * (passing * (1 - m.transmitted_specular));
    reflected_ = (is_metal(m.kind) ? m.colour : Spectrum::grey(1)) * (m.specularity * m.scale);
    transmitted_ = m.colour * (passing * m.transmitted_specular * m.scale);
}

FunctionalScattering::Shares FunctionalScattering::shares(LobeSet set) const noexcept
{
    Shares s;
    if (set != LobeSet::diffuse) {
        s.mirrored = photopic(mirrored_);
        s.straight = photopic(passed_);
        s.reflected = photopic(reflected_);
        s.transmitted = photopic(transmitted_);
    }
    if (set != LobeSet::specular) {
        s.diffuse_reflection = photopic(diffuse_reflectance_);
        s.diffuse_transmission = photopic(diffuse_transmittance_);
    }
    const double sum =
        s.mirrored + s.straight + s.reflected + s.transmitted + s.diffuse_reflection + s.diffuse_transmission;
    if (!(sum > 0))
        return {};
    return {s.mirrored / sum,    s.straight / sum,           s.reflected / sum,
            s.transmitted / sum, s.diffuse_reflection / sum, s.diffuse_transmission / sum};
}

/// Of directions drawn for the function's lobe on the side of to_light.
double FunctionalScattering::lobe_density(Direction to_viewer, Direction to_light) noexcept
{
    const double narrow = to_light.z > 0
                              ? Ward(drawn_roughness).scattered(to_viewer, to_light).density_per_sr
                              : RoughTransmission(drawn_roughness).scattered(to_viewer, to_light).density_per_sr;
    return drawn_highlight_share * narrow +
           (1 - drawn_highlight_share) * Diffuse::density_per_sr(std::fabs(to_light.z));
}

Spectrum FunctionalScattering::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return {};
    const bool reflected = to_light.z > 0;
    Spectrum value;
    if (set != LobeSet::specular)
        value = (reflected ? diffuse_reflectance_ : diffuse_transmittance_) / pi;
    const Spectrum& factor = reflected ? reflected_ : transmitted_;
    if (set == LobeSet::diffuse || factor.is_black())
        return value;
    PatternPlace place = material_->place;
    place.to_light = frame_.to_world(to_light);
    return value + factor * material_->function->towards(place);
}

double FunctionalScattering::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return 0;
    const Shares s = shares(set);
    const bool reflected = to_light.z > 0;
    const double lobe = reflected ? s.reflected : s.transmitted;
    const double diffuse = reflected ? s.diffuse_reflection : s.diffuse_transmission;
    return (lobe > 0 ? lobe * lobe_density(to_viewer, to_light) : 0) +
           diffuse * Diffuse::density_per_sr(std::fabs(to_light.z));
}

std::optional<BsdfSample> FunctionalScattering::sample(Direction to_viewer, double choice, UnitSquare u,
                                                       LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    const Shares s = shares(set);
    if (choice < s.mirrored)
        return BsdfSample{mirrored(to_viewer), mirrored_ / s.mirrored, 0, true, false};
    if ((choice -= s.mirrored) < s.straight)
        return BsdfSample{-to_viewer, passed_ / s.straight, 0, true, true};
    choice -= s.straight;
    const double lobes = s.reflected + s.transmitted, diffuse = s.diffuse_reflection + s.diffuse_transmission;
    if (!(lobes + diffuse > 0))
        return {};
    Direction to_light;
    if (choice < lobes) {
        const bool through = choice >= s.reflected;
        double rest = through ? (choice - s.reflected) / s.transmitted : choice / s.reflected;
        if (rest < drawn_highlight_share) {
            to_light = through ? RoughTransmission(drawn_roughness).sample(to_viewer, u)
                               : Ward(drawn_roughness).sample(to_viewer, u);
            if (through != (to_light.z < 0))
                return {}; // lost on the wrong side
        } else {
            to_light = Diffuse::sample(u);
            to_light.z = through ? -to_light.z : to_light.z;
        }
    } else {
        to_light = Diffuse::sample(u);
        if (s.diffuse_reflection == 0 || choice - lobes >= s.diffuse_reflection)
            to_light.z = s.diffuse_transmission > 0 ? -to_light.z : to_light.z;
    }
    const double density = density_per_sr(to_viewer, to_light, set);
    if (!(density > 0))
        return {};
    return BsdfSample{to_light, value_per_sr(to_viewer, to_light, set) * (std::fabs(to_light.z) / density), density,
                      false, false};
}

Spectrum FunctionalScattering::straight_transmittance(Direction to_viewer) const noexcept
{
    return to_viewer.z > 0 ? passed_ : Spectrum{};
}

Lobes FunctionalScattering::lobes() const noexcept
{
    Lobes lobes;
    lobes.diffuse_reflectance = diffuse_reflectance_;
    lobes.diffuse_transmittance = diffuse_transmittance_;
    lobes.glossy = !reflected_.is_black() || !transmitted_.is_black();
    lobes.glossy_width_rad = lobes.glossy ? drawn_roughness : 0;
    lobes.delta = !mirrored_.is_black() || !passed_.is_black();
    // Its share depends on the place: shadow rays ask there.
    lobes.transparent_to_shadows = material_->kind == Functional::Kind::BRTDfunc;
    return lobes;
}

double bounded_scale(const Functional& material)
{
    constexpr int viewers = 8, side = 48;
    constexpr double golden = 0.61803398874989485; // its multiples fill the unit interval evenly
    // Lobes far narrower than the directions drawn here come out too high by chance.
    constexpr double believed = 1.25;
    double most = 1;
    for (int v = 0; v < viewers; ++v) {
        const double cosine = (v + 0.5) / viewers, sine = std::sqrt(1 - cosine * cosine);
        Functional placed = material;
        placed.scale = 1;
        placed.mirrored = placed.passed = {};
        placed.place.direction = {-sine, 0, -cosine};
        const FunctionalScattering scattering(placed, true, Frame{});
        Spectrum sum;
        for (int i = 0; i < side * side; ++i) {
            const double choice = std::fmod(i * golden, 1);
            const UnitSquare u{(i / side + 0.5) / side, (i % side + 0.5) / side};
            if (const auto drawn = scattering.sample({sine, 0, cosine}, choice, u, LobeSet::specular))
                sum += drawn->weight;
        }
        const double albedo = sum.max() / (side * side);
        most = std::fmax(most, albedo > believed ? albedo : 1);
    }
    return 1 / most;
}

} // namespace lightwell
