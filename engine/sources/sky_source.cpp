#include "engine/sources/sky_source.h"

#include "engine/sky/sky.h"
#include "engine/sources/weighted_choice.h"
#include "materials/emission.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Cells of equal solid angle: bands of equal height in z, sectors of equal angle. The horizon falls between bands.
constexpr std::size_t bands = 64, sectors = 128;
constexpr double cell_solid_angle_sr = 4 * pi / (bands * sectors);

Direction direction_at(double band, double sector)
{
    const double z = 2 * band / bands - 1, angle = 2 * pi * sector / sectors;
    const double r = std::sqrt(std::fmax(0, 1 - z * z));
    return {r * std::cos(angle), r * std::sin(angle), z};
}

} // namespace

Spectrum distant_radiance(const Scene& scene, const VariedMaterials& varied, const DistantSource& source,
                          ModifierId modifier, const Direction& direction) noexcept
{
    // Half-angle test by sines of the half difference: exact for the narrowest sun.
    const Vec3 apart = direction - source.to_source;
    const double chord = 2 * std::sin(0.25 * source.full_angle_deg * radians_per_degree);
    if (dot(apart, apart) > chord * chord)
        return {};
    const ResolvedMaterial resolved = resolve(scene, modifier);
    if (resolved.material == nullptr)
        return {};
    Spectrum radiance = emitted_radiance(*resolved.material);
    if (varied.varies(modifier)) {
        PatternPlace place;
        place.direction = direction;
        place.normal = -direction;
        place.distant = true;
        SeenMaterial seen;
        varied.look(modifier, place, seen);
        radiance = seen.material != nullptr ? emitted_radiance(*seen.material) : Spectrum{};
    }
    if (resolved.brightness == nullptr)
        return radiance;
    const SkyBrightness& b = *resolved.brightness;
    return radiance * sky_brightness(static_cast<int>(b.kind), b.zenith, b.ground, b.normalization, b.to_sun, direction,
                                     b.sharp_horizon);
}

SkySource::SkySource(const Scene& scene, const VariedMaterials& varied, std::vector<const Surface*> wide)
    : scene_(&scene), varied_(&varied), wide_(std::move(wide))
{
    double total = 0;
    for (std::size_t band = 0; band < bands; ++band)
        for (std::size_t sector = 0; sector < sectors; ++sector) {
            const auto at = [&](double db, double ds) {
                return photopic(
                    radiance(direction_at(static_cast<double>(band) + db, static_cast<double>(sector) + ds)));
            };
            total += 0.25 * (at(0.25, 0.25) + at(0.75, 0.25) + at(0.25, 0.75) + at(0.75, 0.75));
            summed_.push_back(total);
        }
    if (!(total > 0))
        wide_.clear();
}

Spectrum SkySource::radiance(const Direction& direction) const noexcept
{
    Spectrum sum;
    for (const Surface* surface : wide_)
        sum += distant_radiance(*scene_, *varied_, scene_->root.sources[surface->index], surface->modifier, direction);
    return sum;
}

std::size_t SkySource::cell(const Direction& direction) const noexcept
{
    const double band = std::clamp(0.5 * (direction.z + 1) * bands, 0.0, bands - 1.0);
    double turn = std::atan2(direction.y, direction.x) / (2 * pi);
    turn -= std::floor(turn);
    const double sector = std::clamp(turn * sectors, 0.0, sectors - 1.0);
    return static_cast<std::size_t>(band) * sectors + static_cast<std::size_t>(sector);
}

SourceSample SkySource::sample(UnitSquare u) const noexcept
{
    const auto [at, share, left] = choose(summed_.data(), summed_.size(), u.u);
    SourceSample s;
    if (!(share > 0))
        return s;
    s.to_light = direction_at(static_cast<double>(at / sectors) + left, static_cast<double>(at % sectors) + u.v);
    s.density_per_sr = share / cell_solid_angle_sr;
    s.radiance = radiance(s.to_light);
    return s;
}

double SkySource::density_per_sr(const Direction& direction) const noexcept
{
    const std::size_t at = cell(direction);
    const double part = summed_[at] - (at == 0 ? 0 : summed_[at - 1]);
    return part / (summed_.back() * cell_solid_angle_sr);
}

} // namespace lightwell
