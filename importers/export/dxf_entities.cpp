#include "importers/export/dxf_entities.h"

#include "engine/scene/expansion.h"
#include "importers/export/dxf_insert.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

bool is_placeholder(const Imported& model, ModifierId modifier)
{
    return modifier != void_modifier &&
           std::holds_alternative<Inherited>(model.scene.modifiers[static_cast<std::size_t>(modifier)].what);
}

/// 0xRRGGBB in sRGB, as group 420 has it.
int true_colour_of(const Spectrum& linear)
{
    int rgb = 0;
    for (int channel = 0; channel < 3; ++channel)
        rgb = rgb * 256 + static_cast<int>(std::lround(255 * linear_to_srgb(std::clamp(linear[channel], 0.0, 1.0))));
    return rgb;
}

} // namespace

void DxfEntities::find_layers_by_insert()
{
    layer_by_insert_.resize(model_.scene.modifiers.size());
    const auto look = [&](const Part& part) {
        for (const Instance& instance : part.instances)
            for (const Binding& binding : instance.bindings)
                if (key_of(model_, binding.actual).layer != key_of(model_, binding.inherited).layer)
                    layer_by_insert_[static_cast<std::size_t>(binding.inherited)] = true;
    };
    for (const Part& part : model_.scene.prototypes)
        look(part);
    look(model_.scene.root);
}

void DxfEntities::begin(const char* type, ModifierId modifier)
{
    const SurfaceKey& key = key_of(model_, modifier);
    const bool waits = is_placeholder(model_, modifier);
    tags_.begin(type, owner_);
    tags_.tag(100, "AcDbEntity");
    tags_.name(8, waits && layer_by_insert_[static_cast<std::size_t>(modifier)] ? "0" : key.layer);
    if (waits)
        tags_.tag(62, 0); // by block
    else if (key.colour)
        tags_.tag(420, true_colour_of(*key.colour));
}

void DxfEntities::write_block(const Part* part, const DxfBlock& block)
{
    owner_ = block.record;
    tags_.begin("BLOCK", owner_);
    tags_.tag(100, "AcDbEntity");
    tags_.tag(8, "0");
    tags_.tag(100, "AcDbBlockBegin");
    tags_.name(2, block.name);
    tags_.tag(70, 0);
    tags_.point(10, {});
    tags_.name(3, block.name);
    tags_.tag(1, "");
    if (part)
        write_part(*part, block.record);
    tags_.begin("ENDBLK", owner_);
    tags_.tag(100, "AcDbEntity");
    tags_.tag(8, "0");
    tags_.tag(100, "AcDbBlockEnd");
}

void DxfEntities::write_part(const Part& part, const std::string& owner)
{
    owner_ = owner;
    // Surfaces of one entity share its name and stand together.
    for (std::size_t first = 0; first < part.surfaces.size();) {
        std::size_t last = first + 1;
        while (last < part.surfaces.size() && part.surfaces[last].name == part.surfaces[first].name &&
               part.surfaces[last].modifier == part.surfaces[first].modifier &&
               part.surfaces[first].shape != Shape::instance)
            ++last;
        write_entity(part, first, last);
        first = last;
    }
}

void DxfEntities::write_entity(const Part& part, std::size_t first, std::size_t last)
{
    if (part.surfaces[first].shape == Shape::instance) {
        write_instance(part.instances[part.surfaces[first].index]);
        return;
    }
    if (write_circle(part, first, last))
        return;
    const ModifierId modifier = part.surfaces[first].modifier;
    std::vector<Face> faces;
    bool approximated = false;
    for (std::size_t i = first; i < last; ++i) {
        const Surface& surface = part.surfaces[i];
        if (surface.shape == Shape::ring)
            write_ring(part.rings[surface.index], modifier);
        else if (surface.shape == Shape::cylinder || surface.shape == Shape::tube)
            write_cylinder(part.cones[surface.index], surface.shape == Shape::tube, modifier);
        else if (surface.shape == Shape::source)
            report_.add(Finding::ignored, surface.name, "distant sources are not written: DXF has none");
        else
            for (Face& face : faces_of(part, surface, options_.chord_tolerance_m, approximated))
                faces.push_back(std::move(face));
        if (surface.shape == Shape::tube && part.cones[surface.index].sector.is_whole())
            report_.add(Finding::approximated, surface.name, "the inward side of a tube is written as a cylinder");
    }
    if (approximated)
        report_.add(Finding::approximated, part.surfaces[first].name, "cones and spheres are written as facets");
    write_faces(faces, modifier);
}

