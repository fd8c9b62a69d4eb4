#include "materials/measured_scattering.h"

#include "engine/base/xyz_colour.h"
#include "materials/diffuse.h"
#include "materials/measured/measured_table.h"
#include "materials/patterns/spectral_colour.h"

#include <cmath>

namespace lightwell {
namespace {

Spectrum held(const Spectrum& s)
{
    return {std::fmax(s.r, 0), std::fmax(s.g, 0), std::fmax(s.b, 0)};
}

Spectrum paled(const Spectrum& colour, double luminous, double saturation)
{
    return Spectrum::grey(luminous) + saturation * (colour - Spectrum::grey(luminous));
}

Spectrum least_of(const DirectionTable* table, const ColourTables& beside, double saturation)
{
    if (table == nullptr)
        return {};
    const double y = table->least_per_sr();
    if (beside.x == nullptr)
        return Spectrum::grey(y);
    return held(paled(colour_of_xyz({beside.x->least_per_sr(), y, beside.z->least_per_sr()}), y, saturation));
}

} // namespace

MeasuredScattering::MeasuredScattering(const Measured& m, bool from_front) noexcept
    : reflection_(m.table->reflection(from_front)), transmission_(m.table->transmission(from_front)),
      reflection_beside_(&m.table->reflection_beside(from_front)),
      transmission_beside_(&m.table->transmission_beside(from_front)), scale_(m.table->scaled_by()),
      saturation_(m.table->saturation()), side_(from_front ? 1 : -1), passes_straight_(m.passes_straight)
{
    least_reflection_per_sr_ = scale_ * least_of(reflection_, *reflection_beside_, saturation_);
    least_transmission_per_sr_ = scale_ * least_of(transmission_, *transmission_beside_, saturation_);
    diffuse_reflectance_ = (from_front ? m.front : m.back) + pi * least_reflection_per_sr_;
    diffuse_transmittance_ = m.through + pi * least_transmission_per_sr_;
}

Spectrum MeasuredScattering::coloured(const DirectionTable& table, const ColourTables& beside, const DiscPoint& in,
                                      const DiscPoint& out) const noexcept
{
    const double y = table.value_per_sr(in, out);
    if (beside.x == nullptr)
        return scale_ * Spectrum::grey(y);
    const Spectrum colour =
        within_primaries(colour_of_xyz({beside.x->value_per_sr(in, out), y, beside.z->value_per_sr(in, out)}));
    return scale_ * paled(colour, y, saturation_);
}

Spectrum MeasuredScattering::straight(const Peak& peak, const Direction& to_viewer) const noexcept
{
    if (transmission_ == nullptr || transmission_beside_->x == nullptr || !(peak.transmittance > 0))
        return Spectrum::grey(peak.transmittance);
    const DiscPoint in = incident(to_viewer);
    const double y = scale_ * transmission_->value_per_sr(in, in);
    return y > 0 ? coloured(*transmission_, *transmission_beside_, in, in) * (peak.transmittance / y) : Spectrum{};
}

DiscPoint MeasuredScattering::incident(const Direction& to_viewer) const noexcept
{
    return {-side_ * to_viewer.x, -to_viewer.y};
}

MeasuredScattering::Peak MeasuredScattering::peak(const Direction& to_viewer) const noexcept
{
    if (!passes_straight_ || transmission_ == nullptr)
        return {};
    const DirectionTable::Peak found = transmission_->peak(incident(to_viewer));
    return {scale_ * found.share, scale_ * found.around_per_sr};
}

MeasuredScattering::Shares MeasuredScattering::shares(const Direction& to_viewer, const Peak& peak,
                                                      LobeSet set) const noexcept
{
    const DiscPoint in = incident(to_viewer);
    Shares s;
    const auto lobe = [&](const DirectionTable* table) {
        return table != nullptr ? std::fmax(0, scale_ * (table->hemispherical(in) - pi * table->least_per_sr())) : 0;
    };
    if (set != LobeSet::diffuse) {
        s.straight = peak.transmittance;
        s.reflected = lobe(reflection_);
        s.transmitted = lobe(transmission_);
    }
    if (set != LobeSet::specular) {
        s.diffuse_reflection = photopic(diffuse_reflectance_);
        s.diffuse_transmission = photopic(diffuse_transmittance_);
    }
    const double sum = s.straight + s.reflected + s.transmitted + s.diffuse_reflection + s.diffuse_transmission;
    if (!(sum > 0))
        return {};
    return {s.straight / sum, s.reflected / sum, s.transmitted / sum, s.diffuse_reflection / sum,
            s.diffuse_transmission / sum};
}

Spectrum MeasuredScattering::lobe_value(const Direction& to_viewer, const Direction& to_light,
                                        const Peak& peak) const noexcept
{
    const DirectionTable* table = to_light.z > 0 ? reflection_ : transmission_;
    if (table == nullptr)
        return {};
    const Spectrum least = to_light.z > 0 ? least_reflection_per_sr_ : least_transmission_per_sr_;
    const DiscPoint in = incident(to_viewer), out{side_ * to_light.x, to_light.y};
    const Spectrum found = coloured(*table, to_light.z > 0 ? *reflection_beside_ : *transmission_beside_, in, out);
    if (to_light.z < 0 && peak.transmittance > 0 && transmission_->within_peak(in, out)) {
        const double y = scale_ * table->value_per_sr(in, out);
        return held(found * (y > 0 ? peak.around_per_sr / y : 0) - least);
    }
    return held(found - least);
}

Spectrum MeasuredScattering::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return {};
    Spectrum value;
    if (set != LobeSet::specular)
        value = (to_light.z > 0 ? diffuse_reflectance_ : diffuse_transmittance_) / pi;
    if (set != LobeSet::diffuse)
        value += lobe_value(to_viewer, to_light, peak(to_viewer));
    return value;
}

