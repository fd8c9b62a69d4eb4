#include "importers/surface_amounts.h"

#include "engine/scene/expansion.h"
#include "importers/emission_sides.h"
#include "importers/mapped_area.h"

namespace lightwell {
namespace {

using Amounts = std::unordered_map<ModifierId, Amount>;
using Boxes = std::unordered_map<ModifierId, Box>;

/// Adds up surfaces and areas by modifier. What a prototype holds is added up once and scaled for each instance that
/// is a similarity; only below other maps are instances walked one by one.
class Adder {
public:
    explicit Adder(const Scene& scene) : scene_(scene)
    {
        for (const Part& part : scene.prototypes)
            of_prototype_.push_back(amounts_of(part, {}));
    }
    Amounts amounts_of(const Part& part, const Affine& to_world) const
    {
        Amounts amounts;
        for (const Surface& surface : part.surfaces) {
            if (surface.shape == Shape::instance) {
                add_instance(amounts, part.instances[surface.index], to_world);
                continue;
            }
            if (surface.name.ends_with(back_suffix))
                continue;
            Amount& amount = amounts[surface.modifier];
            amount.surfaces += 1;
            amount.area_m2 += mapped_area_m2(part, surface, to_world);
        }
        return amounts;
    }

private:
    void add_instance(Amounts& amounts, const Instance& instance, const Affine& outer) const
    {
        const Affine to_world = compose(outer, instance.to_parent);
        const double scale = similarity_scale(to_world);
        const Amounts inner =
            scale > 0 ? of_prototype_[instance.prototype] : amounts_of(scene_.prototypes[instance.prototype], to_world);
        for (const auto& [modifier, amount] : inner) {
            Amount& sum = amounts[bound_modifier(scene_, modifier, instance.bindings)];
            sum.surfaces += amount.surfaces;
            sum.area_m2 += amount.area_m2 * (scale > 0 ? scale * scale : 1);
        }
    }

    const Scene& scene_;
    std::vector<Amounts> of_prototype_;
};

Boxes boxes_of(const Scene& scene, const Part& part, const std::vector<Boxes>& prototypes)
{
    Boxes boxes;
    for (const Surface& surface : part.surfaces) {
        if (surface.shape != Shape::instance) {
            boxes[surface.modifier].extend(surface_bounds(part, surface));
            continue;
        }
        const Instance& instance = part.instances[surface.index];
        for (const auto& [modifier, box] : prototypes[instance.prototype])
            if (!box.empty())
                boxes[bound_modifier(scene, modifier, instance.bindings)].extend(
                    transform_box(instance.to_parent, box));
    }
    return boxes;
}

} // namespace

std::unordered_map<ModifierId, Amount> surface_amounts(const Scene& scene)
{
    return Adder{scene}.amounts_of(scene.root, {});
}

std::unordered_map<ModifierId, Box> surface_boxes(const Scene& scene)
{
    constexpr std::size_t most_visited = 1'000'000; // a fraction of a second
    if (expanded_count(scene) > most_visited) {
        std::vector<Boxes> prototypes;
        for (const Part& part : scene.prototypes)
            prototypes.push_back(boxes_of(scene, part, prototypes));
        return boxes_of(scene, scene.root, prototypes);
    }
    Boxes boxes;
    visit_expanded(scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId modifier) {
        boxes[modifier].extend(surface_bounds(part, surface, map));
    });
    return boxes;
}

} // namespace lightwell
