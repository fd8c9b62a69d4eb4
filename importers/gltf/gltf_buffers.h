#pragma once

#include "importers/gltf/gltf_document.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lightwell {

/// Where one buffer's bytes are.
struct GltfBuffer {
    std::string_view bytes;
    std::string fault; ///< why there are none
};

/// The fault of a buffer that the format allows to have no bytes; extensions fill such buffers.
inline constexpr std::string_view buffer_left_open = "it has neither a URI nor a binary chunk";

/// The bytes of `data:...;base64,...`.
/// @throws InputError when it is not base64
std::string data_uri_bytes(const std::string& uri, const std::string& place);

/// The file that a URI names beside the document; nothing when there is none.
std::optional<std::filesystem::path> companion_file(const std::string& uri, const std::filesystem::path& folder);

/// @param uri        of the buffer; empty: the BIN chunk
/// @param length     `byteLength`; more bytes than that are cut off
/// @param document   keeps the bytes alive
GltfBuffer open_buffer(const std::string& uri, std::size_t length, std::string_view binary_chunk,
                       const std::filesystem::path& folder, GltfDocument& document);

} // namespace lightwell
