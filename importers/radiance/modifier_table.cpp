#include "importers/radiance/modifier_table.h"

#include "engine/base/errors.h"
#include "importers/radiance/place_surface.h"
#include "materials/patterns/place_function.h"
#include "materials/patterns/place_program.h"
#include "materials/placed.h"

#include <cstring>

namespace lightwell::scene_text {
namespace {

/// Equal keys: equal name, kind, numbers to the bit, and neighbours.
class KeyWriter {
public:
    std::string key;

    void number(double value)
    {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        key.append(bytes, sizeof bytes);
    }
    void vector(const Vec3& v)
    {
        number(v.x);
        number(v.y);
        number(v.z);
    }
    void spectrum(const Spectrum& s)
    {
        number(s.r);
        number(s.g);
        number(s.b);
    }
    void operator()(const Alias& a) { number(a.target); }
    void operator()(const Inherited&) {}
    void operator()(const SkyBrightness& s)
    {
        number(static_cast<double>(s.kind));
        number(s.zenith);
        number(s.ground);
        number(s.normalization);
        vector(s.to_sun);
        number(s.sharp_horizon);
    }
    void operator()(const Varying& v)
    {
        number(static_cast<double>(v.kind));
        number(v.foreground);
        number(v.background);
        read(v.function->text(), v.function->to_scene());
    }
    void read(const PatternText& text, const Affine& map)
    {
        words(text.type);
        for (const std::string& word : text.words)
            words(word);
        for (const double value : text.numbers)
            number(value);
        number(static_cast<double>(std::hash<std::string>{}(text.contents)));
        for (const Vec3& column : {map.x, map.y, map.z, map.translation})
            vector(column);
    }
    void operator()(const Material& m)
    {
        number(static_cast<double>(m.index()));
        std::visit(*this, m);
    }
    void operator()(const Plastic& m) { surface(m.colour, m.specularity, m.roughness); }
    void operator()(const Metal& m) { surface(m.colour, m.specularity, m.roughness); }
    void operator()(const Trans& m)
    {
        surface(m.colour, m.specularity, m.roughness);
        number(m.transmission);
        number(m.transmitted_specular);
    }
    void operator()(const Dielectric& m) { surface(m.transmission_per_m, m.index, m.hartmann); }
    void operator()(const Glass& m) { surface(m.transmissivity, m.index, 0); }
    void operator()(const Mirror& m)
    {
        spectrum(m.reflectance);
        key += m.alternate;
    }
    void operator()(const Interface& m)
    {
        surface(m.inner_transmission_per_m, m.inner_index, m.outer_index);
        spectrum(m.outer_transmission_per_m);
    }
    void operator()(const Antimatter& m)
    {
        for (const std::string& name : m.erased)
            words(name);
    }
    void operator()(const Mist& m)
    {
        spectrum(m.extinction_per_m);
        surface(m.albedo, m.eccentricity, 0);
        for (const std::string& name : m.sources)
            words(name);
    }
    void functions(const PlaceProgram& program) { read(program.text(), program.to_scene()); }
    void operator()(const Brushed& m) { functions(*m.grain.function); }
    void operator()(const Ashikhmin& m) { functions(*m.grain.function); }
    void operator()(const Functional& m) { functions(*m.function); }
    void operator()(const Measured& m)
    {
        words(m.file);
        functions(*m.up.function);
    }
    void operator()(const Wgmd& m)
    {
        for (const std::string& name : m.tints)
            words(name);
        functions(*m.grain.function);
    }
    void operator()(const Prism& m) { functions(*m.function); }
    void operator()(const Light& m) { spectrum(m.radiance); }
    void operator()(const Illum& m)
    {
        spectrum(m.radiance);
        key += m.alternate;
    }
    void operator()(const Glow& m) { surface(m.radiance, m.max_radius_m, 0); }
    void operator()(const Spotlight& m)
    {
        surface(m.radiance, m.full_angle_deg, 0);
        vector(m.aim);
    }

private:
    void words(const std::string& text) { key.append(text).push_back('\0'); }
    void surface(const Spectrum& s, double a, double b)
    {
        spectrum(s);
        number(a);
        number(b);
    }
};

std::string key_of(const Modifier& modifier)
{
    KeyWriter writer;
    writer.key = modifier.name + '\0' + std::to_string(modifier.parent) + ' ' + std::to_string(modifier.what.index());
    std::visit(writer, modifier.what);
    return std::move(writer.key);
}

Spectrum power(const Spectrum& s, double exponent)
{
    return {std::pow(s.r, exponent), std::pow(s.g, exponent), std::pow(s.b, exponent)};
}

/// The functions of a material move like a pattern; everything else stays.
Material with_moved_functions(Material material, const Affine& map)
{
    if (auto* const functions = functions_of(material); functions != nullptr && *functions != nullptr)
        *functions = std::make_shared<const PlaceProgram>(**functions, map);
    return material;
}

Material transformed(const Material& material, const Affine& map, bool scale_materials)
{
    const double scale = scale_materials ? length(map.x) : 1;
    if (depends_on_place(material))
        return with_moved_functions(material, map);
    if (const auto* mist = std::get_if<Mist>(&material)) {
        Mist scaled = *mist;
        scaled.extinction_per_m = mist->extinction_per_m / scale;
        return scaled;
    }
    if (const auto* border = std::get_if<Interface>(&material); border != nullptr && scale != 1)
        return Interface{power(border->inner_transmission_per_m, 1 / scale), border->inner_index,
                         power(border->outer_transmission_per_m, 1 / scale), border->outer_index};
    if (const auto* spot = std::get_if<Spotlight>(&material))
        return Spotlight{spot->radiance, spot->full_angle_deg, map.vector(spot->aim)};
    if (const auto* glow = std::get_if<Glow>(&material))
        return Glow{glow->radiance, glow->max_radius_m * scale};
    if (const auto* body = std::get_if<Dielectric>(&material); body != nullptr && scale != 1)
        return Dielectric{power(body->transmission_per_m, 1 / scale), body->index, body->hartmann};
    return material;
}

} // namespace

SkyBrightness turned(SkyBrightness sky, const Affine& map, const std::string& place)
{
    constexpr double upright = 1e-9; // radians: rounding of the transform, not a tilt
    if (!(length(cross(map.z, Vec3{0, 0, 1})) <= upright * length(map.z) && map.z.z > 0))
        throw InputError{place, "the transform tilts a sky", "turn skies about z only"};
    sky.to_sun = normalized(map.vector(sky.to_sun));
    return sky;
}

std::optional<Meaning> Scope::find(std::string_view name)
{
    if (const auto entry = own_.find(name); entry != own_.end())
        return entry->second;
    if (outer_ == nullptr)
        return std::nullopt;
    const std::optional<Meaning> found = outer_->find(name);
    seen_outside_.try_emplace(std::string(name), found);
    return found;
}

ModifierTable::ModifierTable(Scene& scene) : scene_(scene)
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i)
        known_.try_emplace(key_of(scene.modifiers[i]), static_cast<ModifierId>(i));
}

