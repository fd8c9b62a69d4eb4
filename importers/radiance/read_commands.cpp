#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/inline_commands.h"
#include "importers/radiance/place_surface.h"
#include "importers/radiance/scene_reader.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

/// A fragment with fewer surfaces is copied: an instance costs more than it saves.
constexpr std::size_t smallest_worth_sharing = 16;
/// Copies of surfaces that transforms may make (a gigabyte, about) before it counts as a slip.
constexpr std::size_t most_copies = 5'000'000;

/// The words of a command that is nothing but one xform of files, which can be placed without making text.
std::optional<std::vector<std::string>> one_xform(const std::string& command, const std::string& place)
{
    std::optional<std::vector<std::string>> words;
    try {
        CommandStages stages = command_stages(command, place);
        if (stages.size() == 1 && stages[0][0] == "xform" &&
            std::find(stages[0].begin(), stages[0].end(), "-I") == stages[0].end())
            words = std::move(stages[0]);
    } catch (const InputError&) {
        return std::nullopt; // answer_command() knows whether a shell may have it
    }
    return words;
}

[[noreturn]] void refuse_copies(const std::string& place)
{
    throw InputError{place, fmt::format("the transforms copy more than {} surfaces", most_copies),
                     "use smaller arrays, or `instance`"};
}

} // namespace

void SceneReader::run(OpenFile& file, const std::string& command, const std::string& place, Target target)
{
    const std::string at =
        place + ": !" + std::string(trimmed(command).substr(0, trimmed(command).find_first_of(" \t")));
    if (const auto words = one_xform(command, at)) {
        for (const Xform& xform : parse_xform({words->begin() + 1, words->end()}, file, at))
            include(xform, file, at, target);
        return;
    }
    GeneratorInput input;
    input.find_file = [&](const std::string& name) { return find_quietly(name, file); };
    const std::string text = answer_command(command, at, input, policy_, file.depth);
    read_text(text, file.path, at, &file, {target.part, target.scope, target.first_file, false});
}

std::vector<SceneReader::Xform> SceneReader::parse_xform(const std::vector<std::string>& words, const OpenFile& file,
                                                         const std::string& place) const
{
    const auto option = std::find(words.begin(), words.end(), "-f");
    if (option == words.end() || option + 1 == words.end())
        return {parse_one_xform(words, file, place)};
    // One call for each line of the file, whose words stand in place of the option; the copies are numbered.
    const MappedFile lines(find(*(option + 1), file, place));
    std::vector<Xform> all;
    for (const std::string_view line : split(lines.bytes(), "\r\n")) {
        const std::vector<std::string_view> own = split(line);
        if (own.empty() || own[0].starts_with('#'))
            continue;
        std::vector<std::string> call(words.begin(), option);
        call.insert(call.end(), own.begin(), own.end());
        call.insert(call.end(), option + 2, words.end());
        Xform xform = parse_one_xform(call, file, place);
        xform.name = xform.name.value_or("a") + '.' + std::to_string(all.size());
        xform.plain = false;
        all.push_back(std::move(xform));
    }
    return all;
}

SceneReader::Xform SceneReader::parse_one_xform(const std::vector<std::string>& words, const OpenFile& file,
                                                const std::string& place) const
{
    Xform xform;
    std::vector<std::string> steps;
    std::size_t next = 0;
    while (next < words.size() && words[next].starts_with('-') && words[next].size() > 1) {
        const std::size_t begin = next;
        read_placements(words, next, place);
        steps.insert(steps.end(), words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(next));
        if (next > begin)
            continue;
        const std::string& word = words[next++];
        // -c and -e say whether commands inside are run; here they are always answered.
        if (word == "-c" || word == "-e")
            continue;
        if (word != "-n" && word != "-m")
            throw InputError{place, fmt::format("option {} is not known or not modelled yet", word),
                             "use -n -m -f -t -rx -ry -rz -s -mx -my -mz -affine -i -a"};
        if (next == words.size())
            throw InputError{place, word + " is followed by nothing", "give the name after it"};
        (word == "-n" ? xform.name : xform.modifier) = words[next++];
    }
    std::size_t begin = 0;
    xform.placements = read_placements(steps, begin, place);
    if (next == words.size())
        throw InputError{place, "no file name", "name the files after the transform"};
    for (; next < words.size(); ++next)
        xform.files.push_back(find(words[next], file, place));
    const bool array = !xform.placements.front().array_index.empty();
    xform.plain = !array && !xform.name && !xform.modifier && xform.placements.front().map == Affine{};
    return xform;
}

void SceneReader::include(const Xform& xform, OpenFile& file, const std::string& place, Target target)
{
    if (xform.plain) {
        for (const std::filesystem::path& path : xform.files)
            read_file(path, &file, place, {target.part, target.scope, target.first_file, false});
        return;
    }
    std::optional<ModifierId> modifier;
    if (xform.modifier) {
        const Primitive stand_in{*xform.modifier, "!xform", *xform.modifier, {}, {}, file.words.offset()};
        const Meaning meaning = meaning_of(file, stand_in, *xform.modifier, target);
        modifier = usable(file, stand_in, meaning);
        file.included_as = meaning;
    }
    Fragment& shared = fragment(xform.files, file, place, target);
    file.included_as.reset();
    const std::size_t surfaces = part_of(shared).surfaces.size();
    if ((!shared.prototype || shared.turns || shared.scales) && surfaces > most_copies / xform.placements.size())
        refuse_copies(place);
    for (const Placement& placement : xform.placements) {
        std::string name = xform.name.value_or("");
        if (!placement.array_index.empty())
            name = xform.name ? name + '.' + placement.array_index : 'a' + placement.array_index;
        place_fragment(shared, placement, name, modifier, place, target);
    }
    // Names that the files define are known from here on, as the last copy has them.
    const Affine& last = xform.placements.back().map;
    for (auto [name, meaning] : shared.scope->own()) {
        if (meaning.problem < 0)
            meaning.id = transformed(scene_, table_, meaning.id, last, {true, false, &shared.outside}, place);
        target.scope.define(name, meaning);
    }
}

