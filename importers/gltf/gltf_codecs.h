#pragma once

#include "importers/gltf/gltf_document.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// How EXT_meshopt_compression packed a view.
struct MeshoptPacking {
    std::string mode, filter;
    std::size_t count = 0, stride = 0;
};

/// @return the unpacked bytes, count * stride of them
/// @throws InputError  damaged bytes, numbers that do not fit the mode, more bytes than such data can hold
std::string unpack_meshopt(std::string_view packed, const MeshoptPacking& packing, const std::string& place);

/// What a Draco mesh holds.
struct DracoMesh {
    std::vector<std::uint32_t> triangles;
    std::map<std::string, std::vector<double>> values; ///< by attribute, components of each point in a row
    std::map<std::string, int> components;
};

/// @param attributes  name and unique id of those that are wanted
/// @throws InputError for damaged bytes or an id that is not there
DracoMesh unpack_draco(std::string_view packed, const std::map<std::string, int>& attributes, const std::string& place);

} // namespace lightwell