/// A cylinder with both its discs is a circle with thickness.
bool DxfEntities::write_circle(const Part& part, std::size_t first, std::size_t last)
{
    if (last - first != 3 || part.surfaces[first].shape != Shape::cylinder ||
        !part.cones[part.surfaces[first].index].sector.is_whole() || part.surfaces[first + 1].shape != Shape::ring ||
        part.surfaces[first + 2].shape != Shape::ring)
        return false;
    const Cone& cone = part.cones[part.surfaces[first].index];
    for (std::size_t end = 0; end < 2; ++end) {
        const Ring& disc = part.rings[part.surfaces[first + 1 + end].index];
        if (!disc.sector.is_whole() || !(disc.centre == cone.ends[end]) || disc.inner_radius != 0 ||
            disc.outer_radius != cone.radii[end])
            return false;
    }
    const Vec3 height = cone.ends[1] - cone.ends[0];
    const Affine axes = object_axes_of(normalized(height));
    begin("CIRCLE", part.surfaces[first].modifier);
    tags_.tag(100, "AcDbCircle");
    tags_.number(39, length(height));
    tags_.point(10, {dot(axes.x, cone.ends[0]), dot(axes.y, cone.ends[0]), dot(axes.z, cone.ends[0])});
    tags_.number(40, cone.radii[0]);
    tags_.point(210, axes.z);
    return true;
}

/// Two half circles of equal width, what programs call a donut; of part of a turn one arc.
void DxfEntities::write_turned_polyline(const Point& centre, const Direction& normal, const Sector& sector,
                                        const Drawn& drawn, ModifierId modifier)
{
    const Affine axes = object_axes_of(normal);
    const bool whole = sector.is_whole();
    const Point middle{dot(axes.x, centre), dot(axes.y, centre), dot(axes.z, centre)};
    begin("LWPOLYLINE", modifier);
    tags_.tag(100, "AcDbPolyline");
    tags_.tag(90, 2);
    tags_.tag(70, whole ? 1 : 0);
    tags_.number(43, drawn.width);
    tags_.number(38, middle.z);
    tags_.number(39, drawn.thickness);
    const Frame frame = whole ? Frame{-axes.x, -axes.y, axes.z} : sector_frame(sector, axes.z);
    const Vec3 start = frame.x;
    const Vec3 end = whole ? -start : start * std::cos(sector.sweep_rad) + frame.y * std::sin(sector.sweep_rad);
    const double bulge = whole ? 1 : std::tan(sector.sweep_rad / 4);
    for (const bool first : {true, false}) {
        const Vec3 out = first == drawn.clockwise ? end : start;
        tags_.number(10, middle.x + dot(axes.x, out) * drawn.radius);
        tags_.number(20, middle.y + dot(axes.y, out) * drawn.radius);
        tags_.number(42, !whole && !first ? 0 : drawn.clockwise ? -bulge : bulge);
    }
    tags_.point(210, axes.z);
}

void DxfEntities::write_ring(const Ring& ring, ModifierId modifier)
{
    write_turned_polyline(
        ring.centre, ring.normal, ring.sector,
        {(ring.inner_radius + ring.outer_radius) / 2, ring.outer_radius - ring.inner_radius, 0, false}, modifier);
}

void DxfEntities::write_cylinder(const Cone& cone, bool inwards, ModifierId modifier)
{
    const Vec3 height = cone.ends[1] - cone.ends[0];
    write_turned_polyline(cone.ends[0], normalized(height), cone.sector,
                          {cone.radii[0], 0, length(height), inwards && !cone.sector.is_whole()}, modifier);
}

