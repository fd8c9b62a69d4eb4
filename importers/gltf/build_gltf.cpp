#include "importers/gltf/build_gltf.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_accessor.h"
#include "importers/gltf/gltf_buffers.h"
#include "importers/gltf/gltf_primitive.h"
#include "importers/gltf/gltf_views.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace lightwell {
namespace {

/// A map that flattens space below this share of its own size cannot be turned back, as an instance must be.
constexpr double singular_tolerance = 1e-12;

/// A file may read each of its bytes so often, by primitives that share accessors, before it counts as a trap.
constexpr std::size_t most_readings = 100;
/// Small files may share more.
constexpr std::size_t free_readings = 10'000'000;

/// One place where a mesh stands.
struct Use {
    int node;
    Affine to_world;
    std::string path; ///< stable name: node path, and #copy for instancing
};

/// A mesh as read, before it is known how often it is used.
struct Loaded {
    const GltfPrimitive* primitive;
    std::shared_ptr<const Mesh> mesh;
    std::size_t number; ///< of the primitive in its mesh
};

class GltfBuilder {
public:
    GltfBuilder(const GltfDocument& document, const Affine& to_metres, Imported& imported)
        : document_(document), to_metres_(to_metres), imported_(imported), keys_(imported)
    {
    }
    void build();

private:
    void walk();
    void visit_node(int node, const Affine& to_world);
    void visit_mesh(int node, const Affine& to_world);
    std::vector<Affine> copies_of(const GltfNode& node);
    void build_mesh(int mesh, const std::vector<Use>& uses);
    std::vector<Loaded> load(int mesh, const Use& first);
    void count_reading(int accessor);
    void place_once(const std::vector<Loaded>& parts, int mesh, const Use& use);
    void place_copies(const std::vector<Loaded>& parts, int mesh, const std::vector<Use>& uses);
    SurfaceKey key_of(const GltfPrimitive& primitive, int mesh, int node) const;
    std::string material_name(int material) const;
    void write_notes();

    const GltfDocument& document_;
    const Affine to_metres_;
    Imported& imported_;
    KeyTable keys_;
    std::vector<int> parents_;
    std::vector<std::string> paths_;
    std::map<int, std::vector<Use>> uses_; ///< by mesh
    std::string first_fault_;
    std::size_t bytes_ = 0, readings_ = 0;
    std::size_t without_area_ = 0, skinned_ = 0, morphed_ = 0;
};

std::string name_or_number(const std::string& name, const char* kind, std::size_t number)
{
    if (!name.empty())
        return name;
    std::string made = kind;
    return made.append(std::to_string(number));
}

int position_of(const GltfPrimitive& primitive)
{
    const auto found = primitive.attributes.find("POSITION");
    return found == primitive.attributes.end() ? -1 : found->second;
}

/// Twice the same parent, or a circle, would be walked for ever or exponentially often.
std::vector<int> parents_of(const GltfDocument& document)
{
    std::vector<int> parents(document.nodes.size(), -1);
    for (std::size_t i = 0; i < document.nodes.size(); ++i)
        for (const int child : document.nodes[i].children) {
            const std::string place = document.name + ": node " + std::to_string(i);
            if (child < 0 || static_cast<std::size_t>(child) >= parents.size())
                throw InputError(place, "has child " + std::to_string(child) + " of " + std::to_string(parents.size()) +
                                            " nodes");
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0 || static_cast<std::size_t>(child) == i)
                throw InputError(place, "node " + std::to_string(child) + " has two parents or is its own",
                                 "nodes must form trees");
            parent = static_cast<int>(i);
        }
    return parents;
}

