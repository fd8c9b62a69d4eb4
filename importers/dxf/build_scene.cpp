#include "importers/dxf/build_scene.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/dxf/account.h"
#include "importers/dxf/block_plan.h"
#include "importers/dxf/deviations.h"
#include "importers/dxf/lights.h"
#include "importers/dxf/settle_styles.h"
#include "importers/dxf/styles.h"
#include "importers/dxf/views.h"
#include "importers/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

namespace lightwell::dxf {
namespace {

/// Each is a source that shadow rays may aim at.
constexpr std::size_t most_lights = 100'000;
constexpr SkipReason empty_block{"its block has no surfaces"};

/// An insert of a block that draws no surface.
struct DrawnSymbol {
    Affine to_frame; ///< from the coordinates of its block
    SurfaceClass what;
    std::string name;
};
/// More than this are hatching, not luminaires.
constexpr std::size_t most_symbols = 200'000;

/// A block that has become a prototype, and the classes of its surfaces that wait for an insert.
struct Prototype {
    bool has_surfaces = false;
    std::uint32_t index = 0;
    std::vector<SurfaceClass> waiting;
    std::vector<DrawnLight> lights; ///< in the coordinates of the block
    std::vector<DrawnSymbol> symbols;
    std::uint32_t block_name = no_index;
};

/// What is being filled: the model or a prototype.
struct Target {
    Part part;
    const BlockUse* use = nullptr; ///< nullptr: the model
    std::uint32_t block_name = no_index;
    Affine to_metres;
    Affine turn;                ///< the rotation in to_metres
    double metres_per_unit = 1; ///< of the largest copy in the model
    std::vector<SurfaceClass> waiting;
    std::vector<DrawnLight> lights;
    std::vector<DrawnSymbol> symbols;
};

class SceneBuilder {
public:
    SceneBuilder(const Drawing& drawing, MetresPerUnit unit, const ImportOptions& options, Imported& imported);
    void build(bool y_up);

private:
    Prototype build_prototype(const BlockUse& use);
    void fill(Target& target, const EntityRange& range);
    Reason add_entity(Target& target, const Entity& entity);
    Reason add_insert(Target& target, const Entity& insert, std::size_t index);
    Reason add_light_to(Target& target, const Entity& light);
    void add_lights_of(Target& target, const Entity& insert, const Prototype& prototype, const Affine& to_frame);
    void add_symbols_of(Target& target, const Entity& insert, const Prototype& prototype, const InsertFrame& frame,
                        const std::string& name);
    void add_shapes_to(Target& target, const Entity& entity);
    std::vector<Binding> bindings(Target& target, const Entity& insert, const Prototype& prototype);
    ModifierId modifier_in(Target& target, const SurfaceClass& what);
    void count_deviations(const Target& target, const Entity& entity);
    std::string name_of_insert(const Entity& insert, std::size_t index) const;
    void report_unused_blocks(const std::vector<BlockUse>& used);

