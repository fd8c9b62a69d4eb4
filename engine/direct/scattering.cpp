#include "engine/direct/scattering.h"

namespace lightwell {
namespace {

/// Shares of the scattered rays that go where the sun falls and out of the windows, where there is any in sight.
constexpr double most_patch_share = 0.25, most_outlook_share = 0.25;

} // namespace

Scattering::Scattering(const Vertex& vertex, const Guide& guide) : vertex_(vertex), guide_(guide)
{
    if (vertex.bsdf.lobes().diffuse_reflectance.is_black())
        return;
    patches_ = guide.patch_shares(vertex.hit.position, vertex.side);
    outlooks_ = guide.outlook_shares(vertex.hit.position, vertex.side);
    patch_share_ = patches_.total() > 0 ? most_patch_share : 0;
    outlook_share_ = outlooks_.total() > 0 ? most_outlook_share : 0;
    own_share_ = 1 - patch_share_ - outlook_share_;
}

double Scattering::guided_density_per_sr(const Direction& world) const noexcept
{
    double density = 0;
    if (patch_share_ > 0)
        density += patch_share_ * guide_.patch_density_per_sr(patches_, vertex_.hit.position, world);
    if (outlook_share_ > 0)
        density += outlook_share_ * guide_.portal_density_per_sr(outlooks_, vertex_.hit.position, world);
    return density;
}

double Scattering::density_per_sr(const Direction& world, const Direction& local) const noexcept
{
    return own_share_ * vertex_.bsdf.density_per_sr(vertex_.to_viewer, local) + guided_density_per_sr(world);
}

std::optional<BsdfSample> Scattering::sample(PathRandom& random) const
{
    const double choice = random.one();
    const UnitSquare u = random.pair();
    if (choice >= own_share_) {
        const bool to_patch = choice < own_share_ + patch_share_;
        const SampledDirection d = to_patch ? guide_.sample_patch(patches_, vertex_.hit.position, u)
                                            : guide_.sample_portal(outlooks_, vertex_.hit.position, u);
        const Direction local = vertex_.frame.to_local(d.direction);
        const double density = density_per_sr(d.direction, local);
        if (!(d.density_per_sr > 0) || !(density > 0))
            return std::nullopt;
        const Spectrum value = vertex_.bsdf.value_per_sr(vertex_.to_viewer, local);
        return BsdfSample{local, value * (std::fabs(local.z) / density), density};
    }
    std::optional<BsdfSample> own = vertex_.bsdf.sample(vertex_.to_viewer, choice / own_share_, u);
    if (!own || own_share_ == 1)
        return own;
    if (own->delta) {
        own->weight = own->weight / own_share_;
        return own;
    }
    const double density = density_per_sr(vertex_.frame.to_world(own->to_light), own->to_light);
    own->weight = own->weight * (own->density_per_sr / density);
    own->density_per_sr = density;
    return own;
}

} // namespace lightwell
