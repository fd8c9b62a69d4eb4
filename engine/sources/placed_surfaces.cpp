#include "engine/sources/placed_surfaces.h"

#include "engine/accel/ray_queries.h"
#include "engine/base/random.h"
#include "engine/scene/expansion.h"

namespace lightwell {
namespace {

struct Walker {
    const Scene& scene;
    const std::function<bool(const Material&)>& wanted;
    const std::function<bool(const PlacedSurface&)>& visit;
    std::vector<char> may_hold; ///< by prototype

    /// The instances between the root and the part that is being visited.
    struct Place {
        const Place* outer;
        const std::vector<Binding>* bindings;
    };

    bool part_may_hold(const Part& part) const
    {
        for (const Surface& surface : part.surfaces) {
            if (surface.shape == Shape::instance) {
                if (may_hold[part.instances[surface.index].prototype])
                    return true;
                continue;
            }
            const Material* material = resolve(scene, surface.modifier).material;
            const bool inherited =
                surface.modifier != void_modifier &&
                std::holds_alternative<Inherited>(scene.modifiers[static_cast<std::size_t>(surface.modifier)].what);
            if (inherited || (material != nullptr && wanted(*material)))
                return true;
        }
        return false;
    }

    bool walk(const Part& part, const Affine& to_world, std::uint64_t path, const Place* place) const
    {
        for (std::uint32_t i = 0; i < part.surfaces.size(); ++i) {
            const Surface& surface = part.surfaces[i];
            if (surface.shape == Shape::instance) {
                const Instance& instance = part.instances[surface.index];
                const Place inner{place, &instance.bindings};
                if (may_hold[instance.prototype] &&
                    !walk(scene.prototypes[instance.prototype], compose(to_world, instance.to_parent),
                          instance_path(path, i), &inner))
                    return false;
                continue;
            }
            ModifierId modifier = surface.modifier;
            for (const Place* p = place; p != nullptr; p = p->outer)
                modifier = bound_modifier(scene, modifier, *p->bindings);
            const Material* material = resolve(scene, modifier).material;
            if (surface.shape != Shape::source && material != nullptr && wanted(*material) &&
                !visit({part, surface, i, to_world, path, modifier, *material}))
                return false;
        }
        return true;
    }
};

} // namespace

void visit_placed(const Scene& scene, const std::function<bool(const Material&)>& wanted,
                  const std::function<bool(const PlacedSurface&)>& visit)
{
    Walker walker{scene, wanted, visit, {}};
    for (const Part& part : scene.prototypes)
        walker.may_hold.push_back(walker.part_may_hold(part));
    walker.walk(scene.root, Affine{}, 0, nullptr);
}

std::uint64_t place_key(std::uint64_t path, std::uint32_t surface) noexcept
{
    return mix_bits(path, surface);
}

} // namespace lightwell
