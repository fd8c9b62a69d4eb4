#include "importers/rebuild_parts.h"

#include "importers/emission_sides.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_map>

namespace lightwell {
namespace {

/// What place-holders stand for in one variant of a prototype, sorted; only those that stand for a dropped or emitting
/// modifier, since all others can stay bound by the instance.
using Substitution = std::vector<Binding>;

struct SubstitutionOrder {
    bool operator()(const Substitution& a, const Substitution& b) const
    {
        return std::lexicographical_compare(
            a.begin(), a.end(), b.begin(), b.end(), [](const Binding& x, const Binding& y) {
                return std::pair{x.inherited, x.actual} < std::pair{y.inherited, y.actual};
            });
    }
};

ModifierId substituted(const Substitution& substitution, ModifierId modifier)
{
    for (const Binding& binding : substitution)
        if (binding.inherited == modifier)
            return binding.actual;
    return modifier;
}

class Rebuilder {
public:
    Rebuilder(Scene& scene, const std::vector<Choice>& choices) : scene_(scene), choices_(choices)
    {
        result_.shared_surfaces.resize(choices.size());
    }
    Rebuilt run();

private:
    /// Variants of one prototype, with their places in the new list; nothing for one that came out empty.
    using Variants = std::map<Substitution, std::optional<std::uint32_t>, SubstitutionOrder>;

    const Choice* choice(ModifierId modifier) const
    {
        return modifier == void_modifier ? nullptr : &choices_[static_cast<std::size_t>(modifier)];
    }
    bool is_inherited(ModifierId m) const { return choice(m) && choice(m)->kind == Choice::Kind::inherited; }
    bool is_dropped(ModifierId m) const { return choice(m) && choice(m)->kind == Choice::Kind::dropped; }
    bool is_emitter_of_map(ModifierId m) const
    {
        return choice(m) && choice(m)->kind == Choice::Kind::material && lightwell::is_emitter(*choice(m)->definition);
    }
    bool changes_geometry(ModifierId m) const { return is_dropped(m) || is_emitter_of_map(m); }

    void find_placeholders();
    Substitution substitution_of(const Instance& instance, const Substitution& outer) const;
    void find_variants(const Part& part, const Substitution& substitution);
    Part build(const Part& part, std::size_t part_number, const Substitution& substitution);
    void add_instance(Part& to, const Part& from, const Surface& surface, const Substitution& substitution);
    std::vector<Turn> turns_of(const Part& part, const std::vector<ModifierId>& modifiers) const;
    void list_dropped(const std::vector<std::size_t>& origins);

