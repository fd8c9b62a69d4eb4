// The only file that includes tinygltf: it turns JSON into structures; everything in them is taken as a claim of the
// file and checked where it is used. Buffers, packed geometry and images are not its business.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#include <fstream> // tinygltf forgets it
#include <nlohmann/json.hpp>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/gltf/gltf_buffers.h"
#include "importers/gltf/gltf_codecs.h"
#include "importers/gltf/gltf_container.h"
#include "importers/gltf/gltf_document.h"
#include "importers/gltf/gltf_json.h"
#include "importers/gltf/gltf_parts.h"

#include <limits>

namespace lightwell {
namespace {

using Value = tinygltf::Value;

/// A number of an extension; the fallback when it is missing or no number.
double number_in(const Value& object, const char* key, double fallback)
{
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber())
        return fallback;
    const double value = object.Get(key).GetNumberAsDouble();
    return std::isfinite(value) ? value : fallback;
}

int index_in(const Value& object, const char* key)
{
    return object.IsObject() && object.Has(key) && object.Get(key).IsInt() ? object.Get(key).Get<int>() : -1;
}

std::string text_in(const Value& object, const char* key)
{
    return object.IsObject() && object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>()
                                                                              : std::string();
}

std::map<std::string, int> indices_in(const Value& object, const char* key)
{
    std::map<std::string, int> indices;
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsObject())
        return indices;
    const Value list = object.Get(key);
    for (const std::string& name : list.Keys())
        indices[name] = index_in(list, name.c_str());
    return indices;
}

const Value* extension(const tinygltf::ExtensionMap& extensions, const char* name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

tinygltf::Model parse(const GltfJson& json, const std::string& name)
{
    if (json.text.size() > std::numeric_limits<unsigned>::max())
        throw InputError(name, "JSON of more than 4 GB", "export it as GLB");
    tinygltf::Model model;
    std::string errors, warnings;
    bool good = false;
    try {
        good = tinygltf::TinyGLTF().LoadASCIIFromString(&model, &errors, &warnings, json.text.data(),
                                                        static_cast<unsigned>(json.text.size()), "", 0);
    } catch (const nlohmann::json::exception& error) {
        errors = error.what();
    }
    if (good)
        return model;
    const std::string first = errors.substr(0, errors.find('\n'));
    throw InputError(name, "not valid glTF: " + first, "the file is damaged; export it again");
}

/// The bytes [offset, offset + length) of a buffer, or the reason why they cannot be had.
GltfView slice(const std::vector<GltfBuffer>& buffers, long long buffer, std::size_t offset, std::size_t length,
               std::size_t stride, const std::string& view)
{
    if (buffer < 0 || static_cast<std::size_t>(buffer) >= buffers.size())
        return {{}, 0, view + " refers to buffer " + std::to_string(buffer) + " of " + std::to_string(buffers.size())};
    const GltfBuffer& from = buffers[static_cast<std::size_t>(buffer)];
    if (!from.fault.empty())
        return {{}, 0, "buffer " + std::to_string(buffer) + ": " + from.fault};
    if (offset > from.bytes.size() || length > from.bytes.size() - offset)
        return {{},
                0,
                view + " reaches byte " + std::to_string(offset) + " + " + std::to_string(length) + " of a buffer of " +
                    std::to_string(from.bytes.size())};
    return {from.bytes.substr(offset, length), stride, {}};
}

GltfView unpacked(const Value& packing, const std::vector<GltfBuffer>& buffers, const std::string& name,
                  GltfDocument& document)
{
    const auto size = [&](const char* key) {
        const double value = number_in(packing, key, 0);
        return value >= 0 && value < 1e15 ? static_cast<std::size_t>(value) : std::numeric_limits<std::size_t>::max();
    };
    GltfView view = slice(buffers, index_in(packing, "buffer"), size("byteOffset"), size("byteLength"), 0, name);
    if (!view.fault.empty())
        return view;
    const MeshoptPacking how{text_in(packing, "mode"), text_in(packing, "filter"), size("count"), size("byteStride")};
    try {
        document.owned.push_back(std::make_unique<std::string>(unpack_meshopt(view.bytes, how, name)));
    } catch (const InputError& error) {
        return {{}, 0, error.what()};
    }
    return {*document.owned.back(), how.stride, {}};
}

void take_views(const tinygltf::Model& model, const GltfJson& json, std::string_view binary,
                const std::filesystem::path& folder, GltfDocument& document)
{
    std::vector<GltfBuffer> buffers;
    for (const GltfJson::Buffer& buffer : json.buffers)
        buffers.push_back(open_buffer(buffer.uri, buffer.length, binary, folder, document));
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
        const tinygltf::BufferView& view = model.bufferViews[i];
        const std::string name = "buffer view " + std::to_string(i);
        const Value* packing = extension(view.extensions, "EXT_meshopt_compression");
        if (!packing)
            packing = extension(view.extensions, "KHR_meshopt_compression");
        document.views.push_back(
            packing ? unpacked(*packing, buffers, name, document)
                    : slice(buffers, view.buffer, view.byteOffset, view.byteLength, view.byteStride, name));
    }
}

int components_of(int type)
{
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT3:
        return 9;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0;
    }
}

