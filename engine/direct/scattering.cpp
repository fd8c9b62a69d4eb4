#include "engine/direct/scattering.h"

namespace lightwell {
namespace {

/// Half of the scattered rays go where the sun falls, where it falls anywhere in sight.
constexpr double share_of_guided = 0.5;

} // namespace

Scattering::Scattering(const Vertex& vertex, const Guide& guide) : vertex_(vertex), guide_(guide)
{
    if (vertex.bsdf.lobes().diffuse_reflectance.is_black())
        return;
    patches_ = guide.patch_shares(vertex.hit.position, vertex.side);
    if (patches_.total() > 0)
        guided_share_ = share_of_guided;
}

double Scattering::density_per_sr(const Direction& world, const Direction& local) const noexcept
{
    const double own = vertex_.bsdf.density_per_sr(vertex_.to_viewer, local);
    if (!(guided_share_ > 0))
        return own;
    return (1 - guided_share_) * own +
           guided_share_ * guide_.patch_density_per_sr(patches_, vertex_.hit.position, world);
}

std::optional<BsdfSample> Scattering::sample(PathRandom& random) const
{
    const double choice = random.one();
    const UnitSquare u = random.pair();
    if (choice < guided_share_) {
        const SampledDirection d = guide_.sample_patch(patches_, vertex_.hit.position, u);
        const Direction local = vertex_.frame.to_local(d.direction);
        const double density = density_per_sr(d.direction, local);
        if (!(density > 0))
            return std::nullopt;
        const Spectrum value = vertex_.bsdf.value_per_sr(vertex_.to_viewer, local);
        return BsdfSample{local, value * (std::fabs(local.z) / density), density};
    }
    std::optional<BsdfSample> own =
        vertex_.bsdf.sample(vertex_.to_viewer, (choice - guided_share_) / (1 - guided_share_), u);
    if (!own || !(guided_share_ > 0))
        return own;
    if (own->delta) {
        own->weight = own->weight / (1 - guided_share_);
        return own;
    }
    const double density = density_per_sr(vertex_.frame.to_world(own->to_light), own->to_light);
    own->weight = own->weight * (own->density_per_sr / density);
    own->density_per_sr = density;
    return own;
}

} // namespace lightwell
