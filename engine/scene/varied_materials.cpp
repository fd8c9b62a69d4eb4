#include "engine/scene/varied_materials.h"

#include "engine/base/random.h"
#include "materials/patterns/place_function.h"
#include "materials/placed.h"

#include <algorithm>
#include <cstring>

namespace lightwell {
namespace {

/// Not to be seen in a picture, and far above rounding: a share this close to 0 or 1 is one.
constexpr double whole = 1e-6;

std::uint64_t bits_of(double value) noexcept
{
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// A number in [0, 1) that depends on the place and the ray alone.
double chance_at(const PatternPlace& place) noexcept
{
    std::uint64_t state = 0;
    for (const Vec3& v : {place.position, place.direction})
        for (int axis = 0; axis < 3; ++axis)
            state = mix_bits(state, bits_of(v[axis]));
    return unit_from_bits(state);
}

ModifierId next_of(const Modifier& modifier) noexcept
{
    const auto* alias = std::get_if<Alias>(&modifier.what);
    return alias != nullptr && alias->target != void_modifier ? alias->target : modifier.parent;
}

} // namespace

/// What has come together on the way from a surface's modifier to its material.
struct VariedMaterials::Walk {
    const PatternPlace& place;
    Spectrum colour = Spectrum::grey(1);
    Vec3 bend{};
    const Material* material = nullptr;
    bool invisible = false; ///< a mixture has shown its void
};

VariedMaterials::VariedMaterials(const Scene& scene) : scene_(&scene)
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const ResolvedMaterial resolved = resolve(scene, static_cast<ModifierId>(i));
        varies_.push_back(resolved.varies ? 1 : 0);
        any_ = any_ || resolved.varies;
    }
}

void VariedMaterials::follow(ModifierId id, Walk& walk) const noexcept
{
    while (id != void_modifier && !walk.invisible) {
        const Modifier& now = modifier(id);
        if (const auto* material = std::get_if<Material>(&now.what); material != nullptr && walk.material == nullptr)
            walk.material = material;
        if (const auto* varying = std::get_if<Varying>(&now.what)) {
            if (varying->kind == Varying::Kind::pattern) {
                walk.colour *= varying->function->at(walk.place);
            } else if (varying->kind == Varying::Kind::texture) {
                walk.bend += varying->function->bend_at(walk.place);
            } else if (walk.material == nullptr) {
                const double share = varying->function->at(walk.place).r;
                const bool front = share >= 1 - whole || (share > whole && chance_at(walk.place) < share);
                const ModifierId shown = front ? varying->foreground : varying->background;
                const ModifierId other = front ? varying->background : varying->foreground;
                follow(shown, walk);
                walk.invisible |= walk.material == nullptr && resolve(*scene_, other).material != nullptr;
            }
        }
        id = next_of(now);
    }
}

void VariedMaterials::look(ModifierId id, const PatternPlace& place, SeenMaterial& seen) const noexcept
{
    Walk walk{place};
    follow(id, walk);
    seen.bend = walk.bend;
    seen.material = walk.invisible ? nullptr : walk.material;
    if (seen.material == nullptr)
        return;
    const bool coloured = !(walk.colour == Spectrum::grey(1));
    if (!coloured && !depends_on_place(*seen.material))
        return;
    seen.made = coloured ? tinted(*seen.material, walk.colour) : *seen.material;
    put_in_place(seen.made, place);
    if (auto* wgmd = std::get_if<Wgmd>(&seen.made))
        tint_parts(*wgmd, place, walk.colour);
    seen.material = &seen.made;
}

/// The colours of the patterns that the material names for its parts.
void VariedMaterials::tint_parts(Wgmd& wgmd, const PatternPlace& place, const Spectrum& colour) const noexcept
{
    for (std::size_t i = 0; i < std::size(wgmd.tints); ++i) {
        Walk own{place};
        follow(scene_->find_modifier(wgmd.tints[i]), own);
        const Spectrum found = own.colour * colour;
        wgmd.colours[i] = {std::clamp(found.r, 0.0, 1.0), std::clamp(found.g, 0.0, 1.0), std::clamp(found.b, 0.0, 1.0)};
    }
}

void VariedMaterials::add_possible(ModifierId id, std::vector<const Material*>& found) const
{
    while (id != void_modifier) {
        const Modifier& now = modifier(id);
        if (const auto* material = std::get_if<Material>(&now.what)) {
            found.push_back(material);
            return;
        }
        const auto* varying = std::get_if<Varying>(&now.what);
        if (varying != nullptr && varying->kind == Varying::Kind::mixture) {
            const bool any_material = resolve(*scene_, varying->foreground).material != nullptr ||
                                      resolve(*scene_, varying->background).material != nullptr;
            if (any_material) {
                add_possible(varying->foreground, found);
                add_possible(varying->background, found);
                return;
            }
        }
        id = next_of(now);
    }
    found.push_back(nullptr);
}

std::vector<const Material*> VariedMaterials::possible(ModifierId id) const
{
    std::vector<const Material*> found;
    add_possible(id, found);
    return found;
}

Direction bent_normal(const Direction& normal, const Vec3& bend, const Direction& ray) noexcept
{
    Vec3 bent = normalized(normal + bend);
    if (length(bent) == 0)
        return normal;
    const double met = dot(bent, ray);
    if ((met < 0) != (dot(normal, ray) < 0))
        bent = bent - ray * (2 * met);
    return bent;
}

} // namespace lightwell
