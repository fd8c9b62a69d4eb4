#include "engine/scene/scene_hash.h"

#include "engine/base/random.h"
#include "materials/patterns/place_function.h"
#include "materials/patterns/place_program.h"

#include <cstring>
#include <type_traits>

namespace lightwell {
namespace {

class Hash {
public:
    void bits(std::uint64_t word) noexcept { state_ = mix_bits(state_, word); }
    /// Values without padding: made of doubles, or of words of four bytes.
    template <class T>
    void plain(const T& value) noexcept
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        bytes(&value, sizeof value);
    }
    template <class T>
    void list(const std::vector<T>& values) noexcept
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        bits(values.size());
        bytes(values.data(), values.size() * sizeof(T));
    }
    void text(const std::string& value) noexcept
    {
        bits(value.size());
        bytes(value.data(), value.size());
    }
    std::uint64_t value() const noexcept { return state_; }

private:
    void bytes(const void* data, std::size_t size) noexcept
    {
        const char* next = static_cast<const char*>(data);
        for (; size > 0;) {
            std::uint64_t word = 0;
            const std::size_t part = size < sizeof word ? size : sizeof word;
            std::memcpy(&word, next, part);
            bits(word);
            next += part;
            size -= part;
        }
    }
    std::uint64_t state_ = 0;
};

/// The modifiers in use, numbered in the order of first use, so that unused ones and their order do not count.
class UsedModifiers {
public:
    explicit UsedModifiers(const Scene& scene) : scene_(scene), numbers_(scene.modifiers.size(), unused)
    {
        add_part(scene.root);
        for (const Part& part : scene.prototypes)
            add_part(part);
    }
    const std::vector<ModifierId>& in_order() const noexcept { return order_; }
    std::uint64_t number(ModifierId id) const noexcept
    {
        return id == void_modifier ? unused : numbers_[static_cast<std::size_t>(id)];
    }

private:
    static constexpr std::uint64_t unused = ~std::uint64_t{0};

    void add_part(const Part& part)
    {
        for (const Surface& surface : part.surfaces)
            add(surface.modifier);
        for (const Instance& instance : part.instances)
            for (const Binding& binding : instance.bindings) {
                add(binding.inherited);
                add(binding.actual);
            }
    }
    void add(ModifierId id)
    {
        std::vector<ModifierId> waiting{id}; // no recursion: a chain of names may be long
        while (!waiting.empty()) {
            const ModifierId next = waiting.back();
            waiting.pop_back();
            if (next == void_modifier || number(next) != unused)
                continue;
            numbers_[static_cast<std::size_t>(next)] = order_.size();
            order_.push_back(next);
            const Modifier& modifier = scene_.modifiers[static_cast<std::size_t>(next)];
            waiting.push_back(modifier.parent);
            if (const auto* alias = std::get_if<Alias>(&modifier.what))
                waiting.push_back(alias->target);
            if (const auto* varying = std::get_if<Varying>(&modifier.what)) {
                waiting.push_back(varying->foreground);
                waiting.push_back(varying->background);
            }
            if (const auto* material = std::get_if<Material>(&modifier.what))
                for (const std::string& name : named_modifiers(*material))
                    waiting.push_back(scene_.find_modifier(name));
        }
    }

    const Scene& scene_;
    std::vector<std::uint64_t> numbers_;
    std::vector<ModifierId> order_;
};

struct HashWhat {
    Hash& hash;
    const Scene& scene;
    const UsedModifiers& used;