    const Drawing& drawing_;
    const MetresPerUnit unit_;
    const ImportOptions& options_;
    Imported& imported_;
    ModifierTable modifiers_;
    std::vector<double> raised_m_; ///< for each layer
    std::vector<Reason> outcomes_; ///< for each entity; nullptr: not part of the model
    Repairs repairs_;
    const char* repair_ = nullptr;                            ///< of the entity at hand
    std::unordered_map<std::size_t, std::string> attributes_; ///< of inserts, by their entity
    std::map<std::pair<std::uint32_t, bool>, Prototype> prototypes_;
    Shapes shapes_;
    DeviationTotal deviations_;
};

/// How far the outlines of each layer are raised; a rule that fits no layer is noted.
std::vector<double> raised_layers(const Drawing& drawing, const ImportOptions& options, Report& report)
{
    std::vector<double> raised_m(drawing.layers.size(), 0);
    for (const RaisedLayer& rule : options.raised) {
        bool fits = false;
        for (std::size_t i = 0; i < drawing.layers.size(); ++i)
            if (matches(rule.layer, drawing.layers[i].name)) {
                raised_m[i] = rule.height_m;
                fits = true;
            }
        if (!fits)
            report.add(Finding::unused, drawing.file(),
                       fmt::format("no layer is named like \"{}\", which was to be raised", rule.layer));
    }
    return raised_m;
}

/// What inserts carry as texts, `TAG=TEXT` with commas between.
std::unordered_map<std::size_t, std::string> attributes_of(const Drawing& drawing)
{
    constexpr std::size_t longest = 64; // bytes; longer ones are descriptions
    std::unordered_map<std::size_t, std::string> attributes;
    for (const Attribute& attribute : drawing.attributes)
        if (!attribute.text.empty() && attribute.text.size() <= longest) {
            std::string& list = attributes[attribute.insert];
            list += (list.empty() ? "" : ",") + attribute.tag + "=" + attribute.text;
        }
    return attributes;
}

SceneBuilder::SceneBuilder(const Drawing& drawing, MetresPerUnit unit, const ImportOptions& options, Imported& imported)
    : drawing_(drawing), unit_(unit), options_(options), imported_(imported), modifiers_(drawing, imported),
      raised_m_(raised_layers(drawing, options, imported.report)), outcomes_(drawing.entities.size(), nullptr),
      attributes_(attributes_of(drawing)), deviations_(drawing)
{
}

void SceneBuilder::build(bool y_up)
{
    static constexpr SkipReason paper{"in paper space"};
    const std::vector<BlockUse> plan = plan_blocks(drawing_);
    for (const BlockUse& use : plan)
        prototypes_[{use.block, use.hides_layer_zero}] = build_prototype(use);
    Target model;
    model.to_metres = to_metres_z_up(unit_, y_up);
    model.turn = to_metres_z_up(MetresPerUnit{1}, y_up);
    model.metres_per_unit = unit_.value;
    for (const EntityRange& range : drawing_.model)
        fill(model, range);
    imported_.scene.root = std::move(model.part);
    for (const DrawnLight& light : model.lights)
        add_light(drawing_, light, model.to_metres, modifiers_, imported_);
    for (const DrawnSymbol& symbol : model.symbols)
        imported_.bare_inserts.push_back(
            {modifiers_.key_of(symbol.what), compose(model.to_metres, symbol.to_frame), symbol.name});
    for (const EntityRange& range : drawing_.paper)
        std::fill_n(outcomes_.begin() + static_cast<std::ptrdiff_t>(range.first), range.count, &paper);
    settle_common_styles(imported_.scene);
    account(drawing_, outcomes_, repairs_, imported_);
    deviations_.report(imported_.report);
    if (imported_.ledger.made_count() == 0)
        imported_.report.add(Finding::ignored, drawing_.file(),
                             fmt::format("none of the {} entities has a surface: outlines and texts only; export faces "
                                         "(3DFACE, polyface mesh), give the lines a thickness, or raise their layers",
                                         imported_.ledger.read_count()));
    report_unused_blocks(plan);
    add_views(drawing_, model.to_metres, imported_);
}

Prototype SceneBuilder::build_prototype(const BlockUse& use)
{
    Target target;
    target.use = &use;
    const auto name = std::find(drawing_.block_of_name.begin(), drawing_.block_of_name.end(), use.block);
    target.block_name = static_cast<std::uint32_t>(name - drawing_.block_of_name.begin());
    target.part.name = drawing_.block_names[target.block_name];
    target.to_metres = Affine::scale(unit_.value);
    target.metres_per_unit = unit_.value * use.largest_scale;
    fill(target, drawing_.blocks[use.block].entities);
    if (target.part.surfaces.empty())
        return {false, 0, {}, std::move(target.lights), std::move(target.symbols), target.block_name};
    imported_.scene.prototypes.push_back(std::move(target.part));
    return {true,
            static_cast<std::uint32_t>(imported_.scene.prototypes.size() - 1),
            std::move(target.waiting),
            std::move(target.lights),
            std::move(target.symbols),
            target.block_name};
}

/// Room for what a range of entities is likely to become, so that large parts are not copied while they grow.
void reserve(Part& part, const Drawing& drawing, const EntityRange& range)
{
    std::size_t faces = 0, inserts = 0;
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        faces += drawing.entities[i].kind == Kind::face;
        inserts += drawing.entities[i].kind == Kind::insert;
    }
    part.surfaces.reserve(faces + inserts);
    part.polygons.reserve(faces);
    part.points.reserve(4 * faces);
    part.instances.reserve(inserts);
}

void SceneBuilder::fill(Target& target, const EntityRange& range)
{
    if (target.part.surfaces.empty())
        reserve(target.part, drawing_, range);
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        const Entity& entity = drawing_.entities[i];
        repair_ = nullptr;
        Reason reason = hidden_reason(drawing_, entity, target.use);
        if (!reason)
            reason = entity.kind == Kind::insert ? add_insert(target, entity, i) : add_entity(target, entity);
        if (!reason && repair_)
            repairs_[i] = repair_;
        if (!reason)
            outcomes_[i] = &made;
        else if (outcomes_[i] != &made) // a block can be used both with and without its layer 0
            outcomes_[i] = reason;
    }
}

