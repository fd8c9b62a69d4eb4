#include "engine/scene/patterned.h"

namespace lightwell {

bool has_pattern(const Scene& scene, ModifierId id) noexcept
{
    const auto count = static_cast<ModifierId>(scene.modifiers.size());
    for (ModifierId walked = 0; id > void_modifier && id < count && walked < count; ++walked) {
        const Modifier& modifier = scene.modifiers[static_cast<std::size_t>(id)];
        const auto* varying = std::get_if<Varying>(&modifier.what);
        if (varying != nullptr && varying->kind == Varying::Kind::pattern)
            return true;
        const auto* alias = std::get_if<Alias>(&modifier.what);
        id = alias != nullptr && alias->target != void_modifier ? alias->target : modifier.parent;
    }
    return false;
}

} // namespace lightwell
