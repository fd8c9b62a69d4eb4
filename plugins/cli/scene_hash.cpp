#include "plugins/cli/scene_hash.h"

#include "engine/base/random.h"

#include <cstring>
#include <type_traits>

namespace lightwell {
namespace {

class Hash {
public:
    void bits(std::uint64_t word) noexcept { state_ = mix_bits(state_, word); }
    void text(const std::string& text) noexcept
    {
        bits(text.size());
        bytes(text.data(), text.size());
    }
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

struct HashWhat {
    Hash& hash;
    void operator()(const Alias& alias) const noexcept { hash.plain(alias); }
    void operator()(const Inherited&) const noexcept {}
    void operator()(const SkyBrightness& sky) const noexcept
    {
        hash.bits(static_cast<std::uint64_t>(sky.kind));
        hash.plain(Vec3{sky.zenith, sky.ground, sky.normalization});
        hash.plain(sky.to_sun);
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
    void add(const Illum& illum) const noexcept
    {
        hash.plain(illum.radiance);
        hash.text(illum.alternate);
    }
};

void add_part(Hash& hash, const Part& part) noexcept
{
    hash.bits(part.surfaces.size());
    for (const Surface& surface : part.surfaces) {
        hash.bits(static_cast<std::uint64_t>(surface.shape) << 32 | surface.index);
        hash.bits(static_cast<std::uint64_t>(surface.modifier));
    }
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
        hash.list(instance.bindings);
    }
}

} // namespace

std::uint64_t scene_hash(const Scene& scene) noexcept
{
    Hash hash;
    for (const Modifier& modifier : scene.modifiers) {
        hash.bits(modifier.what.index());
        hash.bits(static_cast<std::uint64_t>(modifier.parent));
        std::visit(HashWhat{hash}, modifier.what);
    }
    add_part(hash, scene.root);
    for (const Part& part : scene.prototypes)
        add_part(hash, part);
    return hash.value();
}

} // namespace lightwell