Reason SceneBuilder::add_entity(Target& target, const Entity& entity)
{
    if (entity.kind == Kind::light)
        return add_light_to(target, entity);
    shapes_.clear();
    const ShapeOptions options{options_.chord_tolerance_m / target.metres_per_unit,
                               raised_m_[entity.layer] / target.metres_per_unit};
    if (const Reason reason = add_shapes(drawing_, entity, options, shapes_))
        return reason;
    count_deviations(target, entity);
    if (shapes_.deviations.split_faces > 0)
        repair_ = "corners out of plane: cut into triangles";
    add_shapes_to(target, entity);
    return nullptr;
}

Reason SceneBuilder::add_light_to(Target& target, const Entity& light)
{
    if (const Reason dark = dark_reason(light))
        return dark;
    target.lights.push_back(
        {&light, Affine{}, {style_of(drawing_, light, target.use != nullptr), light.type, target.block_name}});
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
    // The map to metres mirrors nothing: sectors turn as directions do.
    const auto turned = [&](const Sector& sector) {
        return Sector{target.turn.vector(sector.start), sector.sweep_rad};
    };
    for (const auto& [cone, shape] : shapes_.cones)
        target.part.add_cone({{map.point(cone.ends[0]), map.point(cone.ends[1])},
                              {cone.radii[0] * unit, cone.radii[1] * unit},
                              turned(cone.sector)},
                             shape, modifier, name);
    for (Mesh& mesh : shapes_.meshes) {
        for (Point& point : mesh.points)
            point = map.point(point);
        for (Direction& normal : mesh.normals)
            normal = target.turn.vector(normal);
        target.part.add_mesh(std::make_shared<const Mesh>(std::move(mesh)), modifier, name);
    }
    for (const Ring& ring : shapes_.rings)
        target.part.add_ring({map.point(ring.centre), target.turn.vector(ring.normal), ring.inner_radius * unit,
                              ring.outer_radius * unit, turned(ring.sector)},
                             modifier, name);
}

ModifierId SceneBuilder::modifier_in(Target& target, const SurfaceClass& what)
{
    if (what.style.depends_on_insert() &&
        std::find(target.waiting.begin(), target.waiting.end(), what) == target.waiting.end())
        target.waiting.push_back(what);
    return modifiers_.modifier_for(what);
}

Reason SceneBuilder::add_insert(Target& target, const Entity& insert, std::size_t index)
{
    BlockUse use;
    if (const Reason reason = find_inserted(drawing_, insert, target.use, use))
        return reason;
    const Prototype& prototype = prototypes_.at({use.block, use.hides_layer_zero});
    const InsertFrame frame = insert_frame(drawing_, insert);
    add_symbols_of(target, insert, prototype, frame, name_of_insert(insert, index));
    if (!prototype.has_surfaces && prototype.lights.empty())
        return &empty_block;
    if (frame.has_zero_scale) {
        repair_ = "scale of 0 taken as 1";
        imported_.report.add(Finding::repaired, drawing_.place(insert), "scale of an insert is 0; 1 is used");
    }
    Instance instance{prototype.index, {}, bindings(target, insert, prototype)};
    const std::string name = name_of_insert(insert, index);
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 0; column < frame.columns; ++column) {
            Affine to_frame = frame.first;
            to_frame.translation += frame.column_step * column + frame.row_step * row;
            instance.to_parent = {target.turn.vector(to_frame.x), target.turn.vector(to_frame.y),
                                  target.turn.vector(to_frame.z), target.to_metres.point(to_frame.translation)};
            if (prototype.has_surfaces)
                target.part.add_instance(instance, name);
            add_lights_of(target, insert, prototype, to_frame);
        }
    return nullptr;
}

