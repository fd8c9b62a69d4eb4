#include "materials/layered.h"

#include "materials/diffuse.h"
#include "materials/mirror.h"

#include <cmath>

namespace lightwell {
namespace {

/// Reflectance that a smooth coating gains: 0.998 at 90 degrees, 0.00085 along the normal.
/// Source  Radiance, exponential fit to Fresnel's formulas for an index near 1.5
double grazing_gain(double cosine)
{
    constexpr double steepness = 5.85, offset = 0.00202943064;
    return std::exp(-steepness * cosine) - offset;
}

/// Mean of grazing_gain() under diffuse light: 2 (1 - e^-s (1 + s)) / s^2 - offset.
constexpr double mean_grazing_gain = 0.0552588;

} // namespace

Layered::Widths Layered::widths(double roughness_u, double roughness_v) noexcept
{
    // One width alone cannot be 0: a highlight that is a line is never met.
    const bool smooth = std::fmax(roughness_u, roughness_v) <= smooth_roughness;
    return {std::fmax(roughness_u, smooth_roughness), std::fmax(roughness_v, smooth_roughness), smooth};
}

Layered::Layered(Spectrum colour, double specularity, double roughness, double transmission,
                 double transmitted_specular, bool tinted_highlight) noexcept
    : colour_(colour), specularity_(specularity), transmission_(transmission),
      transmitted_specular_(transmitted_specular), reflected_(widths(roughness, roughness)), passed_(reflected_),
      tinted_highlight_(tinted_highlight), has_fresnel_(reflected_.smooth && specularity >= smallest_fresnel)
{
}

Layered::Layered(const Plastic& p) noexcept : Layered(p.colour, p.specularity, p.roughness, 0, 0, false) {}

Layered::Layered(const Metal& m) noexcept : Layered(m.colour, m.specularity, m.roughness, 0, 0, true) {}

Layered::Layered(const Trans& t) noexcept
    : Layered(t.colour, t.specularity, t.roughness, t.transmission, t.transmitted_specular, false)
{
}

Layered::Layered(const Brushed& b) noexcept
    : Layered(b.colour, b.specularity, 0, b.transmission, b.transmitted_specular, b.kind == Brushed::Kind::metal)
{
    reflected_ = passed_ = widths(b.roughness_u, b.roughness_v);
    has_fresnel_ = false; // as in Radiance: none of the brushed materials has a coating
    brushed_ = true;
}

Layered::Layered(const Wgmd& w, bool from_front) noexcept
    : reflected_(widths(w.reflected_u, w.reflected_v)), passed_(widths(w.passed_u, w.passed_v)), brushed_(true),
      fixed_(true)
{
    fixed_parts_ = {from_front ? w.front : w.back, w.through * w.colours[2], w.colours[0] * w.reflected,
                    w.colours[1] * w.passed};
    const Spectrum sum = fixed_parts_.diffuse_reflectance + fixed_parts_.diffuse_transmittance +
                         fixed_parts_.specular_reflectance + fixed_parts_.specular_transmittance;
    if (const double most = sum.max(); most > 1) // the numbers and the functions together would create light
        for (Spectrum* part : {&fixed_parts_.diffuse_reflectance, &fixed_parts_.diffuse_transmittance,
                               &fixed_parts_.specular_reflectance, &fixed_parts_.specular_transmittance})
            *part = *part / most;
}

ScatteredLobe Layered::passed_lobe(Direction to_viewer, Direction to_light) const noexcept
{
    return brushed_ ? BrushedTransmission(passed_.u, passed_.v).scattered(to_viewer, to_light)
                    : RoughTransmission(passed_.u).scattered(to_viewer, to_light);
}

Vec3 Layered::passed_direction(Direction to_viewer, UnitSquare u) const noexcept
{
    return brushed_ ? BrushedTransmission(passed_.u, passed_.v).sample(to_viewer, u)
                    : RoughTransmission(passed_.u).sample(to_viewer, u);
}

double Layered::fresnel_increase(double cosine) const noexcept
{
    return has_fresnel_ ? grazing_gain(std::fabs(cosine)) : 0;
}

Layered::Parts Layered::parts(double cos_viewer, LobeSet set) const noexcept
{
    if (fixed_) {
        Parts found = fixed_parts_;
        if (set == LobeSet::specular)
            found.diffuse_reflectance = found.diffuse_transmittance = {};
        if (set == LobeSet::diffuse)
            found.specular_reflectance = found.specular_transmittance = {};
        return found;
    }
    const double gain = fresnel_increase(cos_viewer);
    const double below = (1 - specularity_) * (1 - gain); // share that enters
    const double passing = below * transmission_;
    const Spectrum highlight = tinted_highlight_ ? Spectrum::grey(gain) + colour_ * (specularity_ * (1 - gain))
                                                 : Spectrum::grey(specularity_ + gain * (1 - specularity_));
    Parts parts;
    if (set != LobeSet::specular) {
        parts.diffuse_reflectance = colour_ * (below - passing);
        parts.diffuse_transmittance = colour_ * (passing * (1 - transmitted_specular_));
    }
    if (set != LobeSet::diffuse) {
        parts.specular_reflectance = highlight;
        parts.specular_transmittance = colour_ * (passing * transmitted_specular_);
    }
    return parts;
}

Layered::Shares Layered::shares(const Parts& parts) const noexcept
{
    const double dr = photopic(parts.diffuse_reflectance), dt = photopic(parts.diffuse_transmittance);
    const double sr = photopic(parts.specular_reflectance), st = photopic(parts.specular_transmittance);
    const double sum = dr + dt + sr + st;
    if (!(sum > 0))
        return {};
    return {dr / sum, dt / sum, sr / sum, st / sum};
}

Layered::Scattered Layered::scattered(const Parts& parts, const Shares& shares, Direction to_viewer,
                                      Direction to_light) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return {};
    const bool reflected = to_light.z > 0;
    const double entering = 1 - fresnel_increase(to_light.z);
    const double diffuse_share = reflected ? shares.diffuse_reflection : shares.diffuse_transmission;
    Scattered sum{(reflected ? parts.diffuse_reflectance : parts.diffuse_transmittance) * (entering / pi),
                  diffuse_share * Diffuse::density_per_sr(std::fabs(to_light.z))};
    if (reflected && shares.specular_reflection > 0 && !reflected_.smooth) {
        const ScatteredLobe lobe = Ward(reflected_.u, reflected_.v).scattered(to_viewer, to_light);
        sum.value_per_sr += parts.specular_reflectance * lobe.value_per_sr;
        sum.density_per_sr += shares.specular_reflection * lobe.density_per_sr;
    }
    if (!reflected && shares.specular_transmission > 0 && !passed_.smooth) {
        const ScatteredLobe lobe = passed_lobe(to_viewer, to_light);
        sum.value_per_sr += parts.specular_transmittance * lobe.value_per_sr;
        sum.density_per_sr += shares.specular_transmission * lobe.density_per_sr;
    }
    return sum;
}

