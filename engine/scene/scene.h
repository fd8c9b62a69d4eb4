#pragma once

#include "engine/base/report.h"
#include "engine/scene/sensor.h"
#include "engine/scene/surface.h"
#include "engine/scene/view.h"
#include "materials/material.h"

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

namespace lightwell {

class PlaceFunction; // materials/patterns/place_function.h

/// Another name for a modifier; a layer is an alias of its material.
struct Alias {
    ModifierId target = void_modifier;
};
/// A place-holder in a prototype: each instance says what it stands for (DXF layer 0, BYBLOCK).
struct Inherited {};
/// Brightness of the sky and the ground by direction, multiplied with the emitter it modifies.
/// Source  the function `skybr` of skybright.cal with the arguments A1 to A7, as gensky writes them
struct SkyBrightness {
    enum class Kind { clear = 1, overcast = 2, uniform = 3, intermediate = 4 } kind = Kind::overcast;
    double zenith = 0;        ///< W/(m^2 sr)
    double ground = 0;        ///< W/(m^2 sr), the ground plane
    double normalization = 1; ///< of the clear and the intermediate sky
    Direction to_sun{0, 0, 1};
    /// The CIE formula down to the horizon. Else sky and ground blend over it, as `skybr` has it: that takes 0.2 to
    /// 0.4 % of the horizontal illuminance.
    bool sharp_horizon = false;
};
/// What a function, data, a picture or letters change from place to place.
struct Varying {
    enum class Kind {
        pattern, ///< a factor on the colour of the material below it
        texture, ///< a vector added to the normal
        mixture  ///< the share, 0 to 1, of the foreground; the rest is background
    } kind = Kind::pattern;
    std::shared_ptr<const PlaceFunction> function;
    ModifierId foreground = void_modifier, background = void_modifier; ///< of a mixture; void is invisible
};

/// A named entry of the scene: a material, what varies the material below it, or a name for another entry.
struct Modifier {
    std::string name;
    std::variant<Alias, Inherited, SkyBrightness, Material, Varying> what;
    ModifierId parent = void_modifier; ///< the modifier that it modifies in turn (`skyfunc glow sky_glow`: skyfunc)
};

/// A scene to be lit: plain data, valid by construction; the engine only reads it.
/// Frame  metres, right-handed, z up
struct Scene {
    std::vector<Modifier> modifiers;
    Part root;
    std::vector<Part> prototypes; ///< an instance refers only to prototypes before its own (no cycles)
    std::vector<View> views;
    std::vector<SensorGrid> grids;

    ModifierId add_modifier(Modifier modifier);
    ModifierId add_material(std::string name, Material material, ModifierId parent = void_modifier);
    /// The last modifier of that name, as in the scene language; void_modifier when there is none.
    ModifierId find_modifier(const std::string& name) const;
};

/// What a modifier finally is: the material behind its aliases and the pattern on the way.
struct ResolvedMaterial {
    const Material* material = nullptr;        ///< null: void, or inherited and not bound; of a mixture the foreground
    const SkyBrightness* brightness = nullptr; ///< the sky's brightness that scales it
    bool varies = false;                       ///< from place to place: ask VariedMaterials
};
ResolvedMaterial resolve(const Scene& scene, ModifierId modifier);

/// @throws InputError with the surface's name, value and bound: indices out of range, cycles of aliases or
///         prototypes, fewer than three corners, NaN, radii out of range, singular instances, bad materials
void validate(const Scene& scene);

/// Calls visit(part, surface, to_world, bindings resolved modifier) for each surface of the scene, instances expanded.
using SurfaceVisitor =
    std::function<void(const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier)>;
void visit_expanded(const Scene& scene, const SurfaceVisitor& visit);

/// Number of surfaces with instances expanded, without visiting them (a forest has 1e8).
std::size_t expanded_count(const Scene& scene);
/// World bounds of everything but distant sources.
Box bounds(const Scene& scene);

} // namespace lightwell
