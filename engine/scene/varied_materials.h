#pragma once

#include "engine/scene/scene.h"
#include "materials/patterns/pattern_place.h"

#include <vector>

namespace lightwell {

/// A material as one place has it.
struct SeenMaterial {
    const Material* material = nullptr; ///< null: nothing is there; may point to `made`
    Vec3 bend{};                        ///< what textures add to the normal, front side
    Material made = Plastic{};
};

/// The materials of a scene whose patterns, textures and mixtures have been worked out at one place.
/// The scene must outlive it. Thread-safe.
class VariedMaterials {
public:
    explicit VariedMaterials(const Scene& scene);

    bool any() const noexcept { return any_; }
    /// Whether look() can say anything that resolve() does not.
    bool varies(ModifierId id) const noexcept
    {
        return any_ && id != void_modifier && varies_[static_cast<std::size_t>(id)] != 0;
    }
    /// Patterns multiply what a material reflects, transmits or emits; the result is kept within what is physical.
    /// Where a mixture shows parts of both, one of them is chosen, at random but always the same at the same place.
    void look(ModifierId id, const PatternPlace& place, SeenMaterial& seen) const noexcept;
    /// All that look() may find; null among them where it may find nothing.
    std::vector<const Material*> possible(ModifierId id) const;

private:
    struct Walk;
    void follow(ModifierId id, Walk& walk) const noexcept;
    void tint_parts(Wgmd& wgmd, const PatternPlace& place, const Spectrum& colour) const noexcept;
    void add_possible(ModifierId id, std::vector<const Material*>& found) const;
    const Modifier& modifier(ModifierId id) const noexcept { return scene_->modifiers[static_cast<std::size_t>(id)]; }

    const Scene* scene_;
    std::vector<char> varies_;
    bool any_ = false;
};

/// The normal that a texture leaves, on the front side as `normal` is, when the ray still meets the side that it met.
/// Source  recorded behaviour of textures: a bent normal that would turn the surface round is mirrored at the ray
Direction bent_normal(const Direction& normal, const Vec3& bend, const Direction& ray) noexcept;

} // namespace lightwell
