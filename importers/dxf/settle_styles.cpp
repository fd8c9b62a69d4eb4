#include "importers/dxf/settle_styles.h"

#include <algorithm>

namespace lightwell::dxf {
namespace {

using Copies = std::vector<Instance*>;

bool same_bindings(const Instance& a, const Instance& b)
{
    return std::equal(
        a.bindings.begin(), a.bindings.end(), b.bindings.begin(), b.bindings.end(),
        [](const Binding& x, const Binding& y) { return x.inherited == y.inherited && x.actual == y.actual; });
}

/// All copies agree, and none passes on what the block around it leaves open.
bool can_settle(const Scene& scene, const Copies& copies)
{
    if (copies.empty() || copies.front()->bindings.empty())
        return false;
    for (const Binding& binding : copies.front()->bindings)
        if (binding.actual == void_modifier ||
            std::holds_alternative<Inherited>(scene.modifiers[static_cast<std::size_t>(binding.actual)].what))
            return false;
    return std::all_of(copies.begin(), copies.end(),
                       [&](const Instance* copy) { return same_bindings(*copy, *copies.front()); });
}

void settle(Part& block, const std::vector<Binding>& bindings)
{
    const auto settled = [&](ModifierId& modifier) {
        for (const Binding& binding : bindings)
            if (binding.inherited == modifier) {
                modifier = binding.actual;
                return;
            }
    };
    for (Surface& surface : block.surfaces)
        settled(surface.modifier);
    for (Instance& inner : block.instances)
        for (Binding& binding : inner.bindings)
            settled(binding.actual);
}

} // namespace

void settle_common_styles(Scene& scene)
{
    std::vector<Copies> copies(scene.prototypes.size());
    const auto gather = [&](Part& part) {
        for (Instance& instance : part.instances)
            copies[instance.prototype].push_back(&instance);
    };
    gather(scene.root);
    for (Part& part : scene.prototypes)
        gather(part);
    for (std::size_t i = scene.prototypes.size(); i-- > 0;) { // outer blocks first: they settle what inner ones get
        if (!can_settle(scene, copies[i]))
            continue;
        settle(scene.prototypes[i], copies[i].front()->bindings);
        for (Instance* copy : copies[i])
            copy->bindings = std::vector<Binding>{}; // gives its memory back, too
    }
}

} // namespace lightwell::dxf
