#include "importers/gltf/gltf_accessor.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cstring>

namespace lightwell {
namespace {

/// An accessor without bytes is all zeros; so many of them are believed.
constexpr std::size_t most_zeros = 1u << 20;

std::size_t bytes_of(int component_type)
{
    switch (component_type) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        return 0;
    }
}

template <class Number>
Number load(const char* bytes)
{
    Number number;
    std::memcpy(&number, bytes, sizeof number); // glTF is little-endian, and so is every processor this runs on
    return number;
}

/// Source  glTF 2.0 specification, 3.6.2.2 and 3.11: signed c becomes max(c / (2^(n-1) - 1), -1)
double number_at(const char* bytes, int component_type, bool normalized)
{
    switch (component_type) {
    case 5120: {
        const double value = load<std::int8_t>(bytes);
        return normalized ? std::max(value / 127, -1.0) : value;
    }
    case 5121:
        return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case 5122: {
        const double value = load<std::int16_t>(bytes);
        return normalized ? std::max(value / 32767, -1.0) : value;
    }
    case 5123:
        return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case 5125:
        return load<std::uint32_t>(bytes);
    default:
        return load<float>(bytes);
    }
}

/// Elements of one shape in a view, proven to lie inside it.
struct Elements {
    const char* first = nullptr;
    std::size_t count = 0, stride = 0, component_bytes = 0;
};

/// Columns of matrices are not aligned here: no matrix with columns shorter than four bytes is read.
Elements elements_in(const GltfDocument& document, int view_index, std::size_t offset, std::size_t count,
                     int component_type, int components, bool strided, const std::string& place)
{
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= document.views.size())
        throw InputError(place, "refers to buffer view " + std::to_string(view_index) + " of " +
                                    std::to_string(document.views.size()));
    const GltfView& view = document.views[static_cast<std::size_t>(view_index)];
    if (!view.fault.empty())
        throw InputError(place, view.fault);
    const std::size_t component_bytes = bytes_of(component_type);
    if (component_bytes == 0)
        throw InputError(place, "component type " + std::to_string(component_type) + ", expected 5120 to 5126");
    const std::size_t element = component_bytes * static_cast<std::size_t>(components);
    const std::size_t stride = strided && view.stride > 0 ? view.stride : element;
    const std::size_t size = view.bytes.size();
    const bool fits =
        offset <= size && element <= size - offset && (count <= 1 || count - 1 <= (size - offset - element) / stride);
    if (count > 0 && !fits)
        throw InputError(place, std::to_string(count) + " elements at byte " + std::to_string(offset) +
                                    " do not fit the buffer view of " + std::to_string(size) + " bytes");
    return {view.bytes.data() + offset, count, stride, component_bytes};
}

std::size_t index_at(const Elements& elements, std::size_t i, int component_type)
{
    return static_cast<std::size_t>(number_at(elements.first + i * elements.stride, component_type, false));
}

void apply_sparse(const GltfDocument& document, const GltfAccessor& accessor, std::vector<double>& numbers,
                  const std::string& place)
{
    const GltfAccessor::Sparse& sparse = *accessor.sparse;
    if (sparse.index_type != 5121 && sparse.index_type != 5123 && sparse.index_type != 5125)
        throw InputError(place, "sparse indices have component type " + std::to_string(sparse.index_type));
    const Elements indices =
        elements_in(document, sparse.index_view, sparse.index_offset, sparse.count, sparse.index_type, 1, false, place);
    const Elements values = elements_in(document, sparse.value_view, sparse.value_offset, sparse.count,
                                        accessor.component_type, accessor.components, false, place);
    const auto components = static_cast<std::size_t>(accessor.components);
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::size_t at = index_at(indices, i, sparse.index_type);
        if (at >= accessor.count)
            throw InputError(place, "sparse index " + std::to_string(at) + " of " + std::to_string(accessor.count));
        for (std::size_t c = 0; c < components; ++c)
            numbers[at * components + c] = number_at(values.first + i * values.stride + c * values.component_bytes,
                                                     accessor.component_type, accessor.normalized);
    }
}

const GltfAccessor& accessor_at(const GltfDocument& document, int index)
{
    if (index < 0 || static_cast<std::size_t>(index) >= document.accessors.size())
        throw InputError(document.name, "refers to accessor " + std::to_string(index) + " of " +
                                            std::to_string(document.accessors.size()));
    return document.accessors[static_cast<std::size_t>(index)];
}

std::string place_of(const GltfDocument& document, int index)
{
    return document.name + ": accessor " + std::to_string(index);
}

} // namespace

std::vector<double> read_numbers(const GltfDocument& document, int index, int components)
{
    const GltfAccessor& accessor = accessor_at(document, index);
    const std::string place = place_of(document, index);
    if (accessor.components == 0 || (components > 0 && accessor.components != components))
        throw InputError(place, "has " + std::to_string(accessor.components) + " components, expected " +
                                    std::to_string(components));
    const auto width = static_cast<std::size_t>(accessor.components);
    std::vector<double> numbers;
    if (accessor.view >= 0) {
        const Elements elements = elements_in(document, accessor.view, accessor.offset, accessor.count,
                                              accessor.component_type, accessor.components, true, place);
        numbers.reserve(accessor.count * width);
        for (std::size_t i = 0; i < accessor.count; ++i)
            for (std::size_t c = 0; c < width; ++c)
                numbers.push_back(number_at(elements.first + i * elements.stride + c * elements.component_bytes,
                                            accessor.component_type, accessor.normalized));
    } else {
        if (accessor.count > most_zeros)
            throw InputError(place, std::to_string(accessor.count) + " elements without any bytes");
        numbers.assign(accessor.count * width, 0);
    }
    if (accessor.sparse)
        apply_sparse(document, accessor, numbers, place);
    return numbers;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index)
{
    const GltfAccessor& accessor = accessor_at(document, index);
    const int type = accessor.component_type;
    if (accessor.components != 1 || (type != 5121 && type != 5123 && type != 5125))
        throw InputError(place_of(document, index), "cannot be indices: component type " + std::to_string(type) + ", " +
                                                        std::to_string(accessor.components) + " components");
    std::vector<std::uint32_t> indices;
    for (const double number : read_numbers(document, index, 1))
        indices.push_back(static_cast<std::uint32_t>(number));
    return indices;
}

} // namespace lightwell
