#include "importers/gltf/build_gltf.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_accessor.h"
#include "importers/gltf/gltf_buffers.h"
#include "importers/gltf/gltf_lights.h"
#include "importers/gltf/gltf_placement.h"
#include "importers/gltf/gltf_primitive.h"
#include "importers/gltf/gltf_tree.h"
#include "importers/gltf/gltf_views.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace lightwell {
namespace {

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
    std::shared_ptr<Mesh> mesh;
    std::size_t number; ///< of the primitive in its mesh
};

class GltfBuilder {
public:
    GltfBuilder(const GltfDocument& document, const Affine& to_metres, Imported& imported)
        : document_(document), tree_(document, to_metres), imported_(imported), keys_(imported)
    {
    }
    /// @return as build_gltf()
    std::set<int> build();

private:
    void visit_node(int node, const Affine& to_world);
    void visit_mesh(int node, const Affine& to_world);
    void visit_light(int node, const Affine& to_world);
    std::vector<Affine> copies_of(const GltfNode& node);
    void build_mesh(int mesh, const std::vector<Use>& uses);
    std::vector<Loaded> load(int mesh, const Use& first, const GltfPose& pose, bool counts);
    void load_primitive(int mesh, std::size_t number, const GltfPose& pose, const std::string& layer, bool counts,
                        std::vector<Loaded>& parts);
    void count_elements(std::size_t count);
    void count_reading(int accessor);
    void count_readings(const GltfPrimitive& primitive, const GltfPose& pose);
    GltfPose pose_of(int mesh, int node);
    std::vector<Affine> joints_of(const GltfSkin& skin);
    void build_plain(int mesh, const std::vector<Use>& uses, bool counts);
    void build_posed(int mesh, const Use& use, const GltfPose& pose, bool counts);
    void place_once(const std::vector<Loaded>& parts, int mesh, const Use& use, bool only);
    void unmake_unshown();
    void place_copies(const std::vector<Loaded>& parts, int mesh, const std::vector<Use>& uses);
    SurfaceKey key_of(const GltfPrimitive& primitive, int mesh, int node) const;
    std::string material_name(int material) const;
    void write_notes();

    const GltfDocument& document_;
    const GltfTree tree_;
    Imported& imported_;
    KeyTable keys_;
    std::set<std::string> light_materials_;
    std::set<int> open_shells_;
    std::vector<std::string> made_on_;     ///< by primitive of the mesh at hand: its layer in the ledger
    std::vector<bool> shown_;              ///< by primitive of the mesh at hand: in the scene
    std::map<int, std::vector<Use>> uses_; ///< by mesh
    std::string first_fault_;
    std::size_t bytes_ = 0, readings_ = 0;
    std::size_t without_area_ = 0, skinned_ = 0, unskinned_ = 0, morphed_ = 0;
};

/// True for a material that is a transparent body when its mesh encloses one.
bool wants_inside(const GltfDocument& document, int material)
{
    return material >= 0 && static_cast<std::size_t>(material) < document.materials.size() &&
           document.materials[static_cast<std::size_t>(material)].thickness > 0;
}

int position_of(const GltfPrimitive& primitive)
{
    const auto found = primitive.attributes.find("POSITION");
    return found == primitive.attributes.end() ? -1 : found->second;
}

void GltfBuilder::visit_node(int index, const Affine& to_world)
{
    const GltfNode& node = document_.nodes[static_cast<std::size_t>(index)];
    const std::string path = tree_.path_of(index);
    const std::string place = document_.name + ": node \"" + path + '"';
    if (node.mesh >= 0)
        visit_mesh(index, to_world);
    if (node.light >= 0)
        visit_light(index, to_world);
    if (node.camera < 0)
        return;
    if (static_cast<std::size_t>(node.camera) >= document_.cameras.size())
        imported_.report.add(Finding::ignored, place, "refers to a camera that is not there");
    else
        add_view(document_.cameras[static_cast<std::size_t>(node.camera)], node.name, to_world, place, imported_);
}

