#include "engine/scene/expansion.h"
#include "importers/emission_sides.h"
#include "importers/layers.h"
#include "importers/mapped_area.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace lightwell {
namespace {

struct Amount {
    double surfaces = 0; ///< a double: a forest may have more than fit into an integer's product
    double area_m2 = 0;
};
using Amounts = std::unordered_map<ModifierId, Amount>;

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

/// The material behind a modifier after mapping; the proposal before.
std::string material_of(const Imported& imported, ModifierId id)
{
    const Scene& scene = imported.scene;
    const auto index = static_cast<std::size_t>(id);
    const auto* alias = std::get_if<Alias>(&scene.modifiers[index].what);
    if (alias && alias->target != void_modifier) {
        const auto target = static_cast<std::size_t>(alias->target);
        const bool keyed = target < imported.keys.size() && !imported.keys[target].material.empty();
        return keyed ? imported.keys[target].material : scene.modifiers[target].name;
    }
    if (std::holds_alternative<Material>(scene.modifiers[index].what))
        return scene.modifiers[index].name;
    return index < imported.keys.size() ? propose_material(imported.keys[index]) : std::string();
}

} // namespace

std::vector<LayerSummary> summarize_layers(const Imported& imported)
{
    const Amounts amounts = Adder{imported.scene}.amounts_of(imported.scene.root, {});
    std::vector<ModifierId> order;
    for (const auto& entry : amounts)
        order.push_back(entry.first);
    std::sort(order.begin(), order.end());
    std::map<std::string, LayerSummary> layers;
    for (const ModifierId id : order) {
        const Amount& amount = amounts.at(id);
        const bool known = id != void_modifier;
        const std::string name = !known ? std::string("void")
                                 : static_cast<std::size_t>(id) < imported.keys.size()
                                     ? imported.keys[static_cast<std::size_t>(id)].layer
                                     : imported.scene.modifiers[static_cast<std::size_t>(id)].name;
        LayerSummary& layer = layers[name];
        layer.name = name;
        layer.surfaces += static_cast<std::size_t>(amount.surfaces);
        layer.area_m2 += amount.area_m2;
        const std::string material = known ? material_of(imported, id) : std::string("void");
        if (layer.material.empty())
            layer.material = material;
        else if (!material.empty() && (", " + layer.material + ",").find(", " + material + ",") == std::string::npos)
            layer.material += ", " + material;
    }
    std::vector<LayerSummary> result;
    for (auto& [name, layer] : layers)
        result.push_back(std::move(layer));
    return result;
}

} // namespace lightwell
