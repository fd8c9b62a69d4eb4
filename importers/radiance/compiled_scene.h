#pragma once

#include "engine/base/box.h"
#include "importers/radiance/read_options.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// \file The compiled scene: what `oconv` writes and every reader of scenes takes.
///
/// A header of text lines (`#?RADIANCE`, the commands that made it, `FORMAT=Radiance_octree`, an empty line), then
/// little-endian binary: a mark with a version, the cube around the scene, what it was made from, modifiers as scene
/// text, geometry as arrays, and a checksum with the length of it all.
namespace lightwell {

/// Text that a scene is read from: a file, or what came on standard input.
struct SceneSource {
    std::string name;                     ///< of the file, or for messages
    std::optional<std::string> text = {}; ///< in place of a file; may be a compiled scene
};
/// A scene with the names that text which is read after it may use.
struct NamedScene {
    Scene scene;
    std::vector<std::pair<std::string, ModifierId>> names;
    std::vector<std::filesystem::path> files; ///< that were read
};
/// Reads one scene from several texts, each of which sees the names of those before it.
/// @throws InputError as read_radiance()
NamedScene read_radiance_sources(const std::vector<SceneSource>& sources, Report& report,
                                 const RadianceReadOptions& options = {});

struct CompileOptions {
    bool frozen = true;              ///< else the sources are read again when they have changed since
    std::vector<std::string> header; ///< lines of history, without their ends
    std::vector<std::string> inputs; ///< files in order; all of them when not frozen
    std::optional<Box> cube;         ///< stated; else around the scene
};
/// Error   none: coordinates and names are kept to the bit
/// @throws InputError for what cannot be told in a compiled scene (a pattern under a map that is no similarity)
void write_compiled(const NamedScene& named, const CompileOptions& options, std::ostream& out);

/// The head of a compiled scene.
struct CompiledHead {
    std::vector<std::string> header; ///< history: without the first line and FORMAT
    bool frozen = true;
    Box cube;
    std::size_t body = 0; ///< offset of the binary part behind the mark
};
/// Whether bytes are a compiled scene of ours.
bool is_compiled_scene(std::string_view bytes) noexcept;
/// @throws InputError for another version, or what is cut off or damaged
CompiledHead compiled_head(std::string_view bytes, const std::string& place);

} // namespace lightwell
