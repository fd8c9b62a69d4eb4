#include "importers/gltf/gltf_buffers.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <array>

namespace lightwell {
namespace {

constexpr std::string_view base64_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// @return nothing when a character does not belong to base64
std::optional<std::string> decode_base64(std::string_view text)
{
    std::array<int, 256> value;
    value.fill(-1);
    for (std::size_t i = 0; i < base64_alphabet.size(); ++i)
        value[static_cast<unsigned char>(base64_alphabet[i])] = static_cast<int>(i);
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    unsigned bits = 0;
    int held = 0;
    for (const char c : text) {
        const int six = value[static_cast<unsigned char>(c)];
        if (six < 0)
            return {};
        bits = bits << 6 | static_cast<unsigned>(six);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(static_cast<char>(bits >> held & 0xff));
        }
    }
    return bytes;
}

GltfBuffer open_data_uri(const std::string& uri, GltfDocument& document)
{
    try {
        document.owned.push_back(std::make_unique<std::string>(data_uri_bytes(uri, "its data URI")));
    } catch (const InputError& error) {
        return {{}, error.what()};
    }
    return {*document.owned.back(), {}};
}

GltfBuffer open_companion(const std::string& uri, const std::filesystem::path& folder, GltfDocument& document)
{
    const auto file = companion_file(uri, folder);
    if (!file)
        return {{}, "its file \"" + uri.substr(0, 100) + "\" is not there"};
    document.files.push_back(std::make_unique<MappedFile>(*file));
    return {document.files.back()->bytes(), {}};
}

} // namespace

std::string data_uri_bytes(const std::string& uri, const std::string& place)
{
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
        throw InputError(place, "is not base64");
    std::optional<std::string> bytes = decode_base64(std::string_view(uri).substr(comma + 1));
    if (!bytes)
        throw InputError(place, "holds characters that are not base64");
    return std::move(*bytes);
}

std::optional<std::filesystem::path> companion_file(const std::string& uri, const std::filesystem::path& folder)
{
    for (const std::string& name : {percent_decoded(uri), uri}) {
        std::error_code none;
        if (name.find('\0') == std::string::npos && std::filesystem::is_regular_file(folder / name, none))
            return folder / name;
    }
    return {};
}

GltfBuffer open_buffer(const std::string& uri, std::size_t length, std::string_view binary_chunk,
                       const std::filesystem::path& folder, GltfDocument& document)
{
    GltfBuffer buffer;
    if (uri.empty())
        buffer = binary_chunk.empty() ? GltfBuffer{{}, std::string(buffer_left_open)} : GltfBuffer{binary_chunk, {}};
    else if (uri.rfind("data:", 0) == 0)
        buffer = open_data_uri(uri, document);
    else
        buffer = open_companion(uri, folder, document);
    if (buffer.fault.empty() && buffer.bytes.size() < length)
        buffer.fault = "it says " + std::to_string(length) + " bytes and has " + std::to_string(buffer.bytes.size());
    buffer.bytes = buffer.bytes.substr(0, length);
    return buffer;
}

} // namespace lightwell
