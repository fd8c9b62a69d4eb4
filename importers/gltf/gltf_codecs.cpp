#include "importers/gltf/gltf_codecs.h"

#include "engine/base/errors.h"

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <limits>

namespace lightwell {
namespace {

/// The codec spends at least a bit on sixteen equal bytes, rounded up generously: a small file cannot ask for
/// terabytes.
constexpr std::size_t most_bytes_per_packed_byte = 4096;
/// Attributes have at most four components in glTF.
constexpr int most_components = 4;

} // namespace

std::string unpack_meshopt(std::string_view packed, const MeshoptPacking& packing, const std::string& place)
{
    const std::size_t count = packing.count, stride = packing.stride;
    const bool attributes = packing.mode == "ATTRIBUTES", triangles = packing.mode == "TRIANGLES";
    const bool stride_fits = attributes ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if ((!attributes && !triangles && packing.mode != "INDICES") || !stride_fits || (triangles && count % 3 != 0))
        throw InputError(place, "packed view has mode \"" + packing.mode + "\", stride " + std::to_string(stride) +
                                    ", count " + std::to_string(count));
    if (count > packed.size() * most_bytes_per_packed_byte / stride)
        throw InputError(place, "packed view of " + std::to_string(packed.size()) + " bytes says " +
                                    std::to_string(count) + " elements, more than it can hold");
    std::string bytes(count * stride, '\0');
    const auto* data = reinterpret_cast<const unsigned char*>(packed.data());
    int failed = 0;
    if (attributes)
        failed = meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, packed.size());
    else if (triangles)
        failed = meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, packed.size());
    else
        failed = meshopt_decodeIndexSequence(bytes.data(), count, stride, data, packed.size());
    if (failed != 0)
        throw InputError(place, "packed bytes are damaged", "export the file again");
    if (packing.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    else if (packing.filter == "QUATERNION" && stride == 8)
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    else if (packing.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    else if (!packing.filter.empty() && packing.filter != "NONE")
        throw InputError(place, "filter \"" + packing.filter + "\" does not fit stride " + std::to_string(stride));
    return bytes;
}

DracoMesh unpack_draco(std::string_view packed, const std::map<std::string, int>& attributes, const std::string& place)
{
    draco::DecoderBuffer buffer;
    buffer.Init(packed.data(), packed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw InputError(place, "Draco data is damaged: " + decoded.status().error_msg_string());
    const draco::Mesh& mesh = *decoded.value();
    DracoMesh result;
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (int corner = 0; corner < 3; ++corner)
            result.triangles.push_back(mesh.face(face)[static_cast<std::size_t>(corner)].value());
    for (const auto& [name, id] : attributes) {
        const draco::PointAttribute* attribute =
            id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
        if (!attribute || attribute->num_components() < 1 || attribute->num_components() > most_components)
            throw InputError(place, "Draco data has no attribute " + std::to_string(id) + " for " + name);
        std::vector<double>& values = result.values[name];
        result.components[name] = attribute->num_components();
        for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
            float numbers[most_components] = {};
            const draco::AttributeValueIndex index = attribute->mapped_index(point);
            if (index.value() >= attribute->size() ||
                !attribute->ConvertValue<float>(index, attribute->num_components(), numbers))
                throw InputError(place, "Draco data of " + name + " is damaged");
            values.insert(values.end(), numbers, numbers + attribute->num_components());
        }
    }
    return result;
}

} // namespace lightwell
