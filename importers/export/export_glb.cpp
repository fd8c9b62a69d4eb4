#include "importers/export/export.h"
#include "importers/export/faces.h"
#include "importers/export/glb_buffer.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/geometry/triangulate.h"
#include "engine/scene/expansion.h"
#include "importers/layer_rules.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <set>

namespace lightwell {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_nodes = 2'000'000;

/// What a part shows with one modifier, as triangles about their middle.
struct Primitive {
    std::size_t positions, indices;
    std::optional<std::size_t> normals;
};
struct Shown {
    Point middle;
    std::vector<Primitive> primitives; ///< flat faces, and smooth ones
};

/// What a node and its mesh say of a modifier.
using Look = std::tuple<std::string, std::string, std::string>;

Json matrix_of(const Affine& map)
{
    Json numbers = Json::array();
    for (const Vec3& column : {map.x, map.y, map.z, map.translation}) {
        for (int axis = 0; axis < 3; ++axis)
            numbers.push_back(column[axis]);
        numbers.push_back(numbers.size() == 15 ? 1 : 0);
    }
    return numbers;
}

class GlbWriter {
public:
    GlbWriter(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
        : model_(model), file_(file), options_(options), report_(report)
    {
    }
    std::string write();

private:
    using Shares = std::map<ModifierId, Shown>;
    void find_alike();
    std::string material_name(ModifierId modifier) const;
    Shares shares_of(const Part& part);
    void take_flat(const Part& part, const Surface& surface, const Point& middle, std::vector<Vec3>& points,
                   std::vector<std::uint32_t>& indices);
    void add_smooth(const Mesh& mesh, Shown& shown);
    Json children_of(std::size_t part_number, const Part& part, const std::vector<Binding>& bindings);
    std::size_t mesh_of(std::size_t part_number, ModifierId inside, ModifierId actual, const Shown& shown);
    std::size_t material_number(ModifierId modifier, const std::string& name);
    std::size_t add_node(Json node);
    Json document(std::size_t root) const;

    const Imported& model_;
    const std::filesystem::path& file_;
    const ExportOptions& options_;
    Report& report_;
    GlbBuffer buffer_;
    std::vector<Shares> shares_; ///< of prototypes, then of the root
    Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array();
    std::vector<ModifierId> alike_; ///< for each modifier the first one of the same layer, block and material
    std::map<std::tuple<std::size_t, ModifierId, std::string, std::string>, std::size_t> known_meshes_;
    std::map<std::string, std::size_t> known_materials_;
    std::set<std::string> extensions_;
};

void GlbWriter::take_flat(const Part& part, const Surface& surface, const Point& middle, std::vector<Vec3>& points,
                          std::vector<std::uint32_t>& indices)
{
    bool approximated = false;
    for (const Face& face : faces_of(part, surface, options_.chord_tolerance_m, approximated)) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (const Point& corner : face)
            points.push_back(corner - middle);
        for (const auto& triangle : triangulate(face.data(), face.size()))
            for (const std::uint32_t corner : triangle)
                indices.push_back(first + corner);
    }
    if (approximated)
        report_.add(Finding::approximated, surface.name, "round shapes are written as facets: glTF has none");
}

void GlbWriter::add_smooth(const Mesh& mesh, Shown& shown)
{
    std::vector<Vec3> points;
    for (const Point& point : mesh.points)
        points.push_back(point - shown.middle);
    shown.primitives.push_back(
        {buffer_.add_vectors(points), buffer_.add_indices(mesh.triangles), buffer_.add_vectors(mesh.normals)});
}

std::string GlbWriter::material_name(ModifierId modifier) const
{
    const std::string name = material_name_of(model_, modifier);
    const SurfaceKey& key = key_of(model_, modifier);
    return name.empty() && key.colour ? colour_text(key) : name;
}

void GlbWriter::find_alike()
{
    std::map<Look, ModifierId> first;
    for (std::size_t i = 0; i < model_.scene.modifiers.size(); ++i) {
        const auto id = static_cast<ModifierId>(i);
        const SurfaceKey& key = key_of(model_, id);
        const bool waits = std::holds_alternative<Inherited>(model_.scene.modifiers[i].what);
        alike_.push_back(waits ? id
                               : first.try_emplace(Look{key.layer, key.block, material_name(id)}, id).first->second);
    }
}

GlbWriter::Shares GlbWriter::shares_of(const Part& part)
{
    std::map<ModifierId, std::vector<const Surface*>> surfaces;
    std::map<ModifierId, Box> boxes;
    for (const Surface& surface : part.surfaces)
        if (surface.shape != Shape::instance && surface.shape != Shape::source) {
            const ModifierId id =
                surface.modifier == void_modifier ? void_modifier : alike_[static_cast<std::size_t>(surface.modifier)];
            surfaces[id].push_back(&surface);
            boxes[id].extend(surface_bounds(part, surface));
        }
    Shares shares;
    for (const auto& [modifier, list] : surfaces) {
        Shown& shown = shares[modifier];
        shown.middle = boxes[modifier].centre();
        std::vector<Vec3> points;
        std::vector<std::uint32_t> indices;
        for (const Surface* surface : list) {
            if (surface->shape == Shape::mesh && !part.meshes[surface->index]->normals.empty())
                add_smooth(*part.meshes[surface->index], shown);
            else
                take_flat(part, *surface, shown.middle, points, indices);
        }
        if (!indices.empty())
            shown.primitives.push_back({buffer_.add_vectors(points), buffer_.add_indices(indices), {}});
    }
    return shares;
}

std::size_t GlbWriter::add_node(Json node)
{
    if (nodes_.size() == most_nodes)
        throw InputError{file_.string(), "the model has more than two million nodes", "export DXF, which nests blocks"};
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
}

std::size_t GlbWriter::material_number(ModifierId modifier, const std::string& name)
{
    const auto [entry, fresh] = known_materials_.try_emplace(name, materials_.size());
    if (!fresh)
        return entry->second;
    const Spectrum colour = shown_colour(model_, modifier);
    Json look{{"baseColorFactor", {colour.r, colour.g, colour.b, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
    Json material{{"name", name}, {"doubleSided", true}};
    const auto extend = [&](const char* extension, Json value) {
        material["extensions"][extension] = std::move(value);
        extensions_.insert(extension);
    };
    if (const Material* known = material_of(model_, modifier)) {
        if (const auto* glass = std::get_if<Glass>(known)) {
            extend("KHR_materials_transmission", {{"transmissionFactor", 1}});
            extend("KHR_materials_ior", {{"ior", glass->index}});
            look["roughnessFactor"] = 0;
        }
        if (const auto* metal = std::get_if<Metal>(known)) {
            look["metallicFactor"] = 1;
            look["roughnessFactor"] = std::sqrt(metal->roughness);
        }
        const Spectrum radiance = to_rec709(emitted_radiance(*known));
        if (const double most = radiance.max(); most > 0) { // the format wants cd/m^2, the colour apart
            material["emissiveFactor"] = {std::fmax(0, radiance.r / most), std::fmax(0, radiance.g / most),
                                          std::fmax(0, radiance.b / most)};
            extend("KHR_materials_emissive_strength", {{"emissiveStrength", lumens_per_watt * most}});
        }
    }
    material["pbrMetallicRoughness"] = std::move(look);
    materials_.push_back(std::move(material));
    return entry->second;
}

std::size_t GlbWriter::mesh_of(std::size_t part_number, ModifierId inside, ModifierId actual, const Shown& shown)
{
    const SurfaceKey& key = key_of(model_, actual);
    const std::string material = material_name(actual), name = key.block.empty() ? key.layer : key.block;
    const auto [entry, fresh] = known_meshes_.try_emplace({part_number, inside, material, name}, meshes_.size());
    if (!fresh)
        return entry->second;
    Json primitives = Json::array();
    for (const Primitive& from : shown.primitives) {
        Json primitive{{"attributes", {{"POSITION", from.positions}}}, {"indices", from.indices}};
        if (from.normals)
            primitive["attributes"]["NORMAL"] = *from.normals;
        if (!material.empty())
            primitive["material"] = material_number(actual, material);
        primitives.push_back(std::move(primitive));
    }
    meshes_.push_back({{"name", name}, {"primitives", std::move(primitives)}});
    return entry->second;
}

/// Nodes for what a part holds: one for each modifier, one for each instance.
Json GlbWriter::children_of(std::size_t part_number, const Part& part, const std::vector<Binding>& bindings)
{
    Json children = Json::array();
    for (const auto& [inside, shown] : shares_[part_number]) {
        if (shown.primitives.empty())
            continue;
        const ModifierId actual = bound_modifier(model_.scene, inside, bindings);
        const SurfaceKey& key = key_of(model_, actual);
        children.push_back(add_node({{"name", key.layer},
                                     {"mesh", mesh_of(part_number, inside, actual, shown)},
                                     {"translation", {shown.middle.x, shown.middle.y, shown.middle.z}},
                                     {"extras", {{"layer", key.layer}}}}));
    }
    for (const Surface& surface : part.surfaces) {
        if (surface.shape != Shape::instance)
            continue;
        const Instance& instance = part.instances[surface.index];
        std::vector<Binding> inner = instance.bindings;
        for (Binding& binding : inner)
            binding.actual = bound_modifier(model_.scene, binding.actual, bindings);
        const Part& prototype = model_.scene.prototypes[instance.prototype];
        Json below = children_of(instance.prototype, prototype, inner);
        if (!below.empty())
            children.push_back(add_node(
                {{"name", prototype.name}, {"matrix", matrix_of(instance.to_parent)}, {"children", std::move(below)}}));
    }
    return children;
}

Json GlbWriter::document(std::size_t root) const
{
    Json json{{"asset", {{"version", "2.0"}, {"generator", "Lightwell"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {root}}}}},
              {"nodes", nodes_}};
    if (meshes_.empty())
        return json;
    json["meshes"] = meshes_;
    if (!materials_.empty())
        json["materials"] = materials_;
    if (!extensions_.empty())
        json["extensionsUsed"] = extensions_;
    json["buffers"] = {{{"byteLength", buffer_.size()}}};
    for (const GlbView& view : buffer_.views())
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.bytes}, {"target", view.target}});
    constexpr int single_precision = 5126, unsigned_integer = 5125;
    for (const GlbAccessor& accessor : buffer_.accessors()) {
        Json entry{{"bufferView", accessor.view},
                   {"componentType", accessor.indices ? unsigned_integer : single_precision},
                   {"count", accessor.count},
                   {"type", accessor.indices ? "SCALAR" : "VEC3"}};
        if (!accessor.indices) {
            entry["min"] = {accessor.low.x, accessor.low.y, accessor.low.z};
            entry["max"] = {accessor.high.x, accessor.high.y, accessor.high.z};
        }
        json["accessors"].push_back(std::move(entry));
    }
    return json;
}

std::string GlbWriter::write()
{
    find_alike();
    for (const Part& part : model_.scene.prototypes)
        shares_.push_back(shares_of(part));
    shares_.push_back(shares_of(model_.scene.root));
    Json children = children_of(shares_.size() - 1, model_.scene.root, {});
    // The format's y points up: (x, y, z) becomes (x, z, -y).
    const Affine y_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    Json top{{"name", "Lightwell"}, {"matrix", matrix_of(y_up)}};
    if (!children.empty())
        top["children"] = std::move(children);
    const std::size_t root = add_node(std::move(top));
    return buffer_.file(document(root).dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace

void export_glb(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
{
    write_text_atomically(file, GlbWriter{model, file, options, report}.write());
}

} // namespace lightwell
