#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lightwell::scene_text {

/// What a name stands for at one place of the text.
struct Meaning {
    ModifierId id = void_modifier;
    std::int32_t problem = -1;     ///< index of what keeps it from being used (Scope::problems), or -1
    bool pattern_left_out = false; ///< a pattern that is not modelled stands between here and the material

    bool operator==(const Meaning&) const noexcept = default;
};

/// Allows look-up by string_view without making a string.
struct NameHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view name) const noexcept { return std::hash<std::string_view>{}(name); }
};
using Meanings = std::unordered_map<std::string, Meaning, NameHash, std::equal_to<>>;

/// The names known at one place: those of this file and its includes, then those of the text around it.
/// A later definition hides an earlier one of the same name.
class Scope {
public:
    explicit Scope(Scope* outer = nullptr) : outer_(outer) {}

    void define(const std::string& name, const Meaning& meaning) { own_[name] = meaning; }
    /// Nothing when the name is not known.
    std::optional<Meaning> find(std::string_view name);
    const Meanings& own() const { return own_; }
    /// What was looked up outside, and found or not: the same fragment elsewhere means the same only if these agree.
    const std::unordered_map<std::string, std::optional<Meaning>>& seen_outside() const { return seen_outside_; }

private:
    Scope* outer_;
    Meanings own_;
    std::unordered_map<std::string, std::optional<Meaning>> seen_outside_;
};

/// Modifiers of a scene without doubles: an equal definition under the same name is the same modifier, so that a
/// file of materials that is included a hundred times counts once.
class ModifierTable {
public:
    /// @param scene  grows by add(); what it has already is known
    explicit ModifierTable(Scene& scene);
    ModifierId add(Modifier modifier);

private:
    Scene& scene_;
    std::unordered_map<std::string, ModifierId> known_;
};

/// The sky turned about z.
/// @throws InputError when the map would tilt it
SkyBrightness turned(SkyBrightness sky, const Affine& map, const std::string& place);

/// What a map does to a modifier.
struct MaterialChange {
    bool scale_materials =
        false;                  ///< lengths inside materials scale: the absorption of a dielectric, the range of a glow
    bool patterns_only = false; ///< beams and skies stay as they are
    const std::set<ModifierId>* keep = nullptr; ///< what is not moved: patterns that were defined elsewhere
};
/// The modifier as a similarity changes it: patterns move, beams and skies turn, as the xform program does it.
/// @throws InputError when a sky would tilt
ModifierId transformed(const Scene& scene, ModifierTable& table, ModifierId id, const Affine& map,
                       const MaterialChange& change, const std::string& place);

} // namespace lightwell::scene_text
