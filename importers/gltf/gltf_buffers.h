#pragma once

#include "importers/gltf/gltf_document.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace lightwell {

/// Where one buffer's bytes are.
struct GltfBuffer {
    std::string_view bytes;
    std::string fault; ///< why there are none
};

/// @param uri        of the buffer; empty: the BIN chunk
/// @param length     `byteLength`; more bytes than that are cut off
/// @param document   keeps the bytes alive
GltfBuffer open_buffer(const std::string& uri, std::size_t length, std::string_view binary_chunk,
                       const std::filesystem::path& folder, GltfDocument& document);

} // namespace lightwell
