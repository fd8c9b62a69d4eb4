#include "importers/luminaires.h"

#include "engine/base/errors.h"
#include "engine/scene/expansion.h"
#include "engine/scene/luminaire.h"
#include "importers/facing.h"
#include "importers/layer_rules.h"
#include "importers/surface_amounts.h"
#include "importers/touching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace lightwell {
namespace {

/// Right-handed turn about an axis of unit length.
Vec3 turned(const Vec3& v, const Direction& axis, double angle_rad)
{
    const Vec3 along = axis * dot(axis, v), across = v - along;
    return along + across * std::cos(angle_rad) + cross(axis, across) * std::sin(angle_rad);
}

/// A rotation whose -z is the aim and whose x lies as near as it can to `x`; mirrored at the plane of aim and x.
Affine frame_of(const Direction& aim, const Vec3& x, const Point& origin, bool mirrored = false)
{
    Vec3 across = x - aim * dot(aim, x);
    for (const Vec3& other : {Vec3{0, 1, 0}, Vec3{1, 0, 0}})
        if (!(length(across) > 1e-6 * length(x)))
            across = other - aim * dot(aim, other);
    const Direction first = normalized(across), up = -aim, second = cross(up, first);
    return {first, mirrored ? -second : second, up, origin};
}

/// What the map says beyond the frame that the drawing gives.
struct Aimed {
    Direction aim;
    Vec3 x;
};
Aimed aimed_by(const LayerRule& rule, Direction aim, Vec3 x, const Affine& frame)
{
    if (!(rule.aim == Vec3{}))
        aim = normalized(frame.vector(rule.aim));
    if (rule.turn_deg != 0)
        x = turned(x - aim * dot(aim, x), -aim, rule.turn_deg * radians_per_degree);
    return {aim, x};
}

/// Surfaces of one part that a rule's luminaire belongs to.
struct Body {
    std::vector<const Surface*> surfaces;
    std::vector<bool> shining;
    bool whole = false; ///< the insert is one luminaire, however many pieces it is drawn as
};

class Finder {
public:
    Finder(const Imported& imported, const LayerMap& map, const std::vector<Choice>& choices)
        : imported_(imported), scene_(imported.scene), map_(map), choices_(choices)
    {
        for (const Part& part : scene_.prototypes)
            concerned_.push_back(is_concerned(part));
    }
    std::vector<PlacedLuminaire> run()
    {
        visit(scene_.root, Affine{}, {}, "", true);
        for (const BareInsert& insert : imported_.bare_inserts)
            add_bare(insert);
        return std::move(found_);
    }

private:
    const LayerRule& rule(int index) const { return map_.rules[static_cast<std::size_t>(index)]; }
    const Choice* choice(ModifierId id) const
    {
        return id == void_modifier ? nullptr : &choices_[static_cast<std::size_t>(id)];
    }
    bool is_inherited(ModifierId id) const { return choice(id) && choice(id)->kind == Choice::Kind::inherited; }
    bool is_concerned(const Part& part) const;
    void visit(const Part& part, const Affine& to_world, const std::vector<Binding>& bindings, const std::string& name,
               bool root);
    void add_whole(int index, const Part& part, const Body& body, const Affine& to_world, const std::string& name);
    void add_groups(int index, const Part& part, const Body& body, const Affine& to_world);
    void add_group(int index, const Part& part, const Body& body, const std::vector<std::size_t>& group,
                   const Affine& to_world);
    void add_bare(const BareInsert& insert);
    void keep(int index, const Aimed& aimed, const Part& part, const Body& body, const std::vector<std::size_t>& group,
              const Affine& to_world, bool mirrored, const std::string& name);