SceneReader::Fragment& SceneReader::fragment(const std::vector<std::filesystem::path>& files, OpenFile& file,
                                             const std::string& place, Target target)
{
    std::vector<std::filesystem::path> key;
    for (const std::filesystem::path& path : files)
        key.push_back(std::filesystem::weakly_canonical(path));
    if (file.included_as)
        key.emplace_back("-m"); // its surfaces may name what is not known
    for (const auto& known : fragments_[key]) {
        const auto& seen = known->scope->seen_outside();
        if (std::all_of(seen.begin(), seen.end(),
                        [&](const auto& entry) { return target.scope.find(entry.first) == entry.second; }))
            return *known;
    }
    auto fresh = std::make_unique<Fragment>();
    fresh->scope = std::make_unique<Scope>(&target.scope);
    for (const std::filesystem::path& path : files)
        read_file(path, &file, place, {fresh->part, *fresh->scope});
    if (fresh->part.name.empty())
        fresh->part.name = files.back().stem().string();
    describe(*fresh);
    if (fresh->part.surfaces.size() >= smallest_worth_sharing && fresh->part.sources.empty()) {
        fresh->prototype = static_cast<std::uint32_t>(scene_.prototypes.size());
        scene_.prototypes.push_back(std::move(fresh->part));
        fresh->part = {};
        prototype_changes_.emplace_back(fresh->turns || !fresh->outside.empty(), fresh->scales);
    }
    return *fragments_[key].emplace_back(std::move(fresh));
}

void SceneReader::describe(Fragment& fragment) const
{
    for (const auto& [name, meaning] : fragment.scope->seen_outside())
        if (meaning && meaning->id != void_modifier && resolve(scene_, meaning->id).varies)
            fragment.outside.insert(meaning->id);
    ModifierId last = void_modifier;
    fragment.turns = !fragment.part.sources.empty();
    for (const Surface& surface : fragment.part.surfaces) {
        if (surface.modifier == last)
            continue;
        last = surface.modifier;
        const ResolvedMaterial resolved = resolve(scene_, surface.modifier);
        fragment.turns |= resolved.brightness != nullptr;
        if (resolved.material == nullptr)
            continue;
        fragment.turns |= std::holds_alternative<Spotlight>(*resolved.material);
        fragment.scales |=
            std::holds_alternative<Dielectric>(*resolved.material) || std::holds_alternative<Glow>(*resolved.material);
    }
    for (const Instance& instance : fragment.part.instances) {
        fragment.turns |= prototype_changes_[instance.prototype].first;
        fragment.scales |= prototype_changes_[instance.prototype].second;
    }
}

const Part& SceneReader::part_of(const Fragment& fragment) const
{
    return fragment.prototype ? scene_.prototypes[*fragment.prototype] : fragment.part;
}

void SceneReader::place_fragment(Fragment& fragment, const Placement& placement, const std::string& prefix,
                                 const std::optional<ModifierId>& modifier, const std::string& place, Target target)
{
    const Affine& map = placement.map;
    const bool materials_change = (!fragment.outside.empty() && !(map == Affine{})) ||
                                  (fragment.turns && !is_translation(map)) ||
                                  (fragment.scales && std::fabs(similarity_scale(map) - 1) > 1e-12);
    if (fragment.prototype && !materials_change) {
        const std::uint32_t prototype =
            modifier ? with_modifier(*fragment.prototype, moved_patterns(*modifier, inverse(map), place))
                     : *fragment.prototype;
        target.part.add_instance({prototype, map, {}}, prefix.empty() ? part_of(fragment).name : prefix);
        return;
    }
    expand(fragment, part_of(fragment), map, prefix, modifier, place, target.part);
}

void SceneReader::expand(const Fragment& fragment, const Part& part, const Affine& map, const std::string& prefix,
                         const std::optional<ModifierId>& modifier, const std::string& place, Part& to)
{
    expanded_ += part.surfaces.size();
    if (expanded_ > most_copies)
        refuse_copies(place);
    // with_modifier() adds prototypes, which moves those that are there.
    const std::optional<Part> copy = modifier && !part.instances.empty() ? std::optional(part) : std::nullopt;
    const Part& from = copy ? *copy : part;
    for (const Surface& surface : from.surfaces) {
        const std::string name = prefix.empty() ? surface.name : prefix + '.' + surface.name;
        if (surface.shape == Shape::instance) {
            const Instance& instance = from.instances[surface.index];
            const auto [turns, scales] = prototype_changes_[instance.prototype];
            if (turns || scales) {
                expand(fragment, scene_.prototypes[instance.prototype], compose(map, instance.to_parent), name,
                       modifier, place, to);
                continue;
            }
            const std::uint32_t prototype =
                modifier ? with_modifier(instance.prototype,
                                         moved_patterns(*modifier, inverse(compose(map, instance.to_parent)), place))
                         : instance.prototype;
            to.add_instance({prototype, compose(map, instance.to_parent), {}}, name);
            continue;
        }
        const ModifierId own = modifier.value_or(surface.modifier);
        const ModifierId changed =
            modifier ? own : transformed(scene_, table_, own, map, {true, false, &fragment.outside}, place);
        add_image(to, from, surface, map, changed, name, 0, report_);
    }
}

} // namespace lightwell::scene_text
