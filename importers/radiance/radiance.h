#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace lightwell {

/// The faces of a mesh file (.ply) behind the surfaces that they became: a polygon is named by the number of its face,
/// a mesh holds many.
struct MeshFile {
    std::vector<std::uint32_t> face_sizes; ///< corners of each face
    std::unordered_map<const Mesh*, std::vector<std::uint32_t>> faces =
        {}; ///< for each triangle the number of its face
};

/// What a scene text tells beside the scene, for results that belong to objects and faces.
struct SceneOrigins {
    /// For each surface of the root the object that `#@from` before it names; empty: none.
    std::vector<std::string> objects;
    std::unordered_map<std::uint32_t, std::shared_ptr<const MeshFile>> mesh_files; ///< by prototype
};

/// Mesh files as they were read, kept from one reading of a scene to the next: those whose bytes are the same are not
/// read, cut and subdivided again.
class KeptMeshes {
public:
    KeptMeshes();
    ~KeptMeshes();
    KeptMeshes(const KeptMeshes&) = delete;
    KeptMeshes& operator=(const KeptMeshes&) = delete;

    /// Of the last reading.
    struct Counts {
        std::size_t kept = 0, read = 0;
    };
    Counts counts() const noexcept;

    struct State;
    State& state() noexcept { return *state_; }

private:
    std::unique_ptr<State> state_;
};

/// Reads a scene description (the core of the Radiance language): materials and emitters, aliases, all surfaces,
/// `mesh` naming an .obj or a .ply, `subdivision` naming a .ply, `instance` naming a .rad file (or NAME.oct beside
/// which NAME.rad stands), the sky function of gensky, our comments `#@from`, `#@view`, `#@grid`; commands in
/// the text (`!xform`, the generators, pipes of them) are answered without running them. Files are looked for beside
/// the referring file, beside `file`, in the working folder and on RAYPATH.
/// @param report  what was left out or repaired, with file and line
/// @return        valid by construction: validate() passes
/// @throws InputError with file and line: unknown modifier or type, wrong number of arguments, NaN, files that refer
///         to each other in a circle, other commands, materials that cannot be read where used
Scene read_radiance(const std::filesystem::path& file, Report& report);
/// The same, with what the text tells beside the scene.
Scene read_radiance(const std::filesystem::path& file, Report& report, KeptMeshes& kept, SceneOrigins& origins);

struct WriteOptions {
    bool flat = false;               ///< expand every instance, so that one file says it all
    double chord_tolerance_m = 1e-3; ///< for round shapes under maps that are no similarity
};
/// Writes `file`; unless flat, prototypes and meshes into NAME.parts beside it, with a script that compiles them for
/// other programs. Reading it back gives the same scene; instances that other programs could not use (emitters and
/// mirrors inside, maps that are no similarity) come back written out, and everything does when flat.
/// Error   maps of instances 1e-12 relative; all else exact but round shapes made of facets, see chord_tolerance_m
/// @throws InputError when the folder is missing, or a flat file would have more than fifty million surfaces
void write_radiance(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options, Report& report);

} // namespace lightwell
