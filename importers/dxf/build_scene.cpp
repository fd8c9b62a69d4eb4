#include "importers/dxf/build_scene.h"

#include "engine/base/errors.h"
#include "importers/dxf/block_plan.h"
#include "importers/dxf/styles.h"
#include "importers/units.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightwell::dxf {
namespace {

constexpr SkipReason made{"made"};
/// A facet takes some 200 bytes: a gigabyte. Only a damaged radius or a tolerance without sense needs more.
constexpr std::size_t most_facets = 5'000'000;
constexpr SkipReason empty_block{"its block has no surfaces"};

/// A block that has become a prototype, and the classes of its surfaces that wait for an insert.
struct Prototype {
    bool has_surfaces = false;
    std::uint32_t index = 0;
    std::vector<SurfaceClass> waiting;
};

/// What is being filled: the model or a prototype.
struct Target {
    Part part;
    const BlockUse* use = nullptr; ///< nullptr: the model
    std::uint32_t block_name = no_index;
    Affine to_metres;
    Affine turn;          ///< the rotation in to_metres
    double tolerance = 0; ///< drawing units
    std::vector<SurfaceClass> waiting;

    double largest_scale() const { return use ? use->largest_scale : 1; }
};

/// Sums of Deviations, in metres of the model.
struct DeviationTotal {
    std::size_t chords = 0, split_quads = 0;
    double chord_error_m = 0, out_of_plane_m = 0;
    std::string first_arc, first_quad;
};

class SceneBuilder {
public:
    SceneBuilder(const Drawing& drawing, MetresPerUnit unit, double chord_tolerance_m, Imported& imported)
        : drawing_(drawing), unit_(unit), chord_tolerance_m_(chord_tolerance_m), imported_(imported),
          modifiers_(drawing, imported), outcomes_(drawing.entities.size(), nullptr)
    {
    }
    void build(bool y_up);

private:
    Prototype build_prototype(const BlockUse& use);
    void fill(Target& target, const EntityRange& range);
    Reason add_entity(Target& target, const Entity& entity);
    Reason add_insert(Target& target, const Entity& insert);
    void add_shapes_to(Target& target, const Entity& entity);
    std::vector<Binding> bindings(Target& target, const Entity& insert, const Prototype& prototype);
    ModifierId modifier_in(Target& target, const SurfaceClass& what);
    void count_deviations(const Target& target, const Entity& entity);
    void fill_ledger();
    void report_deviations();
    void report_unused_blocks(const std::vector<BlockUse>& used);

    const Drawing& drawing_;
    const MetresPerUnit unit_;
    const double chord_tolerance_m_;
    Imported& imported_;
    ModifierTable modifiers_;
    std::vector<Reason> outcomes_; ///< for each entity; nullptr: not part of the model
    std::map<std::pair<std::uint32_t, bool>, Prototype> prototypes_;
    Shapes shapes_;
    DeviationTotal deviations_;
};

void SceneBuilder::build(bool y_up)
{
    const std::vector<BlockUse> plan = plan_blocks(drawing_);
    for (const BlockUse& use : plan)
        prototypes_[{use.block, use.hides_layer_zero}] = build_prototype(use);
    Target model;
    model.to_metres = to_metres_z_up(unit_, y_up);
    model.turn = to_metres_z_up(MetresPerUnit{1}, y_up);
    model.tolerance = chord_tolerance_m_ / unit_.value;
    for (const EntityRange& range : drawing_.model)
        fill(model, range);
    imported_.scene.root = std::move(model.part);
    fill_ledger();
    report_deviations();
    if (imported_.ledger.made_count() == 0)
        imported_.report.add(Finding::ignored, drawing_.file,
                             fmt::format("none of the {} entities has a surface: outlines and texts only; export faces "
                                         "(3DFACE, polyface mesh) or give the lines a thickness",
                                         imported_.ledger.read_count()));
    report_unused_blocks(plan);
}

Prototype SceneBuilder::build_prototype(const BlockUse& use)
{
    Target target;
    target.use = &use;
    const auto name = std::find(drawing_.block_of_name.begin(), drawing_.block_of_name.end(), use.block);
    target.block_name = static_cast<std::uint32_t>(name - drawing_.block_of_name.begin());
    target.part.name = drawing_.block_names[target.block_name];
    target.to_metres = Affine::scale(unit_.value);
    target.tolerance = chord_tolerance_m_ / (unit_.value * use.largest_scale);
    fill(target, drawing_.blocks[use.block].entities);
    if (target.part.surfaces.empty())
        return {};
    imported_.scene.prototypes.push_back(std::move(target.part));
    return {true, static_cast<std::uint32_t>(imported_.scene.prototypes.size() - 1), std::move(target.waiting)};
}

void SceneBuilder::fill(Target& target, const EntityRange& range)
{
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        const Entity& entity = drawing_.entities[i];
        Reason reason = hidden_reason(drawing_, entity, target.use);
        if (!reason)
            reason = add_entity(target, entity);
        if (!reason)
            outcomes_[i] = &made;
        else if (outcomes_[i] != &made) // a block can be used both with and without its layer 0
            outcomes_[i] = reason;
    }
}

