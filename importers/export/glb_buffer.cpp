#include "importers/export/glb_buffer.h"

#include <bit>
#include <cstring>

namespace lightwell {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they stand in memory");
constexpr int vertex_numbers = 34962, index_numbers = 34963;

void append_word(std::string& text, std::size_t value)
{
    const auto word = static_cast<std::uint32_t>(value);
    char bytes[sizeof word];
    std::memcpy(bytes, &word, sizeof word);
    text.append(bytes, sizeof word);
}

/// Chunks end at multiples of four bytes.
std::string padded(std::string_view chunk, char with)
{
    std::string text{chunk};
    text.resize((text.size() + 3) / 4 * 4, with);
    return text;
}

} // namespace

std::size_t GlbBuffer::add(const void* data, std::size_t bytes, int target)
{
    views_.push_back({bytes_.size(), bytes, target});
    bytes_.append(static_cast<const char*>(data), bytes);
    return views_.size() - 1;
}

std::size_t GlbBuffer::add_vectors(const std::vector<Vec3>& vectors)
{
    std::vector<float> numbers;
    Vec3 low{infinity, infinity, infinity}, high = -low;
    for (const Vec3& vector : vectors) {
        const float x = static_cast<float>(vector.x), y = static_cast<float>(vector.y),
                    z = static_cast<float>(vector.z);
        numbers.insert(numbers.end(), {x, y, z});
        low = min(low, Vec3{x, y, z});
        high = max(high, Vec3{x, y, z});
    }
    const std::size_t view = add(numbers.data(), numbers.size() * sizeof(float), vertex_numbers);
    accessors_.push_back({view, vectors.size(), false, low, high});
    return accessors_.size() - 1;
}

std::size_t GlbBuffer::add_indices(const std::vector<std::uint32_t>& indices)
{
    const std::size_t view = add(indices.data(), indices.size() * sizeof(std::uint32_t), index_numbers);
    accessors_.push_back({view, indices.size(), true, {}, {}});
    return accessors_.size() - 1;
}

std::string GlbBuffer::file(std::string_view json) const
{
    const std::string text = padded(json, ' '), binary = padded(bytes_, '\0');
    std::string file = "glTF";
    append_word(file, 2);
    append_word(file, 12 + 8 + text.size() + 8 + binary.size());
    append_word(file, text.size());
    file += "JSON";
    file += text;
    append_word(file, binary.size());
    file.append("BIN\0", 4);
    return file + binary;
}

} // namespace lightwell
