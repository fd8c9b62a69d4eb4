#include "importers/assimp/build_foreign.h"

#include "engine/base/box.h"
#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/assimp/foreign_faces.h"
#include "importers/assimp/foreign_material.h"

#include <algorithm>
#include <map>
#include <set>

namespace lightwell {
namespace {

/// GlobalId at the end of the name of an IFC node.
constexpr std::size_t ifc_id_length = 22;
/// A map that flattens space below this share of its own size cannot be turned back, as an instance must be.
constexpr double singular_tolerance = 1e-12;
/// Copies of meshes beyond this number are a trap, not a building.
constexpr std::size_t most_copies = 5'000'000;

bool invertible(const Affine& map)
{
    const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
    return is_finite(map.translation) && std::fabs(map.determinant()) > singular_tolerance * size * size * size;
}

/// What the name of a node says: in IFC files `IfcWall_<name>_<GlobalId>`.
struct NodeName {
    std::string shown;      ///< empty for nodes that only group
    std::string ifc_type;   ///< "IfcWall"
    std::string product_id; ///< GlobalId
};

NodeName parsed(const ForeignNode& node, bool ifc)
{
    const std::string& name = node.name;
    NodeName result;
    if (name.empty() || name[0] == '$' || name == "<3DSRoot>" || name == "RootNode")
        return result;
    result.shown = name;
    const std::size_t bar = name.find('_');
    if (!ifc || name.size() < ifc_id_length + 2 || bar == std::string::npos || !name.starts_with("Ifc"))
        return result;
    result.ifc_type = name.substr(0, bar);
    result.product_id = name.substr(name.size() - ifc_id_length);
    const std::size_t words = name.size() - ifc_id_length - 1;
    result.shown = words > bar + 1 ? name.substr(bar + 1, words - bar - 1) : result.ifc_type;
    return result;
}

/// One place where a mesh stands.
struct Use {
    std::uint32_t node;
    std::string name; ///< of its surfaces; no two alike
};

class ForeignBuilder {
public:
    ForeignBuilder(const ForeignScene& scene, const ForeignFile& file, const Affine& to_metres, Imported& imported)
        : scene_(scene), file_(file), imported_(imported), keys_(imported), faces_(file.name, imported.report)
    {
        place_nodes(to_metres);
    }
    void build();

private:
    void place_nodes(const Affine& to_metres);
    void find_uses();
    void build_mesh(std::uint32_t mesh, const std::vector<Use>& uses);
    SurfaceKey key_of(std::uint32_t mesh, std::int64_t node) const;
    void add_cameras();
    void add_materials();
    void write_notes();

