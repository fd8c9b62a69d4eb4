#include "engine/simulate/aim.h"

namespace lightwell {
namespace {

/// What a lit place sends back of its irradiance, as radiance: a wall of middle reflectance.
constexpr double usual_reflection_per_sr = 0.5 / pi;

} // namespace

Aim::Aim(const BrightDiscs* discs, const SecondarySources* openings, const Point& from, const Direction& normal)
    : discs_(discs), openings_(openings)
{
    double disc_total = 0;
    if (discs_ != nullptr && !discs_->empty()) {
        to_discs_ = discs_->shares(from, normal);
        disc_total = to_discs_.total * usual_reflection_per_sr;
    }
    if (openings_ != nullptr && !openings_->empty())
        to_openings_ = openings_->shares(from, normal);
    total_ = disc_total + to_openings_.total;
    disc_share_ = total_ > 0 ? disc_total / total_ : 0;
}

SampledDirection Aim::sample(UnitSquare u) const noexcept
{
    SampledDirection found;
    if (u.u < disc_share_)
        found = discs_->sample(to_discs_, {u.u / disc_share_, u.v});
    else if (disc_share_ < 1)
        found = openings_->sample(to_openings_, {(u.u - disc_share_) / (1 - disc_share_), u.v});
    return {found.direction, found.density_per_sr > 0 ? density_per_sr(found.direction) : 0};
}

double Aim::density_per_sr(const Direction& direction) const noexcept
{
    double density = 0;
    if (disc_share_ > 0)
        density += disc_share_ * discs_->density_per_sr(to_discs_, direction);
    if (disc_share_ < 1)
        density += (1 - disc_share_) * openings_->density_per_sr(to_openings_, direction);
    return density;
}

} // namespace lightwell