double MeasuredScattering::density(const Shares& s, const Direction& to_viewer,
                                   const Direction& to_light) const noexcept
{
    const bool reflected = to_light.z > 0;
    const double lobe = reflected ? s.reflected : s.transmitted;
    double sum =
        (reflected ? s.diffuse_reflection : s.diffuse_transmission) * Diffuse::density_per_sr(std::fabs(to_light.z));
    if (lobe > 0)
        sum +=
            lobe * std::fabs(to_light.z) *
            (reflected ? reflection_ : transmission_)->density(incident(to_viewer), {side_ * to_light.x, to_light.y});
    return sum;
}

double MeasuredScattering::density_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return 0;
    return density(shares(to_viewer, peak(to_viewer), set), to_viewer, to_light);
}

std::optional<BsdfSample> MeasuredScattering::sample(Direction to_viewer, double choice, UnitSquare u,
                                                     LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0))
        return {};
    const Peak peak_here = peak(to_viewer);
    const Shares s = shares(to_viewer, peak_here, set);
    if (choice < s.straight)
        return BsdfSample{-to_viewer, straight(peak_here, to_viewer) / s.straight, 0, true, true};
    choice -= s.straight;
    Direction to_light;
    const double lobes = s.reflected + s.transmitted;
    if (choice < lobes) {
        const bool through = choice >= s.reflected;
        const double rest = through ? (choice - s.reflected) / s.transmitted : choice / s.reflected;
        const DiscPoint out = (through ? transmission_ : reflection_)->sample(incident(to_viewer), rest, u);
        const double z = std::sqrt(std::fmax(0, 1 - out.x * out.x - out.y * out.y));
        to_light = {side_ * out.x, out.y, through ? -z : z};
    } else {
        to_light = Diffuse::sample(u);
        if (s.diffuse_reflection == 0 || choice - lobes >= s.diffuse_reflection)
            to_light.z = s.diffuse_transmission > 0 ? -to_light.z : to_light.z;
    }
    const double found = to_light.z != 0 ? density(s, to_viewer, to_light) : 0;
    if (!(found > 0))
        return {};
    return BsdfSample{to_light, value_per_sr(to_viewer, to_light, set) * (std::fabs(to_light.z) / found), found, false,
                      false};
}

Spectrum MeasuredScattering::straight_transmittance(Direction to_viewer) const noexcept
{
    return to_viewer.z > 0 ? straight(peak(to_viewer), to_viewer) : Spectrum{};
}

Lobes MeasuredScattering::lobes() const noexcept
{
    Lobes lobes;
    lobes.diffuse_reflectance = diffuse_reflectance_;
    lobes.diffuse_transmittance = diffuse_transmittance_;
    lobes.glossy = true;
    // Patches are some ten degrees wide, cells of trees a few.
    constexpr double width_rad = 0.1;
    lobes.glossy_width_rad = width_rad;
    lobes.delta = lobes.transparent_to_shadows = passes_straight_ && transmission_ != nullptr;
    return lobes;
}

} // namespace lightwell