    void operator()(const Alias& alias) const noexcept { hash.bits(used.number(alias.target)); }
    void operator()(const Inherited&) const noexcept {}
    void operator()(const SkyBrightness& sky) const noexcept
    {
        hash.bits(static_cast<std::uint64_t>(sky.kind) << 1 | (sky.sharp_horizon ? 1 : 0));
        hash.plain(Vec3{sky.zenith, sky.ground, sky.normalization});
        hash.plain(sky.to_sun);
    }
    void operator()(const Varying& varying) const noexcept
    {
        const PatternText& text = varying.function->text();
        hash.bits(static_cast<std::uint64_t>(varying.kind));
        hash.bits(used.number(varying.foreground));
        hash.bits(used.number(varying.background));
        hash.text(text.type);
        for (const std::string& word : text.words)
            hash.text(word);
        hash.list(text.numbers);
        hash.text(text.contents);
        hash.plain(varying.function->to_scene());
    }
    void operator()(const Material& material) const noexcept
    {
        hash.bits(material.index());
        std::visit([this](const auto& m) { add(m); }, material);
    }
    template <class T>
    void add(const T& material) const noexcept
    {
        hash.plain(material);
    }
    void functions(const PlaceProgram& program) const noexcept
    {
        const PatternText& text = program.text();
        hash.text(text.type);
        for (const std::string& word : text.words)
            hash.text(word);
        hash.list(text.numbers);
        hash.text(text.contents);
        hash.plain(program.to_scene());
    }
    void add(const Mirror& m) const noexcept
    {
        hash.plain(m.reflectance);
        hash.bits(used.number(scene.find_modifier(m.alternate)));
    }
    void add(const Brushed& m) const noexcept
    {
        hash.bits(static_cast<std::uint64_t>(m.kind));
        functions(*m.grain.function);
    }
    void add(const Ashikhmin& m) const noexcept { functions(*m.grain.function); }
    void add(const Functional& m) const noexcept
    {
        hash.bits(static_cast<std::uint64_t>(m.kind));
        functions(*m.function);
    }
    void add(const Measured& m) const noexcept
    {
        hash.bits(m.passes_straight ? 1 : 0);
        functions(*m.up.function); // whose contents are those of the file too
    }
    void add(const Wgmd& m) const noexcept
    {
        for (const std::string& tint : m.tints)
            hash.bits(used.number(scene.find_modifier(tint)));
        functions(*m.grain.function);
    }
    void add(const Prism& m) const noexcept { functions(*m.function); }
    void add(const Antimatter& m) const noexcept
    {
        for (const std::string& name : m.erased)
            hash.bits(used.number(scene.find_modifier(name)));
    }
    void add(const Mist& m) const noexcept
    {
        hash.plain(m.extinction_per_m);
        hash.plain(m.albedo);
        hash.plain(m.eccentricity);
    }
    void add(const Illum& illum) const noexcept
    {
        hash.plain(illum.radiance);
        hash.bits(used.number(scene.find_modifier(illum.alternate)));
    }
};

std::string kind_of(const Modifier& modifier)
{
    if (std::holds_alternative<Alias>(modifier.what))
        return "name";
    if (const auto* material = std::get_if<Material>(&modifier.what))
        return is_emitter(*material) ? "source" : "material";
    return std::holds_alternative<Inherited>(modifier.what) ? "inherited" : "pattern";
}

void add_geometry(Hash& hash, const Part& part) noexcept
{
    hash.bits(part.surfaces.size());
    for (const Surface& surface : part.surfaces)
        hash.bits(static_cast<std::uint64_t>(surface.shape) << 32 | surface.index);
    hash.list(part.points);
    hash.list(part.polygons);
    hash.list(part.spheres);
    hash.list(part.cones);
    hash.list(part.rings);
    hash.list(part.sources);
    for (const auto& mesh : part.meshes) {
        hash.list(mesh->points);
        hash.list(mesh->triangles);
        hash.list(mesh->normals);
        hash.list(mesh->texture);
    }
    for (const Instance& instance : part.instances) {
        hash.bits(instance.prototype);
        hash.plain(instance.to_parent);
    }
}

void add_assignment(Hash& hash, const Part& part, const UsedModifiers& used) noexcept
{
    hash.bits(part.surfaces.size());
    for (const Surface& surface : part.surfaces)
        hash.bits(used.number(surface.modifier));
    for (const Instance& instance : part.instances) {
        hash.bits(instance.bindings.size());
        for (const Binding& binding : instance.bindings) {
            hash.bits(used.number(binding.inherited));
            hash.bits(used.number(binding.actual));
        }
    }
}

} // namespace

SceneFingerprint scene_fingerprint(const Scene& scene)
{
    const UsedModifiers used(scene);
    Hash geometry, assignment;
    add_geometry(geometry, scene.root);
    add_assignment(assignment, scene.root, used);
    for (const Part& part : scene.prototypes) {
        add_geometry(geometry, part);
        add_assignment(assignment, part, used);
    }
    SceneFingerprint found{geometry.value(), assignment.value(), {}};
    for (const ModifierId id : used.in_order()) {
        const Modifier& modifier = scene.modifiers[static_cast<std::size_t>(id)];
        Hash hash;
        hash.bits(modifier.what.index());
        hash.bits(used.number(modifier.parent));
        std::visit(HashWhat{hash, scene, used}, modifier.what);
        found.modifiers.emplace_back(kind_of(modifier) + " \"" + modifier.name + '"', hash.value());
    }
    return found;
}

std::uint64_t scene_hash(const Scene& scene)
{
    const SceneFingerprint parts = scene_fingerprint(scene);
    Hash hash;
    hash.bits(parts.geometry);
    hash.bits(parts.assignment);
    for (const auto& modifier : parts.modifiers)
        hash.bits(modifier.second);
    return hash.value();
}

} // namespace lightwell