Spectrum Layered::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    const Parts wanted = parts(to_viewer.z, set);
    return scattered(wanted, shares(wanted), to_viewer, to_light).value_per_sr;
}

double Layered::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    const Parts wanted = parts(to_viewer.z, set);
    return scattered(wanted, shares(wanted), to_viewer, to_light).density_per_sr;
}

std::optional<BsdfSample> Layered::sample(Direction to_viewer, double choice, UnitSquare u, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    const Parts wanted = parts(to_viewer.z, set);
    const Shares share = shares(wanted);
    Direction to_light;
    if (choice < share.specular_reflection) {
        if (reflected_.smooth)
            return BsdfSample{mirrored(to_viewer), wanted.specular_reflectance / share.specular_reflection, 0, true,
                              false};
        to_light = Ward(reflected_.u, reflected_.v).sample(to_viewer, u);
        if (!(to_light.z > 0))
            return {}; // lost below the surface
    } else if ((choice -= share.specular_reflection) < share.specular_transmission) {
        if (passed_.smooth)
            return BsdfSample{-to_viewer, wanted.specular_transmittance / share.specular_transmission, 0, true, true};
        to_light = passed_direction(to_viewer, u);
        if (!(to_light.z < 0))
            return {};
    } else {
        to_light = Diffuse::sample(u);
        // The last branch takes what rounding left over, but never a part that is not there.
        const bool through =
            share.diffuse_reflection == 0 || choice - share.specular_transmission >= share.diffuse_reflection;
        if (through && share.diffuse_transmission > 0)
            to_light.z = -to_light.z;
    }
    const Scattered found = scattered(wanted, share, to_viewer, to_light);
    if (!(found.density_per_sr > 0))
        return {};
    return BsdfSample{to_light, found.value_per_sr * (std::fabs(to_light.z) / found.density_per_sr),
                      found.density_per_sr, false, false};
}

Spectrum Layered::straight_transmittance(Direction to_viewer) const noexcept
{
    return passed_.smooth && to_viewer.z > 0 ? parts(to_viewer.z, LobeSet::specular).specular_transmittance
                                             : Spectrum{};
}

Lobes Layered::lobes() const noexcept
{
    const Parts along_normal = parts(1, LobeSet::all);
    const double entering = has_fresnel_ ? 1 - mean_grazing_gain : 1;
    const bool mirror_like = !along_normal.specular_reflectance.is_black();
    const bool passes = !along_normal.specular_transmittance.is_black();
    Lobes lobes;
    lobes.diffuse_reflectance = along_normal.diffuse_reflectance * entering;
    lobes.diffuse_transmittance = along_normal.diffuse_transmittance * entering;
    const bool rough_highlight = mirror_like && !reflected_.smooth, rough_passage = passes && !passed_.smooth;
    lobes.glossy = rough_highlight || rough_passage;
    if (rough_highlight)
        lobes.glossy_width_rad = std::fmin(reflected_.u, reflected_.v);
    else if (rough_passage)
        lobes.glossy_width_rad = std::fmin(passed_.u, passed_.v);
    lobes.delta = (mirror_like && reflected_.smooth) || (passes && passed_.smooth);
    lobes.transparent_to_shadows = passed_.smooth && passes;
    return lobes;
}

} // namespace lightwell
