#pragma once

#include "importers/gltf/gltf_document.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// @param index       of the accessor, as the file says
/// @param components  expected; 0: any
/// @return            count * components numbers, normalised integers as [-1, 1] or [0, 1], sparse values applied
/// @throws InputError an index that leads nowhere, bytes outside the view, an absurd count; place is the accessor
std::vector<double> read_numbers(const GltfDocument& document, int index, int components);

/// The same for three components.
std::vector<Vec3> read_vectors(const GltfDocument& document, int index);

/// Unsigned integers of an index accessor.
/// @throws InputError as read_numbers(), and for a component type that cannot be an index
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index);

} // namespace lightwell
