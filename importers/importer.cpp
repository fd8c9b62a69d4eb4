#include "importers/importer.h"

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

} // namespace lightwell