    Scene& scene_;
    const std::vector<Choice>& choices_;
    std::vector<std::vector<ModifierId>> placeholders_; ///< by prototype: those that it or what it holds uses, sorted
    std::vector<Variants> variants_;
    std::vector<Part> built_;
    std::map<std::pair<std::size_t, std::string>, DroppedEntity> dropped_; ///< by part of the import and surface name
    Rebuilt result_;
};

void Rebuilder::find_placeholders()
{
    for (const Part& part : scene_.prototypes) {
        std::set<ModifierId> used;
        for (const Surface& surface : part.surfaces)
            if (is_inherited(surface.modifier))
                used.insert(surface.modifier);
        for (const Instance& instance : part.instances) {
            const std::vector<ModifierId>& inner = placeholders_[instance.prototype];
            used.insert(inner.begin(), inner.end());
            for (const Binding& binding : instance.bindings)
                if (is_inherited(binding.actual))
                    used.insert(binding.actual);
        }
        placeholders_.emplace_back(used.begin(), used.end());
    }
}

Substitution Rebuilder::substitution_of(const Instance& instance, const Substitution& outer) const
{
    Substitution result;
    for (const ModifierId placeholder : placeholders_[instance.prototype]) {
        // What the instance does not bind, the instance around it may.
        ModifierId actual = substituted(instance.bindings, placeholder);
        actual = substituted(outer, actual);
        if (changes_geometry(actual))
            result.push_back({placeholder, actual});
    }
    return result;
}

void Rebuilder::find_variants(const Part& part, const Substitution& substitution)
{
    for (const Instance& instance : part.instances)
        variants_[instance.prototype].try_emplace(substitution_of(instance, substitution));
}

void Rebuilder::add_instance(Part& to, const Part& from, const Surface& surface, const Substitution& substitution)
{
    const Instance& instance = from.instances[surface.index];
    const std::optional<std::uint32_t> prototype =
        variants_[instance.prototype].at(substitution_of(instance, substitution));
    if (!prototype) {
        ++result_.dropped_instances;
        return;
    }
    Instance copy{*prototype, instance.to_parent, {}};
    for (const Binding& binding : instance.bindings) {
        const ModifierId actual = substituted(substitution, binding.actual);
        if (is_inherited(binding.inherited) && !changes_geometry(actual))
            copy.bindings.push_back({binding.inherited, actual});
    }
    to.add_instance(std::move(copy), surface.name);
}

/// @param modifiers  what each surface of the part finally has
std::vector<Turn> Rebuilder::turns_of(const Part& part, const std::vector<ModifierId>& modifiers) const
{
    std::map<ModifierId, std::vector<std::size_t>> emitters;
    for (std::size_t i = 0; i < modifiers.size(); ++i)
        if (is_emitter_of_map(modifiers[i]))
            emitters[modifiers[i]].push_back(i);
    std::vector<Turn> turns(modifiers.size(), Turn::as_is);
    for (const auto& [modifier, surfaces] : emitters) {
        const std::vector<Turn> found = emission_turns(part, surfaces, choice(modifier)->side);
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            turns[surfaces[i]] = found[i];
    }
    return turns;
}

Part Rebuilder::build(const Part& part, std::size_t part_number, const Substitution& substitution)
{
    std::vector<ModifierId> modifiers;
    for (const Surface& surface : part.surfaces)
        modifiers.push_back(substituted(substitution, surface.modifier));
    const std::vector<Turn> turns = turns_of(part, modifiers);
    const auto half = static_cast<ModifierId>(choices_.size());
    Part result;
    result.name = part.name;
    for (std::size_t i = 0; i < modifiers.size(); ++i) {
        const Surface& surface = part.surfaces[i];
        if (surface.shape == Shape::instance) {
            add_instance(result, part, surface, substitution);
        } else if (is_dropped(modifiers[i])) {
            dropped_.try_emplace({part_number, surface.name}, DroppedEntity{surface.modifier, modifiers[i]});
        } else if (turns[i] == Turn::both) {
            ++result_.shared_surfaces[static_cast<std::size_t>(modifiers[i])];
            append_copy(result, part, surface, false, modifiers[i] + half, surface.name);
            append_copy(result, part, surface, true, modifiers[i] + half, surface.name + back_suffix);
        } else {
            append_copy(result, part, surface, turns[i] == Turn::reversed, modifiers[i], surface.name);
        }
    }
    return result;
}

/// An entity is dropped when no variant of its part kept any of its surfaces.
/// @param origins  for each part of built_, the part of the import
void Rebuilder::list_dropped(const std::vector<std::size_t>& origins)
{
    for (std::size_t i = 0; i < origins.size(); ++i)
        for (const Surface& surface : built_[i].surfaces)
            if (!dropped_.empty() && surface.shape != Shape::instance)
                dropped_.erase({origins[i], surface.name});
    for (const auto& [surface, entity] : dropped_)
        result_.dropped.push_back(entity);
}

Rebuilt Rebuilder::run()
{
    const std::size_t root = scene_.prototypes.size();
    find_placeholders();
    variants_.resize(root);
    // Instances refer to earlier prototypes only: downwards to find variants, upwards to build them.
    find_variants(scene_.root, {});
    for (std::size_t i = root; i-- > 0;) {
        if (variants_[i].empty())
            variants_[i].try_emplace(Substitution{});
        for (const auto& [substitution, place] : variants_[i])
            find_variants(scene_.prototypes[i], substitution);
    }
    std::vector<std::size_t> origins;
    for (std::size_t i = 0; i < root; ++i) {
        for (auto& [substitution, place] : variants_[i]) {
            Part part = build(scene_.prototypes[i], i, substitution);
            if (part.surfaces.empty() && !scene_.prototypes[i].surfaces.empty())
                continue;
            place = static_cast<std::uint32_t>(built_.size());
            built_.push_back(std::move(part));
            origins.push_back(i);
        }
        scene_.prototypes[i] = {};
    }
    built_.push_back(build(scene_.root, root, {}));
    origins.push_back(root);
    list_dropped(origins);
    scene_.root = std::move(built_.back());
    built_.pop_back();
    scene_.prototypes = std::move(built_);
    return std::move(result_);
}

} // namespace

Rebuilt rebuild_parts(Scene& scene, const std::vector<Choice>& choices)
{
    const bool needed = std::any_of(choices.begin(), choices.end(), [](const Choice& choice) {
        return choice.kind == Choice::Kind::dropped ||
               (choice.kind == Choice::Kind::material && is_emitter(*choice.definition));
    });
    if (!needed)
        return {{}, 0, std::vector<std::size_t>(choices.size())};
    return Rebuilder{scene, choices}.run();
}

} // namespace lightwell
