#include "importers/gltf/gltf_container.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cstdint>

namespace lightwell {
namespace {

/// The format needs about ten levels; extras may go on for a while.
constexpr int deepest_json = 128;
constexpr std::size_t glb_header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t chunk_json = 0x4e4f534a, chunk_bin = 0x004e4942;

/// Little-endian, as GLB is.
std::uint32_t number_at(std::string_view bytes, std::size_t at) noexcept
{
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

GltfContainer open_glb(std::string_view bytes, const std::string& name)
{
    if (bytes.size() < glb_header_bytes + chunk_header_bytes)
        throw InputError(name, "GLB of " + std::to_string(bytes.size()) + " bytes, expected at least 20",
                         "the file is truncated; export it again");
    const std::uint32_t version = number_at(bytes, 4), length = number_at(bytes, 8);
    if (version != 2)
        throw InputError(name, "GLB version " + std::to_string(version) + ", expected 2", "export it as glTF 2.0");
    if (length > bytes.size())
        throw InputError(name, "GLB says " + std::to_string(length) + " bytes and has " + std::to_string(bytes.size()),
                         "the file is truncated; export it again");
    GltfContainer container;
    container.is_binary = true;
    std::size_t at = glb_header_bytes;
    for (int chunk = 0; at + chunk_header_bytes <= length; ++chunk) {
        const std::size_t size = number_at(bytes, at), begin = at + chunk_header_bytes;
        const std::uint32_t type = number_at(bytes, at + 4);
        if (size > length - begin)
            throw InputError(
                name, "chunk of " + std::to_string(size) + " bytes at byte " + std::to_string(at) + " leaves the file",
                "the file is damaged; export it again");
        if (chunk == 0 && type != chunk_json)
            throw InputError(name, "first chunk is not JSON", "the file is damaged; export it again");
        if (chunk == 0)
            container.json = bytes.substr(begin, size);
        else if (type == chunk_bin && container.binary.empty())
            container.binary = bytes.substr(begin, size);
        at = begin + (size + 3) / 4 * 4;
    }
    return container;
}

} // namespace

GltfContainer open_container(std::string_view bytes, const std::string& name)
{
    if (bytes.substr(0, 4) == "glTF")
        return open_glb(bytes, name);
    if (bytes.substr(0, 3) == "\xef\xbb\xbf")
        bytes.remove_prefix(3);
    return {bytes, {}, false};
}

std::size_t line_of(std::string_view text, std::size_t byte) noexcept
{
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

void check_json_depth(std::string_view json, const std::string& name)
{
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (quoted) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                quoted = false;
            continue;
        }
        if (c == '"')
            quoted = true;
        else if (c == '[' || c == '{')
            ++depth;
        else if (c == ']' || c == '}')
            --depth;
        if (depth > deepest_json)
            throw InputError(name + ":" + std::to_string(line_of(json, i)),
                             "brackets nest deeper than " + std::to_string(deepest_json), "no glTF file needs that");
    }
}

} // namespace lightwell
