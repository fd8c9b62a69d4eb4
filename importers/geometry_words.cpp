#include "importers/geometry_words.h"

#include "engine/base/errors.h"
#include "importers/choose_materials.h"

#include <algorithm>
#include <map>

namespace lightwell {
namespace {

struct Condition {
    NumberRange area, size;
    bool operator==(const Condition&) const = default;
};

double longest_side_m(const Box& box)
{
    if (box.empty())
        return 0;
    const Vec3 sides = box.high - box.low;
    return std::fmax(sides.x, std::fmax(sides.y, sides.z));
}

/// Splits modifiers by the conditions that their surfaces fit.
class Splitter {
public:
    Splitter(Imported& imported, std::vector<Condition> conditions)
        : imported_(imported), conditions_(std::move(conditions))
    {
    }
    std::vector<std::uint64_t> run()
    {
        for (Part& part : imported_.scene.prototypes) // an instance refers to earlier prototypes only
            split_part(part);
        split_part(imported_.scene.root);
        std::vector<std::uint64_t> fits(imported_.scene.modifiers.size());
        for (const auto& [place, id] : split_)
            fits[static_cast<std::size_t>(id)] = place.second;
        return fits;
    }

private:
    std::uint64_t fitted(const Part& part, const Surface& surface) const
    {
        const double area = surface_area_m2(part, surface), size = longest_side_m(surface_bounds(part, surface));
        std::uint64_t fits = 0;
        for (std::size_t i = 0; i < conditions_.size(); ++i)
            if (conditions_[i].area.holds(area) && conditions_[i].size.holds(size))
                fits |= std::uint64_t{1} << i;
        return fits;
    }

    ModifierId split(ModifierId id, std::uint64_t fits)
    {
        const auto [entry, fresh] = split_.try_emplace({id, fits}, void_modifier);
        if (fresh)
            entry->second = add_copy(imported_, id);
        return entry->second;
    }

    void split_part(Part& part)
    {
        for (Surface& surface : part.surfaces) {
            if (surface.shape == Shape::instance || surface.modifier == void_modifier)
                continue;
            if (const std::uint64_t fits = fitted(part, surface); fits != 0) {
                const ModifierId to = split(surface.modifier, fits);
                move_entities(surface, to);
                surface.modifier = to;
            }
        }
        for (Instance& instance : part.instances)
            split_bindings(instance);
    }

    /// What a prototype has split, its instances bind once more.
    void split_bindings(Instance& instance)
    {
        std::vector<Binding> more;
        for (const Binding& binding : instance.bindings) {
            std::vector<std::uint64_t> seen;
            for (auto entry = split_.lower_bound({binding.inherited, 0});
                 entry != split_.end() && entry->first.first == binding.inherited; ++entry)
                seen.push_back(entry->first.second);
            for (const std::uint64_t fits : seen)
                more.push_back({split(binding.inherited, fits),
                                binding.actual == void_modifier ? void_modifier : split(binding.actual, fits)});
        }
        instance.bindings.insert(instance.bindings.end(), more.begin(), more.end());
    }

    /// Formats that gather many entities in a mesh say how many each key has: a polygon takes one along, a mesh all.
    void move_entities(const Surface& surface, ModifierId to)
    {
        std::vector<std::size_t>& made = imported_.made_with_key;
        const auto from = static_cast<std::size_t>(surface.modifier), target = static_cast<std::size_t>(to);
        if (from >= made.size())
            return;
        made.resize(std::max(made.size(), target + 1));
        const std::size_t count = surface.shape == Shape::mesh ? made[from] : std::min<std::size_t>(made[from], 1);
        made[from] -= count;
        made[target] += count;
    }

    Imported& imported_;
    const std::vector<Condition> conditions_;
    std::map<std::pair<ModifierId, std::uint64_t>, ModifierId> split_;
};

} // namespace

GeometryClasses::GeometryClasses(Imported& imported, const LayerMap& map)
{
    constexpr std::size_t most_conditions = 64;
    std::vector<Condition> conditions;
    for (const LayerRule& rule : map.rules) {
        bit_of_rule_.push_back(0);
        const Condition condition{rule.area_m2, rule.size_m};
        if (condition == Condition{})
            continue;
        auto known = std::find(conditions.begin(), conditions.end(), condition);
        if (known == conditions.end()) {
            if (conditions.size() == most_conditions)
                throw InputError{map.file.string() + ':' + std::to_string(rule.line),
                                 "more than 64 different areas and sizes in one map", "let rules share ranges"};
            known = conditions.insert(known, condition);
        }
        bit_of_rule_.back() = std::uint64_t{1} << (known - conditions.begin());
    }
    if (!conditions.empty())
        fits_ = Splitter{imported, std::move(conditions)}.run();
}

} // namespace lightwell
