#include "plugins/cli/merge_scenes.h"

#include <algorithm>

namespace lightwell {
namespace {

/// What is added to the numbers of an appended scene.
struct Offsets {
    ModifierId modifiers;
    std::uint32_t prototypes;

    ModifierId operator()(ModifierId id) const noexcept { return id < 0 ? id : id + modifiers; }
};

template <class T>
std::uint32_t append(std::vector<T>& to, const std::vector<T>& from)
{
    const auto before = static_cast<std::uint32_t>(to.size());
    to.insert(to.end(), from.begin(), from.end());
    return before;
}

/// By shape, the number of entries before the appended ones.
struct ShapeOffsets {
    std::uint32_t polygons, spheres, cones, rings, sources, meshes, instances;

    std::uint32_t of(Shape shape) const noexcept
    {
        switch (shape) {
        case Shape::polygon:
            return polygons;
        case Shape::sphere:
        case Shape::bubble:
            return spheres;
        case Shape::cone:
        case Shape::cup:
        case Shape::cylinder:
        case Shape::tube:
            return cones;
        case Shape::ring:
            return rings;
        case Shape::source:
            return sources;
        case Shape::mesh:
            return meshes;
        case Shape::instance:
            return instances;
        }
        return 0;
    }
};

void append_part(Part& to, const Part& from, const Offsets& offsets)
{
    const std::uint32_t points = append(to.points, from.points);
    const ShapeOffsets shapes{append(to.polygons, from.polygons),  append(to.spheres, from.spheres),
                              append(to.cones, from.cones),        append(to.rings, from.rings),
                              append(to.sources, from.sources),    append(to.meshes, from.meshes),
                              append(to.instances, from.instances)};
    for (std::size_t i = shapes.polygons; i < to.polygons.size(); ++i)
        to.polygons[i].first += points;
    for (std::size_t i = shapes.instances; i < to.instances.size(); ++i) {
        to.instances[i].prototype += offsets.prototypes;
        for (Binding& binding : to.instances[i].bindings)
            binding = {offsets(binding.inherited), offsets(binding.actual)};
    }
    for (Surface surface : from.surfaces) {
        surface.index += shapes.of(surface.shape);
        surface.modifier = offsets(surface.modifier);
        to.surfaces.push_back(std::move(surface));
    }
}

} // namespace

void append_scene(Scene& to, const Scene& from)
{
    const Offsets offsets{static_cast<ModifierId>(to.modifiers.size()),
                          static_cast<std::uint32_t>(to.prototypes.size())};
    append(to.modifiers, from.modifiers);
    for (std::size_t i = to.modifiers.size() - from.modifiers.size(); i < to.modifiers.size(); ++i) {
        Modifier& modifier = to.modifiers[i];
        modifier.parent = offsets(modifier.parent);
        if (auto* alias = std::get_if<Alias>(&modifier.what))
            alias->target = offsets(alias->target);
        if (auto* varying = std::get_if<Varying>(&modifier.what)) {
            varying->foreground = offsets(varying->foreground);
            varying->background = offsets(varying->background);
        }
    }
    append_part(to.root, from.root, offsets);
    for (const Part& part : from.prototypes) {
        Part copy;
        copy.name = part.name;
        append_part(copy, part, offsets);
        to.prototypes.push_back(std::move(copy));
    }
    append(to.views, from.views);
    append(to.grids, from.grids);
}

void append_import(Imported& to, const Imported& from)
{
    append_scene(to.scene, from.scene);
    append(to.keys, from.keys);
    for (const auto& material : from.file_materials) {
        const bool known = std::any_of(to.file_materials.begin(), to.file_materials.end(),
                                       [&](const auto& other) { return other.first == material.first; });
        if (!known)
            to.file_materials.push_back(material);
    }
    to.unit += (to.unit.empty() ? "" : "; ") + from.unit;
    to.ledger.add(from.ledger);
    to.report.add(from.report);
}

} // namespace lightwell
