#include "importers/importer.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/units.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace lightwell {
namespace {

/// Appends a field with its length in front, so that no two different lists of fields give the same text.
void append_field(std::string& text, const std::string& field)
{
    text += std::to_string(field.size());
    text += ':';
    text += field;
}

/// Equal exactly when the keys are equal; colours by their bits.
std::string identity(const SurfaceKey& key, bool inherited)
{
    std::string text(1, inherited ? 'i' : 'a');
    for (const std::string* field : {&key.layer, &key.group, &key.block, &key.material, &key.entity})
        append_field(text, *field);
    if (key.colour) {
        char bits[sizeof(Spectrum)];
        std::memcpy(bits, &*key.colour, sizeof bits);
        text.append(bits, sizeof bits);
    }
    return text;
}

} // namespace

ModifierId KeyTable::modifier_for(const SurfaceKey& key)
{
    return find_or_add(key, false);
}

ModifierId KeyTable::inherited(const SurfaceKey& key)
{
    return find_or_add(key, true);
}

ModifierId KeyTable::find_or_add(const SurfaceKey& key, bool inherited)
{
    assert(!key.layer.empty() && imported_.keys.size() == imported_.scene.modifiers.size());
    const auto next = static_cast<ModifierId>(imported_.scene.modifiers.size());
    const auto [entry, fresh] = known_.try_emplace(identity(key, inherited), next);
    if (fresh) {
        Modifier modifier{key.layer, Alias{}, void_modifier};
        if (inherited)
            modifier.what = Inherited{};
        imported_.scene.modifiers.push_back(std::move(modifier));
        imported_.keys.push_back(key);
    }
    return entry->second;
}

RaisedLayer parse_raised_layer(const std::string& words, const std::string& place)
{
    const std::size_t equals = words.rfind('='); // layers may have one in their names
    const std::string_view all{words};
    const std::string_view layer = trimmed(all.substr(0, std::min(equals, all.size())));
    const std::string_view height = equals == std::string::npos ? std::string_view{} : trimmed(all.substr(equals + 1));
    const std::size_t digits = std::min(height.find_first_not_of("+-.0123456789"), height.size());
    const auto number = parse_double(trimmed(height.substr(0, digits)));
    if (layer.empty() || !number || !(*number > 0))
        throw InputError{place, "\"" + words + "\" is no layer with a height above 0",
                         "for example A-WALL=2.8 (metres) or *WALL*=2800mm"};
    const std::string_view unit = trimmed(height.substr(digits));
    return {std::string{layer}, *number * (unit.empty() ? 1 : parse_unit(std::string{unit}).value)};
}

} // namespace lightwell
