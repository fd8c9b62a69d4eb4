#include "materials/measured_scattering.h"

#include "materials/diffuse.h"
#include "materials/measured/measured_table.h"

#include <cmath>

namespace lightwell {
namespace {

double least_of(const DirectionTable* table)
{
    return table != nullptr ? table->least_per_sr() : 0;
}

} // namespace

MeasuredScattering::MeasuredScattering(const Measured& m, bool from_front) noexcept
    : reflection_(m.table->reflection(from_front)), transmission_(m.table->transmission(from_front)),
      scale_(m.table->scaled_by()), side_(from_front ? 1 : -1), passes_straight_(m.passes_straight)
{
    diffuse_reflectance_ = (from_front ? m.front : m.back) + Spectrum::grey(scale_ * pi * least_of(reflection_));
    diffuse_transmittance_ = m.through + Spectrum::grey(scale_ * pi * least_of(transmission_));
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

double MeasuredScattering::lobe_value(const Direction& to_viewer, const Direction& to_light,
                                      const Peak& peak) const noexcept
{
    const DirectionTable* table = to_light.z > 0 ? reflection_ : transmission_;
    if (table == nullptr)
        return 0;
    const double least = scale_ * table->least_per_sr();
    const DiscPoint in = incident(to_viewer), out{side_ * to_light.x, to_light.y};
    if (to_light.z < 0 && peak.transmittance > 0 && transmission_->within_peak(in, out))
        return std::fmax(0, peak.around_per_sr - least);
    return std::fmax(0, scale_ * table->value_per_sr(in, out) - least);
}

Spectrum MeasuredScattering::value_per_sr(Direction to_viewer, Direction to_light, LobeSet set) const noexcept
{
    if (!(to_viewer.z > 0) || to_light.z == 0)
        return {};
    Spectrum value;
    if (set != LobeSet::specular)
        value = (to_light.z > 0 ? diffuse_reflectance_ : diffuse_transmittance_) / pi;
    if (set != LobeSet::diffuse)
        value += Spectrum::grey(lobe_value(to_viewer, to_light, peak(to_viewer)));
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
    const Peak straight = peak(to_viewer);
    const Shares s = shares(to_viewer, straight, set);
    if (choice < s.straight)
        return BsdfSample{-to_viewer, Spectrum::grey(straight.transmittance / s.straight), 0, true, true};
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
    return to_viewer.z > 0 ? Spectrum::grey(peak(to_viewer).transmittance) : Spectrum{};
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
