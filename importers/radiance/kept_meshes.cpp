#include "importers/radiance/kept_meshes.h"

#include "engine/base/files.h"
#include "engine/base/random.h"

#include <cstring>
#include <optional>

namespace lightwell {
namespace {

std::uint64_t hash_of(std::string_view bytes) noexcept
{
    std::uint64_t hash = mix_bits(0, bytes.size());
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t count = std::min(bytes.size(), sizeof word);
        std::memcpy(&word, bytes.data(), count);
        hash = mix_bits(hash, word);
        bytes.remove_prefix(count);
    }
    return hash;
}

} // namespace

KeptMeshes::KeptMeshes() : state_(std::make_unique<State>()) {}
KeptMeshes::~KeptMeshes() = default;

KeptMeshes::Counts KeptMeshes::counts() const noexcept
{
    return state_->counts;
}

void KeptMeshes::State::begin_reading()
{
    counts = {};
    for (auto& [path, file] : files_)
        file.used = false;
}

void KeptMeshes::State::end_reading()
{
    std::erase_if(files_, [](const auto& entry) { return !entry.second.used; });
}

KeptMeshes::State::Built KeptMeshes::State::part(const std::filesystem::path& path, double chord_tolerance_m,
                                                 const Varies& varies)
{
    const std::string name = path.filename().string();
    File& file = files_[path];
    const bool first_use = !file.used;
    std::optional<scene_text::PlyMesh> mesh;
    if (first_use) {
        const MappedFile mapped(path);
        const std::uint64_t contents = hash_of(mapped.bytes());
        if (file.parts.empty() || file.contents != contents) {
            file = {contents, {}};
            mesh = scene_text::read_ply_mesh(mapped.bytes(), name);
            file.modifiers = mesh->modifiers;
        }
        file.used = true;
        ++(mesh ? counts.read : counts.kept);
    }
    const std::vector<bool> textured = varies(file.modifiers);
    Built& built = file.parts[{textured, chord_tolerance_m}];
    if (built)
        return built;
    if (!mesh)
        mesh = scene_text::read_ply_mesh(MappedFile(path).bytes(), name);
    built = std::make_shared<const scene_text::PlyPart>(
        chord_tolerance_m > 0 ? limit_surface_of(*mesh, chord_tolerance_m, name) : faces_of(*mesh, textured, name));
    return built;
}

} // namespace lightwell