void GltfBuilder::visit_light(int index, const Affine& to_world)
{
    const int light = document_.nodes[static_cast<std::size_t>(index)].light;
    SurfaceKey key;
    key.entity = "light";
    key.group = tree_.path_of(index);
    key.layer = tree_.layer_of(index);
    if (key.layer.empty())
        key.layer = key.group;
    const std::string layer = key.layer;
    const std::string fault =
        static_cast<std::size_t>(light) >= document_.lights.size()
            ? "refers to a light that is not there"
            : add_light(document_, light, std::move(key), to_world, light_materials_, keys_, imported_);
    if (fault.empty())
        imported_.ledger.made("light", layer);
    else
        imported_.ledger.skipped("light", layer, fault);
}

void GltfBuilder::visit_mesh(int index, const Affine& to_world)
{
    const GltfNode& node = document_.nodes[static_cast<std::size_t>(index)];
    const std::string path = tree_.path_of(index);
    if (static_cast<std::size_t>(node.mesh) >= document_.meshes.size())
        throw InputError(document_.name + ": node \"" + path + '"', "refers to mesh " + std::to_string(node.mesh) +
                                                                        " of " +
                                                                        std::to_string(document_.meshes.size()));
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
    if (node >= 0) {
        key.layer = tree_.layer_of(node);
        key.group = tree_.path_of(node);
    }
    for (const std::string& fallback : {key.block, key.material, std::string("default")})
        if (key.layer.empty())
            key.layer = fallback;
    return key;
}

/// Thousands of primitives or copies that share one large accessor would take for ever and all memory.
void GltfBuilder::count_reading(int accessor)
{
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= document_.accessors.size())
        return;
    count_elements(document_.accessors[static_cast<std::size_t>(accessor)].count);
}

void GltfBuilder::count_elements(std::size_t count)
{
    readings_ += std::min(count, free_readings + bytes_);
    if (readings_ > free_readings + most_readings * bytes_)
        throw InputError(document_.name,
                         "its parts repeat the same accessors until " + std::to_string(readings_) +
                             " elements are read from " + std::to_string(bytes_) + " bytes",
                         "let nodes share the mesh instead");
}

void GltfBuilder::count_readings(const GltfPrimitive& primitive, const GltfPose& pose)
{
    count_reading(position_of(primitive));
    count_reading(primitive.indices);
    for (std::size_t k = 0; k < std::min(pose.weights.size(), primitive.targets.size()); ++k)
        for (const auto& [name, accessor] : primitive.targets[k])
            count_reading(accessor);
}

/// The weights of the node's morph targets and the places of its bones.
/// Source  glTF 2.0 specification, 3.7.3.3: the place of the node itself does not count for a skinned mesh
GltfPose GltfBuilder::pose_of(int mesh, int index)
{
    const GltfNode& node = document_.nodes[static_cast<std::size_t>(index)];
    const GltfMesh& shape = document_.meshes[static_cast<std::size_t>(mesh)];
    GltfPose pose;
    const std::vector<double>& weights = node.weights.empty() ? shape.weights : node.weights;
    const bool morphed = std::any_of(shape.primitives.begin(), shape.primitives.end(),
                                     [](const GltfPrimitive& primitive) { return !primitive.targets.empty(); });
    if (morphed && std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; }))
        pose.weights = weights;
    if (node.skin < 0 || static_cast<std::size_t>(node.skin) >= document_.skins.size())
        return pose;
    const GltfSkin& skin = document_.skins[static_cast<std::size_t>(node.skin)];
    pose.joints = joints_of(skin);
    ++(pose.joints.empty() ? unskinned_ : skinned_);
    return pose;
}

/// Mesh -> metres by each bone; empty when a bone or its matrix cannot be used.
std::vector<Affine> GltfBuilder::joints_of(const GltfSkin& skin)
{
    std::vector<Affine> joints;
    std::vector<double> inverse_bind;
    count_elements(skin.joints.size());
    if (skin.inverse_bind >= 0) {
        count_reading(skin.inverse_bind);
        try {
            inverse_bind = read_numbers(document_, skin.inverse_bind, 16);
        } catch (const InputError& error) {
            imported_.report.add(Finding::ignored, document_.name, std::string("skin left out: ") + error.what());
            return {};
        }
    }
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const int joint = skin.joints[i];
        if (joint < 0 || static_cast<std::size_t>(joint) >= document_.nodes.size() || !tree_.world(joint) ||
            (!inverse_bind.empty() && inverse_bind.size() < 16 * (i + 1)))
            return {};
        const double* m = inverse_bind.empty() ? nullptr : &inverse_bind[16 * i];
        const Affine bind =
            m ? Affine{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}} : Affine{};
        joints.push_back(compose(*tree_.world(joint), bind));
    }
    return joints;
}