Reason SceneBuilder::add_entity(Target& target, const Entity& entity)
{
    if (entity.kind == Kind::insert)
        return add_insert(target, entity);
    shapes_.clear();
    if (const Reason reason = add_shapes(drawing_, entity, target.tolerance, shapes_))
        return reason;
    add_shapes_to(target, entity);
    count_deviations(target, entity);
    return nullptr;
}

void SceneBuilder::add_shapes_to(Target& target, const Entity& entity)
{
    const SurfaceClass what{style_of(drawing_, entity, target.use != nullptr), entity.type, target.block_name};
    const ModifierId modifier = modifier_in(target, what);
    const std::string name = drawing_.name(entity);
    const Affine& map = target.to_metres;
    const double unit = unit_.value;
    std::vector<Point> corners;
    shapes_.for_each_polygon([&](std::span<const Point> polygon) {
        corners.clear();
        for (const Point& corner : polygon)
            corners.push_back(map.point(corner));
        target.part.add_polygon(corners, modifier, name);
    });
    for (const auto& [cone, shape] : shapes_.cones)
        target.part.add_cone(
            {{map.point(cone.ends[0]), map.point(cone.ends[1])}, {cone.radii[0] * unit, cone.radii[1] * unit}}, shape,
            modifier, name);
    for (const Ring& ring : shapes_.rings)
        target.part.add_ring({map.point(ring.centre), target.turn.vector(ring.normal), ring.inner_radius * unit,
                              ring.outer_radius * unit},
                             modifier, name);
}

ModifierId SceneBuilder::modifier_in(Target& target, const SurfaceClass& what)
{
    if (what.style.depends_on_insert() &&
        std::find(target.waiting.begin(), target.waiting.end(), what) == target.waiting.end())
        target.waiting.push_back(what);
    return modifiers_.modifier_for(what);
}

Reason SceneBuilder::add_insert(Target& target, const Entity& insert)
{
    BlockUse use;
    if (const Reason reason = find_inserted(drawing_, insert, target.use, use))
        return reason;
    const Prototype& prototype = prototypes_.at({use.block, use.hides_layer_zero});
    if (!prototype.has_surfaces)
        return &empty_block;
    const InsertFrame frame = insert_frame(drawing_, insert);
    if (frame.has_zero_scale)
        imported_.report.add(Finding::repaired, drawing_.place(insert), "scale of an insert is 0; 1 is used");
    Instance instance{prototype.index, {}, bindings(target, insert, prototype)};
    const std::string name = drawing_.name(insert);
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 0; column < frame.columns; ++column) {
            const Vec3 step = frame.column_step * column + frame.row_step * row;
            instance.to_parent = {target.turn.vector(frame.first.x), target.turn.vector(frame.first.y),
                                  target.turn.vector(frame.first.z),
                                  target.to_metres.point(frame.first.translation + step)};
            target.part.add_instance(instance, name);
        }
    return nullptr;
}