void GltfBuilder::walk()
{
    struct Step {
        int node;
        Affine to_parent;
    };
    std::vector<Step> open;
    std::vector<bool> seen(document_.nodes.size());
    for (auto root = document_.roots.rbegin(); root != document_.roots.rend(); ++root) {
        if (*root < 0 || static_cast<std::size_t>(*root) >= seen.size())
            throw InputError(document_.name,
                             "scene refers to node " + std::to_string(*root) + " of " + std::to_string(seen.size()));
        if (parents_[static_cast<std::size_t>(*root)] >= 0)
            throw InputError(document_.name,
                             "node " + std::to_string(*root) + " is a root of the scene and has a parent",
                             "nodes must form trees");
        open.push_back({*root, to_metres_});
    }
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        const auto index = static_cast<std::size_t>(step.node);
        if (seen[index])
            throw InputError(document_.name, "node " + std::to_string(step.node) + " stands in the scene twice",
                             "nodes must form trees");
        seen[index] = true;
        const GltfNode& node = document_.nodes[index];
        const int parent = parents_[index];
        paths_[index] = parent < 0 ? "" : paths_[static_cast<std::size_t>(parent)] + "/";
        paths_[index] += name_or_number(node.name, "node", index);
        const Affine to_world = compose(step.to_parent, node.to_parent);
        visit_node(step.node, to_world);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, to_world});
    }
}

void GltfBuilder::visit_node(int index, const Affine& to_world)
{
    const GltfNode& node = document_.nodes[static_cast<std::size_t>(index)];
    const std::string& path = paths_[static_cast<std::size_t>(index)];
    const std::string place = document_.name + ": node \"" + path + '"';
    if (node.mesh >= 0)
        visit_mesh(index, to_world);
    if (node.light >= 0)
        imported_.ledger.skipped("light", node.name.empty() ? path : node.name,
                                 "light sources of the file are not modelled yet");
    if (node.camera < 0)
        return;
    if (static_cast<std::size_t>(node.camera) >= document_.cameras.size())
        imported_.report.add(Finding::ignored, place, "refers to a camera that is not there");
    else
        add_view(document_.cameras[static_cast<std::size_t>(node.camera)], node.name, to_world, place, imported_);
}

void GltfBuilder::visit_mesh(int index, const Affine& to_world)
{
    const GltfNode& node = document_.nodes[static_cast<std::size_t>(index)];
    const std::string& path = paths_[static_cast<std::size_t>(index)];
    if (static_cast<std::size_t>(node.mesh) >= document_.meshes.size())
        throw InputError(document_.name + ": node \"" + path + '"', "refers to mesh " + std::to_string(node.mesh) +
                                                                        " of " +
                                                                        std::to_string(document_.meshes.size()));
    skinned_ += node.skinned ? 1 : 0;
    const std::vector<Affine> copies = copies_of(node);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        std::string name = path;
        if (copies.size() > 1)
            name.append("#").append(std::to_string(i));
        uses_[node.mesh].push_back({index, compose(to_world, copies[i]), std::move(name)});
    }
}

/// Source  EXT_mesh_gpu_instancing: TRANSLATION, ROTATION (quaternion) and SCALE of each copy
std::vector<Affine> GltfBuilder::copies_of(const GltfNode& node)
{
    if (node.instancing.empty())
        return {Affine{}};
    std::vector<double> values[3];
    const std::pair<const char*, int> names[] = {{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = node.instancing.find(names[i].first);
        if (found == node.instancing.end())
            continue;
        count_reading(found->second);
        values[i] = read_numbers(document_, found->second, names[i].second);
        const std::size_t copies = values[i].size() / static_cast<std::size_t>(names[i].second);
        if (count > 0 && copies != count)
            throw InputError(document_.name + ": node \"" + node.name + '"', "lists of its copies differ in length");
        count = copies;
    }
    std::vector<Affine> copies(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (const auto& r = values[1]; !r.empty())
            copies[i] = rotation_of(r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]);
        if (const auto& s = values[2]; !s.empty())
            copies[i] = compose(copies[i], Affine::scale(Vec3{s[3 * i], s[3 * i + 1], s[3 * i + 2]}));
        if (const auto& t = values[0]; !t.empty())
            copies[i].translation = {t[3 * i], t[3 * i + 1], t[3 * i + 2]};
    }
    return copies;
}

std::string GltfBuilder::material_name(int material) const
{
    if (material < 0 || static_cast<std::size_t>(material) >= document_.materials.size())
        return {};
    return name_or_number(document_.materials[static_cast<std::size_t>(material)].name, "material",
                          static_cast<std::size_t>(material));
}