/// @param counts  the ledger, in which each primitive of a mesh counts once however often it is read
std::vector<Loaded> GltfBuilder::load(int index, const Use& first, const GltfPose& pose, bool counts)
{
    static constexpr const char* kinds[] = {"point", "line", "line", "line"};
    const GltfMesh& mesh = document_.meshes[static_cast<std::size_t>(index)];
    std::vector<Loaded> parts;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const GltfPrimitive& primitive = mesh.primitives[i];
        const std::string layer = key_of(primitive, index, first.node).layer;
        if (primitive.mode < 0 || primitive.mode > 3) {
            load_primitive(index, i, pose, layer, counts, parts);
        } else if (counts) {
            const char* kind = kinds[primitive.mode];
            imported_.ledger.skipped(kind, layer, std::string("a ") + kind + " has no area");
        }
    }
    return parts;
}

void GltfBuilder::load_primitive(int index, std::size_t number, const GltfPose& pose, const std::string& layer,
                                 bool counts, std::vector<Loaded>& parts)
{
    const GltfMesh& mesh = document_.meshes[static_cast<std::size_t>(index)];
    const GltfPrimitive& primitive = mesh.primitives[number];
    count_readings(primitive, pose);
    try {
        if (primitive.mode < 0 || primitive.mode > 6)
            throw InputError(document_.name, "primitive mode " + std::to_string(primitive.mode) + ", expected 0 to 6");
        GltfTriangles read = read_triangles(document_, primitive, pose);
        without_area_ += counts ? read.without_area : 0;
        morphed_ += counts && !primitive.targets.empty() ? 1 : 0;
        if (!read.mesh.triangles.empty()) {
            if (wants_inside(document_, primitive.material) && !is_closed(read.mesh))
                open_shells_.insert(primitive.material);
            if (counts) {
                imported_.ledger.made("mesh", layer);
                if (read.without_area > 0)
                    imported_.ledger.repaired("mesh", layer, "triangles without area left out");
                made_on_[number] = layer;
            }
            parts.push_back({&primitive, std::make_shared<Mesh>(std::move(read.mesh)), number});
        } else if (counts) {
            imported_.ledger.skipped("mesh", layer, "zero area");
        }
    } catch (const InputError& error) {
        if (first_fault_.empty() && std::string_view(error.what()).find(buffer_left_open) == std::string_view::npos)
            first_fault_ = error.what();
        if (counts)
            imported_.ledger.skipped("mesh", layer, "damaged");
        imported_.report.add(Finding::ignored, document_.name + ": mesh \"" + mesh.name + '"',
                             std::string("primitive left out: ") + error.what());
    }
}

std::string part_name(const std::string& path, const Loaded& part, std::size_t parts)
{
    std::string name = path;
    if (parts > 1)
        name.append("/").append(std::to_string(part.number));
    return name;
}

/// @param only  no other use of the parts follows: they may be changed
void GltfBuilder::place_once(const std::vector<Loaded>& parts, int mesh, const Use& use, bool only)
{
    const std::size_t count = document_.meshes[static_cast<std::size_t>(mesh)].primitives.size();
    for (const Loaded& part : parts) {
        const std::shared_ptr<Mesh> placed = only ? part.mesh : std::make_shared<Mesh>(*part.mesh);
        transform(*placed, use.to_world);
        if (!all_finite(*placed))
            continue;
        const SurfaceKey key = key_of(*part.primitive, mesh, use.node);
        imported_.scene.root.add_mesh(placed, keys_.modifier_for(key), part_name(use.path, part, count));
        shown_[part.number] = true;
    }
}

