#include "engine/base/text.h"
#include "importers/radiance/material_text.h"
#include "importers/radiance/scene_reader.h"

#include <fmt/format.h>
#include <utility>

namespace lightwell::scene_text {

Meaning SceneReader::problem(const std::string& place, const std::string& what)
{
    problems_.push_back({place, what});
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
    throw InputError{file.words.place(primitive), fmt::format("uses {}, {}", found.place, found.what),
                     "give it one of plastic metal trans dielectric glass mirror light illum glow spotlight"};
}

void SceneReader::define(OpenFile& file, const Primitive& primitive, Target target)
{
    const Meaning parent = meaning_of(file, primitive, primitive.modifier, target);
    file.last_known = false;
    const TypeClass kind = classify(primitive.type);
    if (kind == TypeClass::pattern || kind == TypeClass::texture)
        return define_pattern(file, primitive, parent, target);
    if (kind == TypeClass::material)
        return define_material(file, primitive, parent, target);
    const std::string place = file.words.place(primitive);
    const std::string what = fmt::format("type {} is not modelled yet", primitive.type);
    report_.add(Finding::unsupported, place, what + "; surfaces made of it are refused");
    target.scope.define(decoded_name(primitive.name), problem(place, what));
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
    } else {
        // A texture bends the normal, a pattern changes how much light there is: emitters need to know.
        const bool pattern = classify(primitive.type) == TypeClass::pattern;
        meaning.pattern_left_out |= pattern;
        report_.add(Finding::unsupported, place,
                    fmt::format("type {} is not modelled yet; what it modifies is taken as even", primitive.type));
    }
    target.scope.define(std::move(name), meaning);
}

void SceneReader::define_material(OpenFile& file, const Primitive& primitive, Meaning parent, Target target)
{
    const std::string place = file.words.place(primitive);
    std::string name = decoded_name(primitive.name);
    Material material = material_of(primitive, place, report_);
    validate_material(material, place);
    if (const auto* illum = std::get_if<Illum>(&material); illum != nullptr && !illum->alternate.empty())
        meaning_of(file, primitive, primitive.words[0], target);
    Meaning meaning = parent;
    if (parent.pattern_left_out && is_emitter(material))
        meaning = problem(place, "an emitter whose brightness is set by a pattern that is not modelled yet");
    else if (parent.problem < 0)
        meaning.id = table_.add({name, std::move(material), parent.id});
    meaning.pattern_left_out = false;
    target.scope.define(std::move(name), meaning);
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
        // An alias keeps the pattern of what it stands for only when it inherits; else it gets its own modifier.
        const ResolvedMaterial resolved = resolve(scene_, meaning.id);
        const bool other_pattern =
            resolved.material != nullptr && !inherits && resolved.brightness != resolve(scene_, parent.id).brightness;
        if (parent.pattern_left_out && resolved.material != nullptr && is_emitter(*resolved.material))
            meaning = problem(file.words.place(primitive),
                              "an emitter whose brightness is set by a pattern that is not modelled yet");
        else if (other_pattern)
            meaning.id = table_.add({name, *resolved.material, parent.id});
        else
            meaning.id = table_.add({name, Alias{meaning.id}, void_modifier});
    } else if (meaning.problem < 0) {
        meaning = parent;
    }
    target.scope.define(std::move(name), meaning);
}

} // namespace lightwell::scene_text