ModifierId ModifierTable::add(Modifier modifier)
{
    const auto [entry, fresh] = known_.try_emplace(key_of(modifier), void_modifier);
    if (fresh)
        entry->second = scene_.add_modifier(std::move(modifier));
    return entry->second;
}

ModifierId transformed(const Scene& scene, ModifierTable& table, ModifierId id, const Affine& map,
                       const MaterialChange& change, const std::string& place)
{
    if (id == void_modifier || map == Affine{} || (change.keep != nullptr && change.keep->contains(id)))
        return id;
    if (const bool only_patterns = change.patterns_only || is_translation(map);
        only_patterns && !resolve(scene, id).varies)
        return id;
    const auto again = [&](ModifierId other) { return transformed(scene, table, other, map, change, place); };
    // By index, since the table's additions move the scene's modifiers.
    const auto original = [&]() -> const Modifier& { return scene.modifiers[static_cast<std::size_t>(id)]; };
    const ModifierId parent = again(original().parent);
    if (const auto* alias = std::get_if<Alias>(&original().what)) {
        const Alias changed{again(alias->target)};
        return table.add({original().name, changed, parent});
    }
    if (std::holds_alternative<Varying>(original().what)) {
        Varying varying = std::get<Varying>(original().what);
        varying.function = std::make_shared<const PlaceFunction>(*varying.function, map);
        varying.foreground = again(varying.foreground);
        varying.background = again(varying.background);
        return table.add({original().name, std::move(varying), parent});
    }
    if (const auto* sky = std::get_if<SkyBrightness>(&original().what))
        return table.add({original().name, change.patterns_only ? *sky : turned(*sky, map, place), parent});
    if (const auto* material = std::get_if<Material>(&original().what))
        return table.add({original().name,
                          change.patterns_only ? with_moved_functions(*material, map)
                                               : transformed(*material, map, change.scale_materials),
                          parent});
    return table.add({original().name, Inherited{}, parent});
}

} // namespace lightwell::scene_text