/// What was read but could be placed nowhere goes to the other side of the ledger.
void GltfBuilder::unmake_unshown()
{
    for (std::size_t i = 0; i < made_on_.size(); ++i)
        if (!made_on_[i].empty() && !shown_[i])
            imported_.ledger.unmake("mesh", made_on_[i], "placed beyond the range of numbers");
}

void GltfBuilder::place_copies(const std::vector<Loaded>& parts, int mesh, const std::vector<Use>& uses)
{
    const GltfMesh& from = document_.meshes[static_cast<std::size_t>(mesh)];
    Part prototype;
    prototype.name = name_or_number(from.name, "mesh", static_cast<std::size_t>(mesh));
    std::vector<ModifierId> inherited;
    for (const Loaded& part : parts) {
        inherited.push_back(keys_.inherited(key_of(*part.primitive, mesh, -1)));
        shown_[part.number] = true;
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

/// A mesh that bones or weights of its own node bend is read for that node alone.
void GltfBuilder::build_posed(int mesh, const Use& use, const GltfPose& pose, bool counts)
{
    const std::vector<Loaded> parts = load(mesh, use, pose, counts);
    const bool in_metres = !pose.joints.empty();
    place_once(parts, mesh, {use.node, in_metres ? Affine{} : use.to_world, use.path}, true);
}

void GltfBuilder::build_mesh(int mesh, const std::vector<Use>& uses)
{
    made_on_.assign(document_.meshes[static_cast<std::size_t>(mesh)].primitives.size(), {});
    shown_.assign(made_on_.size(), false);
    bool counts = true;
    std::vector<Use> plain;
    for (const Use& use : uses) {
        const GltfPose pose = pose_of(mesh, use.node);
        if (pose.bends())
            build_posed(mesh, use, pose, std::exchange(counts, false));
        else
            plain.push_back(use);
    }
    if (!plain.empty())
        build_plain(mesh, plain, counts);
    unmake_unshown();
}

/// Shown at one place, a mesh goes into the scene; at several, it is a prototype. A map that flattens cannot be an
/// instance's.
void GltfBuilder::build_plain(int mesh, const std::vector<Use>& uses, bool counts)
{
    const std::vector<Loaded> parts = load(mesh, uses.front(), {}, counts);
    if (parts.empty())
        return;
    std::vector<Use> copies;
    for (const Use& use : uses)
        if (invertible(use.to_world))
            copies.push_back(use);
    const bool several = copies.size() > 1;
    if (several)
        place_copies(parts, mesh, copies);
    for (const Use& use : uses)
        if (!several || !invertible(use.to_world))
            place_once(parts, mesh, use, uses.size() == 1);
}

std::set<int> GltfBuilder::build()
{
    for (const GltfView& view : document_.views)
        bytes_ += view.bytes.size();
    for (const int node : tree_.order())
        visit_node(node, *tree_.world(node));
    for (const auto& [mesh, uses] : uses_)
        build_mesh(mesh, uses);
    if (!first_fault_.empty() && imported_.ledger.made_count() == 0)
        throw InputError(document_.name, "no primitive can be used; the first: " + first_fault_);
    write_notes();
    return std::move(open_shells_);
}

void GltfBuilder::write_notes()
{
    const auto note = [&](std::size_t count, Finding finding, const char* text) {
        if (count > 0)
            imported_.report.add(finding, document_.name, text, count);
    };
    note(without_area_, Finding::ignored, "triangle without area");
    note(skinned_, Finding::approximated, "skin: the mesh stands as its bones do at rest");
    note(unskinned_, Finding::unsupported, "skin without usable bones: the mesh is kept as modelled");
    note(morphed_, Finding::approximated, "morph targets: the primitive is shaped by the weights at rest");
    note(document_.animations, Finding::ignored, "animation: the scene is kept as it stands");
    std::size_t unused = 0;
    for (std::size_t i = 0; i < document_.meshes.size(); ++i)
        unused += uses_.count(static_cast<int>(i)) == 0 ? 1 : 0;
    note(unused, Finding::ignored, "mesh that no node of the scene shows");
}

} // namespace

std::set<int> build_gltf(const GltfDocument& document, const Affine& to_metres, Imported& imported)
{
    return GltfBuilder(document, to_metres, imported).build();
}

} // namespace lightwell
