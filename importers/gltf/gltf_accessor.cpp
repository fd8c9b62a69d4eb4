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

/// Calls emit(i, numbers of element i). The type is chosen once, since a file has millions of elements.
/// @param largest  that stands for 1 when integers are fractions; 0: they stand for themselves
/// Source  glTF 2.0 specification, 3.6.2.2 and 3.11: signed c becomes max(c / (2^(n-1) - 1), -1)
template <class Number, class Emit>
void each_row(const Elements& elements, std::size_t width, double largest, const Emit& emit)
{
    double row[16] = {};
    for (std::size_t i = 0; i < elements.count; ++i) {
        const char* at = elements.first + i * elements.stride;
        for (std::size_t c = 0; c < width; ++c) {
            const auto number = static_cast<double>(load<Number>(at + c * sizeof(Number)));
            row[c] = largest > 0 ? std::max(number / largest, -1.0) : number;
        }
        emit(i, row);
    }
}

template <class Emit>
void each_row(const Elements& elements, std::size_t width, int type, bool normalized, const Emit& emit)
{
    switch (type) {
    case 5120:
        return each_row<std::int8_t>(elements, width, normalized ? 127 : 0, emit);
    case 5121:
        return each_row<std::uint8_t>(elements, width, normalized ? 255 : 0, emit);
    case 5122:
        return each_row<std::int16_t>(elements, width, normalized ? 32767 : 0, emit);
    case 5123:
        return each_row<std::uint16_t>(elements, width, normalized ? 65535 : 0, emit);
    case 5125:
        return each_row<std::uint32_t>(elements, width, 0, emit);
    default:
        return each_row<float>(elements, width, 0, emit);
    }
}

template <class Emit>
void apply_sparse(const GltfDocument& document, const GltfAccessor& accessor, const std::string& place,
                  const Emit& emit)
{
    const GltfAccessor::Sparse& sparse = *accessor.sparse;
    if (sparse.index_type != 5121 && sparse.index_type != 5123 && sparse.index_type != 5125)
        throw InputError(place, "sparse indices have component type " + std::to_string(sparse.index_type));
    const Elements indices =
        elements_in(document, sparse.index_view, sparse.index_offset, sparse.count, sparse.index_type, 1, false, place);
    const Elements values = elements_in(document, sparse.value_view, sparse.value_offset, sparse.count,
                                        accessor.component_type, accessor.components, false, place);
    std::vector<std::size_t> targets;
    each_row(indices, 1, sparse.index_type, false, [&](std::size_t, const double* row) {
        targets.push_back(static_cast<std::size_t>(row[0]));
        if (targets.back() >= accessor.count)
            throw InputError(place, "sparse index " + std::to_string(targets.back()) + " of " +
                                        std::to_string(accessor.count));
    });
    each_row(values, static_cast<std::size_t>(accessor.components), accessor.component_type, accessor.normalized,
             [&](std::size_t i, const double* row) { emit(targets[i], row); });
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

/// Calls prepare(count, width) when the accessor is known to be sound, then emit(i, row) for its elements; those that
/// have no bytes are zero and not told of.
template <class Prepare, class Emit>
void read_rows(const GltfDocument& document, int index, int components, const Prepare& prepare, const Emit& emit)
{
    const GltfAccessor& accessor = accessor_at(document, index);
    const std::string place = place_of(document, index);
    if (accessor.components == 0 || (components > 0 && accessor.components != components))
        throw InputError(place, "has " + std::to_string(accessor.components) + " components, expected " +
                                    std::to_string(components));
    const auto width = static_cast<std::size_t>(accessor.components);
    if (accessor.view >= 0) {
        const Elements elements = elements_in(document, accessor.view, accessor.offset, accessor.count,
                                              accessor.component_type, accessor.components, true, place);
        prepare(accessor.count, width);
        each_row(elements, width, accessor.component_type, accessor.normalized, emit);
    } else {
        if (accessor.count > most_zeros)
            throw InputError(place, std::to_string(accessor.count) + " elements without any bytes");
        prepare(accessor.count, width);
    }
    if (accessor.sparse)
        apply_sparse(document, accessor, place, emit);
}

} // namespace

std::vector<double> read_numbers(const GltfDocument& document, int index, int components)
{
    std::vector<double> numbers;
    std::size_t row_size = 0;
    read_rows(
        document, index, components,
        [&](std::size_t count, std::size_t width) {
            numbers.resize(count * width);
            row_size = width;
        },
        [&](std::size_t i, const double* row) { std::copy(row, row + row_size, &numbers[i * row_size]); });
    return numbers;
}

std::vector<Vec3> read_vectors(const GltfDocument& document, int index)
{
    std::vector<Vec3> vectors;
    read_rows(
        document, index, 3, [&](std::size_t count, std::size_t) { vectors.resize(count); },
        [&](std::size_t i, const double* row) {
            vectors[i] = {row[0], row[1], row[2]};
        });
    return vectors;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index)
{
    const GltfAccessor& accessor = accessor_at(document, index);
    const int type = accessor.component_type;
    if (accessor.components != 1 || (type != 5121 && type != 5123 && type != 5125))
        throw InputError(place_of(document, index), "cannot be indices: component type " + std::to_string(type) + ", " +
                                                        std::to_string(accessor.components) + " components");
    std::vector<std::uint32_t> indices;
    read_rows(
        document, index, 1, [&](std::size_t count, std::size_t) { indices.resize(count); },
        [&](std::size_t i, const double* row) { indices[i] = static_cast<std::uint32_t>(row[0]); });
    return indices;
}

} // namespace lightwell