    const Imported& imported_;
    const Scene& scene_;
    const LayerMap& map_;
    const std::vector<Choice>& choices_;
    std::vector<bool> concerned_; ///< by prototype: whether it or what it holds may be a luminaire
    std::vector<PlacedLuminaire> found_;
};

bool Finder::is_concerned(const Part& part) const
{
    for (const Surface& surface : part.surfaces)
        if (const Choice* own = choice(surface.modifier);
            own && (own->luminaire >= 0 || is_inherited(surface.modifier)))
            return true;
    for (const Instance& instance : part.instances)
        if (concerned_[instance.prototype])
            return true;
    return false;
}

void Finder::visit(const Part& part, const Affine& to_world, const std::vector<Binding>& bindings,
                   const std::string& name, bool root)
{
    std::map<int, Body> bodies;
    for (const Surface& surface : part.surfaces) {
        if (surface.shape == Shape::instance) {
            const Instance& instance = part.instances[surface.index];
            if (!concerned_[instance.prototype])
                continue;
            std::vector<Binding> inner;
            for (const Binding& binding : instance.bindings)
                inner.push_back({binding.inherited, bound_modifier(scene_, binding.actual, bindings)});
            visit(scene_.prototypes[instance.prototype], compose(to_world, instance.to_parent), inner, surface.name,
                  false);
            continue;
        }
        const Choice* chosen = choice(bound_modifier(scene_, surface.modifier, bindings));
        if (chosen == nullptr || chosen->luminaire < 0)
            continue;
        Body& body = bodies[chosen->luminaire];
        body.whole =
            body.whole || (!root && (!rule(chosen->luminaire).block.empty() || is_inherited(surface.modifier)));
        if (chosen->kind == Choice::Kind::dropped) { // it still says where the luminaire is
            body.surfaces.push_back(&surface);
            body.shining.push_back(false);
            continue;
        }
        body.surfaces.push_back(&surface);
        body.shining.push_back(chosen->definition != nullptr && is_emitter(*chosen->definition));
    }
    for (const auto& [index, body] : bodies) {
        if (body.whole)
            add_whole(index, part, body, to_world, name);
        else
            add_groups(index, part, body, to_world);
    }
}

/// @param group  of the body's surfaces
void Finder::keep(int index, const Aimed& aimed, const Part& part, const Body& body,
                  const std::vector<std::size_t>& group, const Affine& to_world, bool mirrored, const std::string& name)
{
    PlacedLuminaire placed{index, frame_of(aimed.aim, aimed.x, {}, mirrored), {}, false, name};
    for (const std::size_t i : group)
        placed.shining = placed.shining || body.shining[i];
    // The opening belongs to what shines; housings and poles may reach far beyond it.
    const Affine to_frame = compose(inverse(placed.frame), to_world);
    Box box;
    for (const std::size_t i : group)
        if (!placed.shining || body.shining[i])
            box.extend(surface_bounds(part, *body.surfaces[i], to_frame));
    placed.frame.translation = placed.frame.vector(box.centre());
    if (rule(index).use != "void")
        placed.body = (box.high - box.low) * 0.5;
    found_.push_back(std::move(placed));
}

void Finder::add_whole(int index, const Part& part, const Body& body, const Affine& to_world, const std::string& name)
{
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < body.surfaces.size(); ++i)
        all.push_back(i);
    const Aimed aimed =
        aimed_by(rule(index), normalized(to_world.vector(-imported_.up_in_parts)), normalized(to_world.x), to_world);
    keep(index, aimed, part, body, all, to_world, to_world.determinant() < 0, name);
}

void Finder::add_groups(int index, const Part& part, const Body& body, const Affine& to_world)
{
    std::vector<Box> boxes;
    for (const Surface* surface : body.surfaces)
        boxes.push_back(surface_bounds(part, *surface, to_world));
    for (const std::vector<std::size_t>& group : touching_groups(boxes))
        add_group(index, part, body, group, to_world);
}