    const ForeignScene& scene_;
    const ForeignFile& file_;
    Imported& imported_;
    KeyTable keys_;
    ForeignFaces faces_;
    std::vector<NodeName> names_;
    std::vector<std::string> paths_;
    std::vector<Affine> to_world_;
    std::map<std::uint32_t, std::vector<Use>> uses_; ///< by mesh
    std::set<std::uint32_t> materials_used_;
};

void ForeignBuilder::place_nodes(const Affine& to_metres)
{
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        const ForeignNode& node = scene_.nodes[i];
        const auto parent = static_cast<std::size_t>(std::max(node.parent, 0));
        names_.push_back(parsed(node, file_.ifc != nullptr));
        // The root of most formats is made by the reader and called by whatever is at hand.
        if (i == 0 && file_.ifc == nullptr && node.meshes.empty())
            names_.back().shown.clear();
        std::string path = node.parent < 0 ? "" : paths_[parent];
        if (!names_.back().shown.empty())
            path.append(path.empty() ? "" : "/").append(names_.back().shown);
        paths_.push_back(std::move(path));
        to_world_.push_back(compose(node.parent < 0 ? to_metres : to_world_[parent], node.to_parent));
    }
}

void ForeignBuilder::find_uses()
{
    std::map<std::string, std::size_t> known;
    std::size_t copies = 0;
    for (std::uint32_t node = 0; node < scene_.nodes.size(); ++node)
        for (const std::uint32_t mesh : scene_.nodes[node].meshes) {
            if (++copies > most_copies)
                throw InputError(file_.name, "shows meshes more than " + std::to_string(most_copies) + " times");
            std::string name = paths_[node].empty() ? scene_.meshes[mesh].name : paths_[node];
            if (name.empty())
                name = "mesh";
            if (const std::size_t before = known[name]++; before > 0)
                name.append("#").append(std::to_string(before + 1));
            uses_[mesh].push_back({node, std::move(name)});
        }
}

/// @param node  -1: the mesh as a prototype
SurfaceKey ForeignBuilder::key_of(std::uint32_t index, std::int64_t node) const
{
    const ForeignMesh& mesh = scene_.meshes[index];
    const ForeignMaterial& material = scene_.materials[mesh.material];
    SurfaceKey key;
    key.entity = "mesh";
    key.block = mesh.name;
    key.material = material.name;
    if (material.diffuse_stated)
        key.colour = colour_of(material);
    std::string nearest, ifc_type;
    for (std::int64_t at = node; at >= 0; at = scene_.nodes[static_cast<std::size_t>(at)].parent) {
        const NodeName& name = names_[static_cast<std::size_t>(at)];
        if (nearest.empty())
            nearest = name.shown;
        if (!name.ifc_type.empty() && ifc_type.empty()) {
            ifc_type = name.ifc_type;
            if (const auto layer = file_.ifc->layer_of_product.find(name.product_id);
                layer != file_.ifc->layer_of_product.end())
                key.layer = layer->second;
        }
    }
    if (!ifc_type.empty()) {
        key.entity = ifc_type;
        nearest = ifc_type;
    }
    if (node >= 0)
        key.group = paths_[static_cast<std::size_t>(node)];
    for (const std::string& fallback : {nearest, key.block, key.material, std::string("default")})
        if (key.layer.empty())
            key.layer = fallback;
    return key;
}

void ForeignBuilder::build_mesh(std::uint32_t index, const std::vector<Use>& uses)
{
    const ForeignMesh& mesh = scene_.meshes[index];
    const std::string layer = key_of(index, uses.front().node).layer;
    const FaceCounts counts = count_faces(mesh);
    if (counts.lines > 0)
        imported_.ledger.skipped("line", layer, "a line has no area", counts.lines);
    if (counts.dots > 0)
        imported_.ledger.skipped("point", layer, "a point has no area", counts.dots);
    if (counts.faces == 0)
        return;
    std::vector<const Use*> copies, flattened;
    for (const Use& use : uses)
        (invertible(to_world_[use.node]) ? copies : flattened).push_back(&use);
    const std::size_t warped_before = faces_.warped();
    std::size_t made = 0;
    if (copies.size() > 1) {
        Part prototype;
        prototype.name = mesh.name.empty() ? uses.front().name : mesh.name;
        const ModifierId inherited = keys_.inherited(key_of(index, -1));
        made = faces_.add(mesh, Affine{}, inherited, prototype.name, prototype);
        const auto number = static_cast<std::uint32_t>(imported_.scene.prototypes.size());
        if (made > 0)
            imported_.scene.prototypes.push_back(std::move(prototype));
        for (const Use* use : made > 0 ? copies : std::vector<const Use*>{})
            imported_.scene.root.add_instance(
                {number, to_world_[use->node], {{inherited, keys_.modifier_for(key_of(index, use->node))}}}, use->name);
    } else {
        flattened.insert(flattened.end(), copies.begin(), copies.end());
    }
    for (const Use* use : flattened)
        made += faces_.add(mesh, to_world_[use->node], keys_.modifier_for(key_of(index, use->node)), use->name,
                           imported_.scene.root);
    if (made == 0) {
        imported_.ledger.skipped("mesh", layer, "zero area");
        return;
    }
    imported_.ledger.made("mesh", layer);
    if (faces_.warped() > warped_before)
        imported_.ledger.repaired("mesh", layer, "faces out of plane: cut into triangles");
    materials_used_.insert(mesh.material);
}

/// Source  Assimp: the camera's own vectors are in the frame of the node of its name
void ForeignBuilder::add_cameras()
{
    for (const ForeignCamera& camera : scene_.cameras) {
        const auto node = std::find_if(scene_.nodes.begin(), scene_.nodes.end(),
                                       [&](const ForeignNode& one) { return one.name == camera.name; });
        const std::string place = file_.name + ": camera \"" + camera.name + '"';
        if (node == scene_.nodes.end()) {
            imported_.report.add(Finding::ignored, place, "no node says where it stands");
            continue;
        }
        const Affine& map = to_world_[static_cast<std::size_t>(node - scene_.nodes.begin())];
        const auto vector = [](const std::array<float, 3>& v) { return Vec3{v[0], v[1], v[2]}; };
        View view;
        view.name = camera.name.empty() ? "camera" : camera.name;
        view.position = map.point(vector(camera.position));
        view.direction = normalized(map.vector(vector(camera.direction)));
        view.up = normalized(map.vector(vector(camera.up)));
        const double aspect = camera.aspect > 0 ? camera.aspect : 1.5;
        if (!(camera.aspect > 0))
            imported_.report.add(Finding::assumed, place, "camera without aspect ratio: 3:2");
        view.horizontal = camera.horizontal_rad / radians_per_degree;
        view.vertical = 2 * std::atan(std::tan(camera.horizontal_rad / 2) / aspect) / radians_per_degree;
        try {
            Camera check(view);
            imported_.scene.views.push_back(std::move(view));
        } catch (const InputError& error) {
            imported_.report.add(Finding::ignored, place, std::string("camera left out: ") + error.what());
        }
    }
}

void ForeignBuilder::add_materials()
{
    std::set<std::string> known;
    for (const std::uint32_t index : materials_used_) {
        const ForeignMaterial& material = scene_.materials[index];
        const std::string place = file_.name + ": material \"" + material.name + '"';
        // Without a name no rule and no key could find it; without a colour it says nothing.
        if (!material.name.empty() && material.diffuse_stated && known.insert(material.name).second)
            imported_.file_materials.emplace_back(material.name, material_of(material, place, imported_.report));
    }
}

void ForeignBuilder::write_notes()
{
    const auto note = [&](std::size_t count, Finding finding, const char* text) {
        if (count > 0)
            imported_.report.add(finding, file_.name, text, count);
    };
    note(scene_.meshes.size() - uses_.size(), Finding::ignored, "mesh that no node of the file shows");
    note(scene_.animations, Finding::ignored, "animation: the scene is kept as it stands");
    if (file_.ifc == nullptr)
        return;
    note(file_.ifc->spaces, Finding::ignored, "IfcSpace: a volume of air has no surfaces of its own");
    imported_.report.add(Finding::approximated, file_.name,
                         "round profiles arrive as flat facets, 32 to a full circle at most");
}

void ForeignBuilder::build()
{
    find_uses();
    for (const auto& [mesh, uses] : uses_)
        build_mesh(mesh, uses);
    for (const std::string& light : scene_.lights)
        imported_.ledger.skipped("light", light.empty() ? "default" : light,
                                 "light sources of the file are not modelled");
    add_cameras();
    add_materials();
    faces_.write_notes();
    write_notes();
}

} // namespace

void build_foreign(const ForeignScene& scene, const ForeignFile& file, const Affine& to_metres, Imported& imported)
{
    ForeignBuilder(scene, file, to_metres, imported).build();
}

} // namespace lightwell