std::vector<Binding> SceneBuilder::bindings(Target& target, const Entity& insert, const Prototype& prototype)
{
    const Style style = style_of(drawing_, insert, target.use != nullptr);
    std::vector<Binding> list;
    for (SurfaceClass what : prototype.waiting) {
        const ModifierId inherited = modifiers_.modifier_for(what);
        what.style = inserted_style(drawing_, what.style, style);
        list.push_back({inherited, modifier_in(target, what)});
    }
    return list;
}

void SceneBuilder::count_deviations(const Target& target, const Entity& entity)
{
    const Deviations& found = shapes_.deviations;
    const double metres = unit_.value * target.largest_scale();
    if (found.chords > 0 && deviations_.chords == 0)
        deviations_.first_arc = drawing_.place(entity);
    if (found.split_quads > 0 && deviations_.split_quads == 0)
        deviations_.first_quad = drawing_.place(entity);
    deviations_.chords += found.chords;
    if (deviations_.chords > most_facets)
        throw InputError{
            drawing_.place(entity),
            fmt::format("arcs need more than {} facets at a chord tolerance of {} m", most_facets, chord_tolerance_m_),
            "allow a larger tolerance or correct the radius"};
    deviations_.split_quads += found.split_quads;
    deviations_.chord_error_m = std::fmax(deviations_.chord_error_m, found.chord_error * metres);
    deviations_.out_of_plane_m = std::fmax(deviations_.out_of_plane_m, found.out_of_plane * metres);
}

void SceneBuilder::report_deviations()
{
    constexpr double mm_per_m = 1000;
    if (deviations_.chords > 0)
        imported_.report.add(Finding::approximated, deviations_.first_arc,
                             fmt::format("arcs became {} flat facets, at most {:.3g} mm from the arc",
                                         deviations_.chords, deviations_.chord_error_m * mm_per_m));
    if (deviations_.split_quads > 0)
        imported_.report.add(Finding::approximated, deviations_.first_quad,
                             fmt::format("four corners out of plane by up to {:.3g} mm: two triangles each",
                                         deviations_.out_of_plane_m * mm_per_m),
                             deviations_.split_quads);
}

void SceneBuilder::fill_ledger()
{
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
        const Reason outcome = outcomes_[i];
        if (!outcome)
            continue;
        const Entity& entity = drawing_.entities[i];
        const std::string& type = drawing_.types[entity.type];
        const std::string& layer = drawing_.layers[entity.layer].name;
        if (outcome == &made) {
            imported_.ledger.made(type, layer);
            continue;
        }
        imported_.ledger.skipped(type, layer, outcome->text);
        if (outcome->loses_surfaces)
            imported_.report.add(Finding::unsupported, drawing_.place(entity), type + ": " + outcome->text);
    }
}

void SceneBuilder::report_unused_blocks(const std::vector<BlockUse>& used)
{
    std::vector<bool> is_used(drawing_.blocks.size(), false);
    for (const BlockUse& use : used)
        is_used[use.block] = true;
    std::size_t unused = 0;
    for (std::size_t name = 0; name < drawing_.block_names.size(); ++name) {
        const std::uint32_t block = drawing_.block_of_name[name];
        const bool is_internal =
            drawing_.block_names[name].starts_with('*') || drawing_.block_names[name].starts_with('$');
        if (block != no_index && !is_used[block] && !is_internal)
            ++unused;
    }
    if (unused > 0)
        imported_.report.add(Finding::ignored, drawing_.file, "blocks that nothing in the model shows", unused);
}

} // namespace

void build_scene(const Drawing& drawing, MetresPerUnit unit, bool y_up, double chord_tolerance_m, Imported& imported)
{
    SceneBuilder{drawing, unit, chord_tolerance_m, imported}.build(y_up);
}

} // namespace lightwell::dxf
