#include "materials/emission.h"

#include <cmath>

namespace lightwell {
namespace {

bool within_cone(const Spotlight& spot, const Direction& to_viewer)
{
    const double half_angle_rad = spot.full_angle_deg / 2 * radians_per_degree;
    const Direction aim = normalized(spot.aim);
    // The angle itself, by atan2: the cosine has no digits left for a narrow beam.
    return std::atan2(length(cross(aim, to_viewer)), dot(aim, to_viewer)) <= half_angle_rad;
}

} // namespace

Spectrum emitted_towards(const Material& material, double cos_to_viewer, Direction world_to_viewer) noexcept
{
    if (!(cos_to_viewer > 0))
        return {};
    if (const auto* spot = std::get_if<Spotlight>(&material); spot && !within_cone(*spot, world_to_viewer))
        return {};
    return emitted_radiance(material);
}

double beam_share(const Material& material, double distance_m) noexcept
{
    const auto* spot = std::get_if<Spotlight>(&material);
    if (spot == nullptr || !(distance_m > 0))
        return 1;
    const double share = distance_m / (distance_m + length(spot->aim));
    return share * share;
}

bool is_only_seen(const Material& material) noexcept
{
    const auto* glow = std::get_if<Glow>(&material);
    return glow != nullptr && glow->max_radius_m < 0;
}

bool passes_illum_fronts(const Material& lamp) noexcept
{
    const auto* glow = std::get_if<Glow>(&lamp);
    return glow == nullptr || glow->max_radius_m > 0;
}

} // namespace lightwell