std::string SceneBuilder::name_of_insert(const Entity& insert, std::size_t index) const
{
    const auto attributes = attributes_.find(index);
    return drawing_.name(insert) + (attributes == attributes_.end() ? "" : "{" + attributes->second + "}");
}

void SceneBuilder::add_lights_of(Target& target, const Entity& insert, const Prototype& prototype,
                                 const Affine& to_frame)
{
    if (target.lights.size() + prototype.lights.size() > most_lights)
        throw InputError{drawing_.place(insert),
                         fmt::format("the drawing has more than {} lights with its copies of blocks", most_lights),
                         "map their layer to an emitting material instead"};
    const Style style = style_of(drawing_, insert, target.use != nullptr);
    for (DrawnLight light : prototype.lights) {
        light.to_frame = compose(to_frame, light.to_frame);
        light.what.style = inserted_style(drawing_, light.what.style, style);
        target.lights.push_back(light);
    }
}

void SceneBuilder::add_symbols_of(Target& target, const Entity& insert, const Prototype& prototype,
                                  const InsertFrame& frame, const std::string& name)
{
    const std::size_t copies = std::size_t{frame.rows} * frame.columns;
    const std::size_t each = prototype.symbols.size() + (prototype.has_surfaces ? 0 : 1);
    if (each == 0 || copies > most_symbols || target.symbols.size() + copies * each > most_symbols)
        return;
    const Style style = style_of(drawing_, insert, target.use != nullptr);
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 0; column < frame.columns; ++column) {
            Affine to_frame = frame.first;
            to_frame.translation += frame.column_step * column + frame.row_step * row;
            if (!prototype.has_surfaces)
                target.symbols.push_back({to_frame, {style, insert.type, prototype.block_name}, name});
            for (DrawnSymbol symbol : prototype.symbols) {
                symbol.to_frame = compose(to_frame, symbol.to_frame);
                symbol.what.style = inserted_style(drawing_, symbol.what.style, style);
                symbol.name = name + '/' + symbol.name;
                target.symbols.push_back(std::move(symbol));
            }
        }
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
    deviations_.add(entity, shapes_.deviations, target.metres_per_unit);
    const std::size_t most = most_facets + further_facets_for_each_entity * drawing_.entities.size();
    if (shapes_.deviations.chords > most_facets || deviations_.chords() > most)
        throw InputError{drawing_.place(entity),
                         fmt::format("curves need more than {} facets at a chord tolerance of {} m", most_facets,
                                     options_.chord_tolerance_m),
                         "allow a larger tolerance or correct the radius"};
}

void SceneBuilder::report_unused_blocks(const std::vector<BlockUse>& used)
{
    std::vector<bool> is_used(drawing_.blocks.size(), false);
    for (const BlockUse& use : used)
        is_used[use.block] = true;
    std::size_t unused = 0;
    for (std::size_t name = 0; name < drawing_.block_names.size(); ++name) {
        const std::uint32_t block = drawing_.block_of_name[name];
        if (block == no_index || is_used[block] || drawing_.blocks[block].source != BlockSource::drawing)
            continue;
        const std::string_view whole{drawing_.block_names[name]};
        const std::string_view own = whole.substr(whole.rfind('|') + 1); // without the references it came through
        if (!own.starts_with('*') && !own.starts_with('$'))
            ++unused;
    }
    if (unused > 0)
        imported_.report.add(Finding::ignored, drawing_.file(), "blocks that nothing in the model shows", unused);
}

} // namespace

void build_scene(const Drawing& drawing, MetresPerUnit unit, const ImportOptions& options, Imported& imported)
{
    SceneBuilder{drawing, unit, options, imported}.build(options.up == "y");
}

} // namespace lightwell::dxf