SurfaceKey GltfBuilder::key_of(const GltfPrimitive& primitive, int mesh, int node) const
{
    SurfaceKey key;
    key.entity = "mesh";
    key.block = document_.meshes[static_cast<std::size_t>(mesh)].name;
    key.material = material_name(primitive.material);
    if (!key.material.empty())
        key.colour = document_.materials[static_cast<std::size_t>(primitive.material)].base_colour;
    std::string nearest_name;
    for (int at = node; at >= 0; at = parents_[static_cast<std::size_t>(at)]) {
        const GltfNode& here = document_.nodes[static_cast<std::size_t>(at)];
        if (key.layer.empty())
            key.layer = here.layer;
        if (nearest_name.empty())
            nearest_name = here.name;
    }
    if (node >= 0)
        key.group = paths_[static_cast<std::size_t>(node)];
    for (const std::string& fallback : {nearest_name, key.block, key.material, std::string("default")})
        if (key.layer.empty())
            key.layer = fallback;
    return key;
}

/// Thousands of primitives or copies that share one large accessor would take for ever and all memory.
void GltfBuilder::count_reading(int accessor)
{
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= document_.accessors.size())
        return;
    readings_ += std::min(document_.accessors[static_cast<std::size_t>(accessor)].count, free_readings + bytes_);
    if (readings_ > free_readings + most_readings * bytes_)
        throw InputError(document_.name,
                         "its parts repeat the same accessors until " + std::to_string(readings_) +
                             " elements are read from " + std::to_string(bytes_) + " bytes",
                         "let nodes share the mesh instead");
}

std::vector<Loaded> GltfBuilder::load(int index, const Use& first)
{
    static constexpr const char* kinds[] = {"point", "line", "line", "line"};
    const GltfMesh& mesh = document_.meshes[static_cast<std::size_t>(index)];
    std::vector<Loaded> parts;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const GltfPrimitive& primitive = mesh.primitives[i];
        const std::string layer = key_of(primitive, index, first.node).layer;
        morphed_ += primitive.morphed ? 1 : 0;
        if (primitive.mode >= 0 && primitive.mode < 4) {
            const char* kind = kinds[primitive.mode];
            imported_.ledger.skipped(kind, layer, std::string("a ") + kind + " has no area");
            continue;
        }
        count_reading(position_of(primitive));
        count_reading(primitive.indices);
        try {
            if (primitive.mode < 0 || primitive.mode > 6)
                throw InputError(document_.name,
                                 "primitive mode " + std::to_string(primitive.mode) + ", expected 0 to 6");
            GltfTriangles read = read_triangles(document_, primitive);
            without_area_ += read.without_area;
            if (read.mesh.triangles.empty())
                imported_.ledger.skipped("mesh", layer, "zero area");
            else
                parts.push_back({&primitive, std::make_shared<const Mesh>(std::move(read.mesh)), i});
        } catch (const InputError& error) {
            if (first_fault_.empty() && std::string_view(error.what()).find(buffer_left_open) == std::string_view::npos)
                first_fault_ = error.what();
            imported_.ledger.skipped("mesh", layer, "damaged");
            imported_.report.add(Finding::ignored, document_.name + ": mesh \"" + mesh.name + '"',
                                 std::string("primitive left out: ") + error.what());
        }
    }
    return parts;
}

/// A mirrored map turns the corners round, so that the front stays the front.
Mesh transformed(const Mesh& from, const Affine& map)
{
    Mesh mesh = from;
    for (Point& point : mesh.points)
        point = map.point(point);
    const double determinant = map.determinant();
    const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
    const bool singular = !(std::fabs(determinant) > singular_tolerance * size * size * size);
    if (singular)
        mesh.normals.clear();
    for (Direction& normal : mesh.normals)
        normal = transform_normal(map, normal);
    if (determinant < 0)
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
            std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
    return mesh;
}

bool all_finite(const Mesh& mesh)
{
    for (const Point& point : mesh.points)
        if (!is_finite(point))
            return false;
    return true;
}

std::string part_name(const std::string& path, const Loaded& part, std::size_t parts)
{
    std::string name = path;
    if (parts > 1)
        name.append("/").append(std::to_string(part.number));
    return name;
}

