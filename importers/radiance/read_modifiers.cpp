#include "engine/base/text.h"
#include "engine/scene/patterned.h"
#include "importers/radiance/material_text.h"
#include "importers/radiance/scene_reader.h"
#include "materials/bright_colours.h"

#include <fmt/format.h>
#include <utility>

namespace lightwell::scene_text {

Meaning SceneReader::problem(const std::string& place, const std::string& what, const std::string& hint)
{
    problems_.push_back({place, what, hint});
    Meaning meaning;
    meaning.problem = static_cast<std::int32_t>(problems_.size() - 1);
    return meaning;
}

Meaning SceneReader::meaning_of(OpenFile& file, const Primitive& primitive, std::string_view name, Target target)
{
    if (name == "void")
        return {};
    const std::string decoded = decoded_name(name);
    const auto meaning = target.scope.find(decoded);
    // The modifier that `!xform -m` gives to surfaces need not replace one that is known.
    if (!meaning && classify(primitive.type) == TypeClass::surface)
        for (const OpenFile* around = file.from; around != nullptr; around = around->from)
            if (around->included_as)
                return *around->included_as;
    if (!meaning)
        throw InputError{file.words.place(primitive), fmt::format("modifier \"{}\" is not defined above", decoded),
                         parse_double(name) ? "check the counts of the primitive before it"
                                            : "define it first, or include the file that does: `!xform FILE`"};
    return *meaning;
}

ModifierId SceneReader::usable(OpenFile& file, const Primitive& primitive, const Meaning& meaning)
{
    if (meaning.problem < 0)
        return meaning.id;
    const Problem& found = problems_[static_cast<std::size_t>(meaning.problem)];
    throw InputError{file.words.place(primitive), fmt::format("uses {}, {}", found.place, found.what), found.hint};
}

void SceneReader::define(OpenFile& file, const Primitive& primitive, Target target)
{
    const Meaning parent = meaning_of(file, primitive, primitive.modifier, target);
    file.last_known = false;
    const TypeClass kind = classify(primitive.type);
    if (kind == TypeClass::pattern || kind == TypeClass::texture)
        return define_pattern(file, primitive, parent, target);
    if (kind == TypeClass::mixture)
        return define_varying(file, primitive, parent, target);
    define_material(file, primitive, parent, target);
}

void SceneReader::define_pattern(OpenFile& file, const Primitive& primitive, const Meaning& parent, Target target)
{
    const std::string place = file.words.place(primitive);
    std::string name = decoded_name(primitive.name);
    Meaning meaning = parent;
    if (auto sky = sky_brightness_of(primitive, place)) {
        sky->sharp_horizon = std::exchange(file.sharp_horizon, false);
        if (parent.problem < 0)
            meaning.id = table_.add({name, *sky, parent.id});
    } else if (PatternReader::knows(primitive.type)) {
        return define_varying(file, primitive, parent, target);
    } else {
        // A texture bends the normal, a pattern changes how much light there is: emitters need to know.
        const bool pattern = classify(primitive.type) == TypeClass::pattern;
        meaning.pattern_left_out |= pattern;
        report_.add(Finding::unsupported, place,
                    fmt::format("type {} is not modelled yet; what it modifies is taken as even", primitive.type));
    }
    target.scope.define(std::move(name), meaning);
}

void SceneReader::define_varying(OpenFile& file, const Primitive& primitive, const Meaning& parent, Target target)
{
    const std::string place = file.words.place(primitive);
    std::string name = decoded_name(primitive.name);
    Meaning meaning = parent;
    std::size_t mixed_words = 0;
    Varying varying;
    if (classify(primitive.type) == TypeClass::mixture) {
        varying.kind = Varying::Kind::mixture;
        mixed_words = 2;
        if (primitive.words.size() < mixed_words)
            throw InputError{place, "no foreground and background",
                             "the first two words of a mixture name the modifiers that it mixes"};
        for (const auto& [word, id] : {std::pair(0, &varying.foreground), std::pair(1, &varying.background)}) {
            const Meaning mixed = meaning_of(file, primitive, primitive.words[static_cast<std::size_t>(word)], target);
            *id = mixed.id;
            if (mixed.problem >= 0 && meaning.problem < 0)
                meaning.problem = mixed.problem;
        }
    } else if (classify(primitive.type) == TypeClass::texture) {
        varying.kind = Varying::Kind::texture;
    }
    try {
        varying.function = pattern_function(file, primitive, mixed_words, place);
        if (meaning.problem < 0)
            meaning.id = table_.add({name, std::move(varying), parent.id});
    } catch (const InputError& error) {
        // Many scenes define more than they use.
        report_.add(Finding::unsupported, place, std::string(error.what()) + "; surfaces that use it are refused");
        meaning = problem(place, error.what(), "correct the pattern, or leave it out");
    }
    target.scope.define(std::move(name), meaning);
}

PatternReader::Request SceneReader::request(const OpenFile& file, const Primitive& primitive, std::size_t first_word,
                                            const std::string& place) const
{
    PatternReader::Request request;
    request.type = primitive.type;
    request.words.assign(primitive.words.begin() + static_cast<std::ptrdiff_t>(first_word), primitive.words.end());
    request.numbers = primitive.numbers;
    request.place = place;
    request.find_file = [this, &file](const std::string& name) { return find_quietly(name, file); };
    request.read_transform = [place](const std::vector<std::string>& words, std::size_t begin) {
        const std::vector<Placement> placements = read_placements(words, begin, place);
        if (begin != words.size() || placements.size() != 1)
            throw InputError{place,
                             begin != words.size() ? fmt::format("\"{}\" is no transform", words[begin])
                                                   : "an array (-a) makes more than one copy",
                             "after the words of a pattern come -t -rx -ry -rz -s -mx -my -mz -i or nothing"};
        if (!(similarity_scale(placements.front().map) > 0))
            throw InputError{place, "the transform of a pattern scales x, y and z differently",
                             "patterns are turned, moved and scaled as a whole"};
        return placements.front().map;
    };
    return request;
}

std::shared_ptr<const PlaceFunction> SceneReader::pattern_function(const OpenFile& file, const Primitive& primitive,
                                                                   std::size_t mixed_words, const std::string& place)
{
    return patterns_.read(request(file, primitive, mixed_words, place));
}

ModifierId SceneReader::moved_patterns(ModifierId modifier, const Affine& map, const std::string& place)
{
    return transformed(scene_, table_, modifier, map, {false, true, nullptr}, place);
}

void SceneReader::check_material(Material& material, const Meaning& parent, const std::string& place)
{
    const bool patterned = has_pattern(scene_, parent.id);
    if (!patterned)
        if (const double most = hold_saturated_colour(material); most > 0)
            report_.add(
                Finding::approximated, place,
                fmt::format("its colour has a channel of {:.4g}, more than a surface can give back; held at 1", most));
    patterned ? validate_patterned_material(material, place) : validate_material(material, place);
}

void SceneReader::define_material(OpenFile& file, const Primitive& primitive, Meaning parent, Target target)
{
    const std::string place = file.words.place(primitive);
    std::string name = decoded_name(primitive.name);
    Meaning meaning = parent;
    if (PatternReader::knows_material(primitive.type)) {
        try {
            Material material = functional_material_of(
                primitive, patterns_.read_material(request(file, primitive, 0, place)), place, report_);
            check_material(material, parent, place);
            if (parent.problem < 0)
                meaning.id = table_.add({name, std::move(material), parent.id});
        } catch (const InputError& error) {
            // Many scenes define more than they use.
            report_.add(Finding::unsupported, place, std::string(error.what()) + "; surfaces that use it are refused");
            meaning = problem(place, error.what(), "correct the material, or leave it out");
        }
        meaning.pattern_left_out = false;
        return target.scope.define(std::move(name), meaning);
    }
    Material material = material_of(primitive, place);
    check_material(material, parent, place);
    for (const std::string& named : named_modifiers(material))
        meaning_of(file, primitive, encoded_name(named), target);
    if (parent.pattern_left_out && is_emitter(material))
        meaning = problem(place, "an emitter whose brightness is set by a pattern that is not modelled yet");
    else if (parent.problem < 0)
        meaning.id = table_.add({name, std::move(material), parent.id});
    meaning.pattern_left_out = false;
    target.scope.define(std::move(name), meaning);
}

/// An alias keeps the patterns of what it stands for only when it inherits; else it gets those of its own modifier.
ModifierId SceneReader::aliased(const std::string& name, ModifierId target, const std::optional<ModifierId>& parent)
{
    ModifierId meant = target;
    const auto modifier = [&](ModifierId id) -> const Modifier& {
        return scene_.modifiers[static_cast<std::size_t>(id)];
    };
    while (meant != void_modifier && std::holds_alternative<Alias>(modifier(meant).what))
        meant = std::get<Alias>(modifier(meant).what).target;
    if (meant != void_modifier && parent && modifier(meant).parent != *parent)
        return std::visit([&](const auto& what) { return table_.add({name, what, *parent}); }, modifier(meant).what);
    return table_.add({name, Alias{target}, void_modifier});
}

void SceneReader::define_alias(OpenFile& file, const Primitive& primitive, Target target)
{
    const std::string_view word = file.words.alias_target(primitive);
    file.last_known = false;
    Meaning meaning = meaning_of(file, primitive, word, target);
    std::string name = decoded_name(primitive.name);
    const bool inherits = primitive.modifier == "inherit";
    const Meaning parent = inherits ? Meaning{} : meaning_of(file, primitive, primitive.modifier, target);
    if (meaning.problem < 0 && parent.problem < 0) {
        const ResolvedMaterial resolved = resolve(scene_, meaning.id);
        if (parent.pattern_left_out && resolved.material != nullptr && is_emitter(*resolved.material))
            meaning = problem(file.words.place(primitive),
                              "an emitter whose brightness is set by a pattern that is not modelled yet");
        else
            meaning.id = aliased(name, meaning.id, inherits ? std::nullopt : std::optional(parent.id));
    } else if (meaning.problem < 0) {
        meaning = parent;
    }
    target.scope.define(std::move(name), meaning);
}

} // namespace lightwell::scene_text