GltfAccessor accessor_of(const tinygltf::Accessor& from)
{
    GltfAccessor accessor{from.bufferView,          from.byteOffset, from.count, from.componentType,
                          components_of(from.type), from.normalized, {}};
    if (from.sparse.isSparse) {
        const auto size = [](long long value) {
            return value < 0 ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(value);
        };
        accessor.sparse = GltfAccessor::Sparse{
            size(from.sparse.count),       from.sparse.indices.bufferView,       from.sparse.indices.componentType,
            from.sparse.values.bufferView, size(from.sparse.indices.byteOffset), size(from.sparse.values.byteOffset)};
    }
    return accessor;
}

GltfMesh mesh_of(const tinygltf::Mesh& from)
{
    GltfMesh mesh{from.name, {}, from.weights};
    for (const tinygltf::Primitive& part : from.primitives) {
        GltfPrimitive primitive{part.mode,   index_in(part.extras, "indices"), part.material, part.attributes, {},
                                part.targets};
        if (const Value* packed = extension(part.extensions, "KHR_draco_mesh_compression"))
            primitive.draco = GltfDraco{index_in(*packed, "bufferView"), indices_in(*packed, "attributes")};
        mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
}

/// Source  glTF 2.0 specification, 3.5.3: translation * rotation * scale; rotation is a unit quaternion x y z w
Affine placement_of(const tinygltf::Node& node, const std::string& place)
{
    const auto& m = node.matrix;
    if (m.size() == 16)
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    const bool sizes_fit = m.empty() && (node.rotation.empty() || node.rotation.size() == 4) &&
                           (node.scale.empty() || node.scale.size() == 3) &&
                           (node.translation.empty() || node.translation.size() == 3);
    if (!sizes_fit)
        throw InputError(place, "matrix, rotation, scale or translation has a wrong number of values",
                         "expected 16, 4, 3 and 3");
    Affine placement;
    if (!node.rotation.empty())
        placement = rotation_of(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
    if (!node.scale.empty())
        placement = compose(placement, Affine::scale(Vec3{node.scale[0], node.scale[1], node.scale[2]}));
    if (!node.translation.empty())
        placement.translation = {node.translation[0], node.translation[1], node.translation[2]};
    return placement;
}

GltfNode node_of(const tinygltf::Node& from, const std::string& place)
{
    GltfNode node;
    node.name = from.name;
    node.layer = text_in(from.extras, "layer");
    node.to_parent = placement_of(from, place);
    node.mesh = from.mesh;
    node.camera = from.camera;
    node.skin = from.skin;
    node.weights = from.weights;
    node.children = from.children;
    if (const Value* light = extension(from.extensions, "KHR_lights_punctual"))
        node.light = index_in(*light, "light");
    if (const Value* copies = extension(from.extensions, "EXT_mesh_gpu_instancing"))
        node.instancing = indices_in(*copies, "attributes");
    return node;
}

GltfCamera camera_of(const tinygltf::Camera& from)
{
    return {from.name,
            from.type == "perspective",
            from.perspective.yfov,
            from.perspective.aspectRatio,
            from.orthographic.xmag,
            from.orthographic.ymag};
}

/// The nodes of the default scene, of the first one, or, in a file without scenes, all nodes that are no child.
std::vector<int> roots_of(const tinygltf::Model& model, const std::string& name, Report& report)
{
    if (!model.scenes.empty()) {
        const bool there =
            model.defaultScene >= 0 && static_cast<std::size_t>(model.defaultScene) < model.scenes.size();
        if (model.scenes.size() > 1)
            report.add(Finding::ignored, name, "scenes beside the one that is shown", model.scenes.size() - 1);
        if (model.defaultScene >= 0 && !there)
            report.add(Finding::repaired, name, "default scene is not there; the first one is taken");
        return model.scenes[there ? static_cast<std::size_t>(model.defaultScene) : 0].nodes;
    }
    if (!model.nodes.empty())
        report.add(Finding::assumed, name, "no scene; all nodes belong to it");
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i])
            roots.push_back(static_cast<int>(i));
    return roots;
}

} // namespace

Affine rotation_of(double x, double y, double z, double w)
{
    const double size = x * x + y * y + z * z + w * w;
    if (!(size > 0))
        return {};
    const double s = 2 / size;
    return {{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
            {s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)},
            {s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)},
            {}};
}

GltfDocument read_gltf(const std::filesystem::path& file, Report& report)
{
    GltfDocument document;
    document.name = file.filename().string();
    document.file = file;
    document.files.push_back(std::make_unique<MappedFile>(file));
    const GltfContainer container = open_container(document.files[0]->bytes(), document.name);
    const GltfJson json = prepare_json(container.json, document.name, report);
    const tinygltf::Model model = parse(json, document.name);
    document.generator = json.generator;
    document.animations = json.animations;
    document.required = model.extensionsRequired;
    take_views(model, json, container.binary, file.parent_path(), document);
    for (const tinygltf::Accessor& accessor : model.accessors)
        document.accessors.push_back(accessor_of(accessor));
    for (const tinygltf::Mesh& mesh : model.meshes)
        document.meshes.push_back(mesh_of(mesh));
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        document.nodes.push_back(node_of(model.nodes[i], document.name + ": node " + std::to_string(i)));
    read_parts(json.parts, document);
    for (const tinygltf::Camera& camera : model.cameras)
        document.cameras.push_back(camera_of(camera));
    document.roots = roots_of(model, document.name, report);
    return document;
}

} // namespace lightwell