void GltfBuilder::place_once(const std::vector<Loaded>& parts, int mesh, const Use& use)
{
    const std::size_t count = document_.meshes[static_cast<std::size_t>(mesh)].primitives.size();
    for (const Loaded& part : parts) {
        const SurfaceKey key = key_of(*part.primitive, mesh, use.node);
        auto placed = std::make_shared<const Mesh>(transformed(*part.mesh, use.to_world));
        if (!all_finite(*placed)) {
            imported_.ledger.unmake("mesh", key.layer, "placed beyond the range of numbers");
            continue;
        }
        imported_.scene.root.add_mesh(std::move(placed), keys_.modifier_for(key), part_name(use.path, part, count));
    }
}

void GltfBuilder::place_copies(const std::vector<Loaded>& parts, int mesh, const std::vector<Use>& uses)
{
    const GltfMesh& from = document_.meshes[static_cast<std::size_t>(mesh)];
    Part prototype;
    prototype.name = name_or_number(from.name, "mesh", static_cast<std::size_t>(mesh));
    std::vector<ModifierId> inherited;
    for (const Loaded& part : parts) {
        inherited.push_back(keys_.inherited(key_of(*part.primitive, mesh, -1)));
        prototype.add_mesh(part.mesh, inherited.back(), part_name(prototype.name, part, from.primitives.size()));
    }
    const auto number = static_cast<std::uint32_t>(imported_.scene.prototypes.size());
    imported_.scene.prototypes.push_back(std::move(prototype));
    for (const Use& use : uses) {
        Instance instance{number, use.to_world, {}};
        std::set<ModifierId> bound;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (bound.insert(inherited[i]).second)
                instance.bindings.push_back(
                    {inherited[i], keys_.modifier_for(key_of(*parts[i].primitive, mesh, use.node))});
        imported_.scene.root.add_instance(std::move(instance), use.path);
    }
}

bool invertible(const Affine& map)
{
    const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
    return is_finite(map.translation) && std::fabs(map.determinant()) > singular_tolerance * size * size * size;
}

void GltfBuilder::build_mesh(int mesh, const std::vector<Use>& uses)
{
    const std::vector<Loaded> parts = load(mesh, uses.front());
    if (parts.empty())
        return;
    for (const Loaded& part : parts)
        imported_.ledger.made("mesh", key_of(*part.primitive, mesh, uses.front().node).layer);
    std::vector<Use> copies;
    for (const Use& use : uses)
        if (invertible(use.to_world))
            copies.push_back(use);
    const bool several = copies.size() > 1;
    if (several)
        place_copies(parts, mesh, copies);
    for (const Use& use : uses)
        if (!several || !invertible(use.to_world))
            place_once(parts, mesh, use);
}

void GltfBuilder::build()
{
    parents_ = parents_of(document_);
    paths_.resize(document_.nodes.size());
    for (const GltfView& view : document_.views)
        bytes_ += view.bytes.size();
    walk();
    for (const auto& [mesh, uses] : uses_)
        build_mesh(mesh, uses);
    if (!first_fault_.empty() && imported_.ledger.made_count() == 0)
        throw InputError(document_.name, "no primitive can be used; the first: " + first_fault_);
    write_notes();
}

void GltfBuilder::write_notes()
{
    const auto note = [&](std::size_t count, Finding finding, const char* text) {
        if (count > 0)
            imported_.report.add(finding, document_.name, text, count);
    };
    note(without_area_, Finding::ignored, "triangle without area");
    note(skinned_, Finding::unsupported, "skin: the mesh is kept as modelled, where its node stands");
    note(morphed_, Finding::unsupported, "morph targets: the primitive is kept at rest");
    note(document_.animations, Finding::ignored, "animation: the scene is kept as it stands");
    std::size_t unused = 0;
    for (std::size_t i = 0; i < document_.meshes.size(); ++i)
        unused += uses_.count(static_cast<int>(i)) == 0 ? 1 : 0;
    note(unused, Finding::ignored, "mesh that no node of the scene shows");
}

} // namespace

void build_gltf(const GltfDocument& document, const Affine& to_metres, Imported& imported)
{
    GltfBuilder(document, to_metres, imported).build();
}

} // namespace lightwell