void Finder::add_group(int index, const Part& part, const Body& body, const std::vector<std::size_t>& group,
                       const Affine& to_world)
{
    const Surface& first = *body.surfaces[group.front()];
    Direction aim{0, 0, -1};
    Vec3 along{};
    Facing facing;
    for (const std::size_t i : group)
        facing.add(part, *body.surfaces[i], to_world);
    if (facing.is_flat()) {
        aim = facing.aim();
        along = facing.along();
    } else {
        Box box;
        for (const std::size_t i : group)
            box.extend(surface_bounds(part, *body.surfaces[i], to_world));
        const Vec3 size = box.high - box.low;
        along = size.x >= size.y ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    }
    const Photometry::Opening& opening = rule(index).photometry->opening;
    if (opening.y_m > opening.x_m)
        along = cross(aim, along);
    const Aimed aimed = aimed_by(rule(index), aim, along, Affine{});
    keep(index, aimed, part, body, group, to_world, false, first.name);
}

void Finder::add_bare(const BareInsert& insert)
{
    for (int index = static_cast<int>(map_.rules.size()); index-- > 0;) {
        if (!places_luminaire(rule(index), insert.key))
            continue;
        const Affine& map = insert.to_scene;
        const Aimed aimed = aimed_by(rule(index), normalized(-map.z), normalized(map.x), map);
        found_.push_back(
            {index, frame_of(aimed.aim, aimed.x, map.translation, map.determinant() < 0), {}, false, insert.name});
        return;
    }
}

/// What openings are alike: they share a part.
struct Kind {
    std::filesystem::path file;
    Vec3 body;
    bool seen;
    double share;
    bool operator<(const Kind& other) const
    {
        const auto key = [](const Kind& k) {
            return std::tuple(k.file, k.body.x, k.body.y, k.body.z, k.seen, k.share);
        };
        return key(*this) < key(other);
    }
};

/// Lengths that differ by rounding only are the same.
Vec3 rounded(const Vec3& size)
{
    constexpr double step_m = 1e-5;
    const auto up = [](double x) { return std::ceil(x / step_m - 1e-3) * step_m; };
    return {up(size.x), up(size.y), up(size.z)};
}

std::string free_name(const Scene& scene, const std::string& wanted)
{
    std::string name = wanted;
    for (int number = 2; scene.find_modifier(name + ".light") != void_modifier; ++number)
        name = wanted + '-' + std::to_string(number);
    return name;
}

} // namespace

std::vector<PlacedLuminaire> find_luminaires(const Imported& imported, const LayerMap& map,
                                             const std::vector<Choice>& choices)
{
    for (const LayerRule& rule : map.rules)
        if (rule.photometry)
            return Finder{imported, map, choices}.run();
    return {};
}

void add_luminaires(Imported& imported, const LayerMap& map, const std::vector<PlacedLuminaire>& placed)
{
    Scene& scene = imported.scene;
    std::map<Kind, std::uint32_t> parts;
    for (const PlacedLuminaire& luminaire : placed) {
        const LayerRule& rule = map.rules[static_cast<std::size_t>(luminaire.rule)];
        const double tilt = std::acos(std::clamp(luminaire.frame.z.z, -1.0, 1.0)) / radians_per_degree;
        const Kind kind{rule.luminaire, rounded(luminaire.body), !luminaire.shining,
                        rule.photometry->share_tilted(tilt)};
        const auto [entry, fresh] = parts.try_emplace(kind, 0);
        if (fresh) {
            const std::string name = free_name(scene, kind.file.stem().string());
            scene.prototypes.push_back(
                luminaire_part(scene, *rule.photometry, {name, kind.seen, kind.share, kind.body}, imported.report));
            entry->second = static_cast<std::uint32_t>(scene.prototypes.size() - 1);
            while (imported.keys.size() < scene.modifiers.size())
                imported.keys.push_back({name, {}, {}, {}, "luminaire", {}});
        }
        scene.root.add_instance({entry->second, luminaire.frame, {}}, luminaire.name + "/luminaire");
        imported.report.add(Finding::converted, map.file.string() + ':' + std::to_string(rule.line),
                            "luminaire of " + rule.luminaire.filename().string() + ", " +
                                std::to_string(std::lround(rule.photometry->lumens() * kind.share)) + " lm");
    }
}

} // namespace lightwell
