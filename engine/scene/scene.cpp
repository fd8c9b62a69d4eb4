#include "engine/scene/scene.h"

#include "engine/scene/expansion.h"
#include "materials/placed.h"

namespace lightwell {

ModifierId Scene::add_modifier(Modifier modifier)
{
    modifiers.push_back(std::move(modifier));
    return static_cast<ModifierId>(modifiers.size() - 1);
}

ModifierId Scene::add_material(std::string name, Material material, ModifierId parent)
{
    return add_modifier({std::move(name), std::move(material), parent});
}

ModifierId Scene::find_modifier(const std::string& name) const
{
    for (std::size_t i = modifiers.size(); i-- > 0;)
        if (modifiers[i].name == name)
            return static_cast<ModifierId>(i);
    return void_modifier;
}

ResolvedMaterial resolve(const Scene& scene, ModifierId id)
{
    // validate() has made sure that the chain ends.
    ResolvedMaterial found;
    while (id != void_modifier) {
        const Modifier& modifier = scene.modifiers[static_cast<std::size_t>(id)];
        if (const auto* material = std::get_if<Material>(&modifier.what); material && !found.material) {
            found.material = material;
            found.varies = found.varies || depends_on_place(*material);
        }
        if (const auto* brightness = std::get_if<SkyBrightness>(&modifier.what); brightness && !found.brightness)
            found.brightness = brightness;
        if (const auto* varying = std::get_if<Varying>(&modifier.what)) {
            found.varies = true;
            for (const ModifierId mixed : {varying->foreground, varying->background})
                if (found.material == nullptr)
                    found.material = resolve(scene, mixed).material;
        }
        const auto* alias = std::get_if<Alias>(&modifier.what);
        id = alias && alias->target != void_modifier ? alias->target : modifier.parent;
    }
    return found;
}

ModifierId bound_modifier(const Scene& scene, ModifierId modifier, const std::vector<Binding>& bindings)
{
    if (modifier == void_modifier ||
        !std::holds_alternative<Inherited>(scene.modifiers[static_cast<std::size_t>(modifier)].what))
        return modifier;
    for (const Binding& binding : bindings)
        if (binding.inherited == modifier)
            return binding.actual;
    return modifier;
}

namespace {

/// The instances between the root and the part that is being visited.
struct Place {
    const Place* outer = nullptr;
    const std::vector<Binding>* bindings = nullptr;
};

void visit_part(const Scene& scene, const Part& part, const Affine& to_world, const Place* place,
                const SurfaceVisitor& visit)
{
    for (const Surface& surface : part.surfaces) {
        if (surface.shape == Shape::instance) {
            const Instance& instance = part.instances[surface.index];
            const Place inner{place, &instance.bindings};
            visit_part(scene, scene.prototypes[instance.prototype], compose(to_world, instance.to_parent), &inner,
                       visit);
            continue;
        }
        ModifierId modifier = surface.modifier;
        for (const Place* p = place; p != nullptr; p = p->outer)
            modifier = bound_modifier(scene, modifier, *p->bindings);
        visit(part, surface, to_world, modifier);
    }
}

} // namespace

void visit_expanded(const Scene& scene, const SurfaceVisitor& visit)
{
    visit_part(scene, scene.root, Affine{}, nullptr, visit);
}

std::size_t expanded_count(const Scene& scene)
{
    // Prototypes refer only to earlier ones, so one pass in order suffices.
    std::vector<std::size_t> counts;
    const auto count = [&](const Part& part) {
        std::size_t total = part.surfaces.size() - part.instances.size();
        for (const Instance& instance : part.instances)
            total += counts[instance.prototype];
        return total;
    };
    for (const Part& part : scene.prototypes)
        counts.push_back(count(part));
    return count(scene.root);
}

std::vector<Box> prototype_bounds(const Scene& scene)
{
    std::vector<Box> boxes;
    for (const Part& part : scene.prototypes)
        boxes.push_back(part_bounds(part, boxes));
    return boxes;
}

Box part_bounds(const Part& part, const std::vector<Box>& prototypes)
{
    Box box;
    for (const Surface& surface : part.surfaces) {
        if (surface.shape == Shape::instance) {
            const Instance& instance = part.instances[surface.index];
            box.extend(transform_box(instance.to_parent, prototypes[instance.prototype]));
        } else {
            box.extend(surface_bounds(part, surface));
        }
    }
    return box;
}

Box bounds(const Scene& scene)
{
    return part_bounds(scene.root, prototype_bounds(scene));
}

} // namespace lightwell