void DxfEntities::write_faces(const std::vector<Face>& faces, ModifierId modifier)
{
    if (faces.empty())
        return;
    if (faces.size() > 1 || faces[0].size() > 4)
        return write_mesh(faces, modifier);
    begin("3DFACE", modifier);
    tags_.tag(100, "AcDbFace");
    for (std::size_t i = 0; i < 4; ++i)
        tags_.point(10 + static_cast<int>(i), faces[0][std::min(i, faces[0].size() - 1)]);
}

void DxfEntities::write_mesh(const std::vector<Face>& faces, ModifierId modifier)
{
    std::size_t corners = 0;
    for (const Face& face : faces)
        corners += face.size();
    begin("MESH", modifier);
    tags_.tag(100, "AcDbSubDMesh");
    tags_.tag(71, 2);
    tags_.tag(72, 0);
    tags_.tag(91, 0); // no subdivision
    tags_.tag(92, static_cast<std::int64_t>(corners));
    for (const Face& face : faces)
        for (const Point& corner : face)
            tags_.point(10, corner);
    tags_.tag(93, static_cast<std::int64_t>(corners + faces.size()));
    std::int64_t next = 0;
    for (const Face& face : faces) {
        tags_.tag(90, static_cast<std::int64_t>(face.size()));
        for (std::size_t i = 0; i < face.size(); ++i)
            tags_.tag(90, next++);
    }
    tags_.tag(94, 0);
    tags_.tag(95, 0);
    tags_.tag(90, 0);
}

std::optional<ModifierId> DxfEntities::style_of(const Instance& instance) const
{
    ModifierId style = void_modifier;
    for (const Binding& binding : instance.bindings) {
        const bool decides = layer_by_insert_[static_cast<std::size_t>(binding.inherited)];
        if (style == void_modifier || (decides && !layer_by_insert_[static_cast<std::size_t>(style)]))
            style = binding.actual;
        else if (decides && key_of(model_, binding.actual).layer != key_of(model_, style).layer)
            return std::nullopt;
    }
    return style;
}

void DxfEntities::write_instance(const Instance& instance)
{
    const std::optional<DxfInsert> insert = insert_of(instance.to_parent);
    const std::optional<ModifierId> style = style_of(instance);
    if (!insert || !style) {
        report_.add(Finding::approximated, model_.scene.prototypes[instance.prototype].name,
                    insert ? "an instance that gives its parts several layers is written out"
                           : "an instance whose map shears is written out");
        write_out(instance, {}, {});
        return;
    }
    begin("INSERT", *style);
    tags_.tag(100, "AcDbBlockReference");
    tags_.name(2, blocks_[instance.prototype + 2].name);
    tags_.point(10, insert->place);
    tags_.number(41, insert->scale.x);
    tags_.number(42, insert->scale.y);
    tags_.number(43, insert->scale.z);
    tags_.number(50, insert->turn_deg);
    tags_.point(210, insert->extrusion);
}

void DxfEntities::write_out(const Instance& instance, const Affine& outer, const std::vector<Binding>& bindings)
{
    const Affine map = compose(outer, instance.to_parent);
    std::vector<Binding> inner = instance.bindings;
    for (Binding& binding : inner)
        binding.actual = bound_modifier(model_.scene, binding.actual, bindings);
    const Part& part = model_.scene.prototypes[instance.prototype];
    for (const Surface& surface : part.surfaces) {
        if (surface.shape == Shape::instance) {
            write_out(part.instances[surface.index], map, inner);
            continue;
        }
        bool approximated = false;
        std::vector<Face> faces = faces_of(part, surface, options_.chord_tolerance_m, approximated);
        map_faces(faces, map);
        if (approximated)
            report_.add(Finding::approximated, surface.name, "round shapes of an instance written out become facets");
        write_faces(faces, bound_modifier(model_.scene, surface.modifier, inner));
    }
}

} // namespace lightwell
