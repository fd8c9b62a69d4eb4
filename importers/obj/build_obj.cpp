#include "importers/obj/build_obj.h"

#include "engine/base/text.h"
#include "engine/geometry/face_shape.h"
#include "importers/laid_pictures.h"
#include "importers/obj/corner_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>

namespace lightwell {
namespace {

/// Corner normals that differ by less are the same normal.
constexpr double same_normal = 1e-6;
/// A common normal this near to the face's own is the face's own, written with three or four decimals.
constexpr double face_normal_tolerance = 1e-3;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The triangles of one set of names, with shared corners.
struct MeshInProgress {
    Mesh mesh;
    CornerIndex known;
    std::uint32_t first_face = 0;
    bool textured = true;
};

/// One face without repeated corners, and what can be said about its shape.
struct Outline {
    std::vector<Point> points;
    std::vector<ObjCorner> corners;
    FaceShape shape;
};

/// Stable over re-import: the number of the `f` statement in the file.
std::string face_name(std::uint32_t number)
{
    std::string name = std::to_string(number);
    name.insert(name.begin(), 'f');
    return name;
}

/// Turns the faces of one file into surfaces.
class ObjBuilder {
public:
    ObjBuilder(const ObjFile& file, const Affine& to_metres, const std::map<std::string, Spectrum>& colours,
               Imported& imported);
    void build();

private:
    void add_face(const ObjFace& face);
    void take_outline(const ObjFace& face);
    bool smooth(const ObjFace& face);
    bool pictured(const ObjFace& face) const;
    void add_to_mesh(std::unordered_map<std::uint32_t, MeshInProgress>& meshes, const ObjFace& face, bool with_normals);
    std::uint32_t mesh_point(MeshInProgress& target, std::size_t corner, bool with_normals);
    void finish_meshes(std::unordered_map<std::uint32_t, MeshInProgress>& meshes);
    ModifierId modifier_of(std::uint32_t state);
    void write_notes();

    const ObjFile& file_;
    const std::map<std::string, Spectrum>& colours_;
    Imported& imported_;
    KeyTable keys_;
    std::vector<Point> points_;
    std::vector<Direction> normals_;
    std::vector<std::optional<ModifierId>> modifiers_; ///< by state
    std::vector<bool> pictured_states_;
    std::unordered_map<std::uint32_t, MeshInProgress> smooth_meshes_, flat_meshes_, pictured_meshes_;
    Outline outline_; ///< of the face at hand; this and the next two are kept to spare allocations
    Triangles triangles_;
    std::vector<std::uint32_t> mesh_points_; ///< number in the mesh by corner of the outline
    void repaired(ObjTally& tally, const ObjFace& face, const char* what);

    ObjTally warped_, crossing_, repeated_, against_;
    double worst_deviation_m_ = 0;
};

ObjBuilder::ObjBuilder(const ObjFile& file, const Affine& to_metres, const std::map<std::string, Spectrum>& colours,
                       Imported& imported)
    : file_(file), colours_(colours), imported_(imported), keys_(imported), modifiers_(file.states.size())
{
    points_.reserve(file.points.size());
    for (const Point& point : file.points)
        points_.push_back(to_metres.point(point));
    normals_.reserve(file.normals.size());
    for (const Vec3& normal : file.normals)
        normals_.push_back(normalized(to_metres.vector(normal)));
    const std::set<std::string> pictured = pictured_materials(imported.file_textures);
    for (const ObjState& state : file.states)
        pictured_states_.push_back(pictured.contains(state.material));
}

void ObjBuilder::build()
{
    imported_.scene.root.surfaces.reserve(file_.faces.size());
    std::vector<std::size_t> made_in_state(file_.states.size());
    for (const ObjFace& face : file_.faces) {
        const std::size_t before = imported_.ledger.made_count();
        add_face(face);
        made_in_state[face.state] += imported_.ledger.made_count() - before;
    }
    finish_meshes(smooth_meshes_);
    finish_meshes(flat_meshes_);
    finish_meshes(pictured_meshes_);
    imported_.made_with_key.assign(imported_.keys.size(), 0);
    for (std::size_t state = 0; state < made_in_state.size(); ++state)
        if (modifiers_[state])
            imported_.made_with_key[static_cast<std::size_t>(*modifiers_[state])] += made_in_state[state];
    write_notes();
}

void ObjBuilder::take_outline(const ObjFace& face)
{
    outline_.points.clear();
    outline_.corners.clear();
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
        const Point& point = points_[static_cast<std::size_t>(file_.corners[i].point)];
        if (!outline_.points.empty() && point == outline_.points.back())
            continue;
        outline_.points.push_back(point);
        outline_.corners.push_back(file_.corners[i]);
    }
    while (outline_.points.size() > 1 && outline_.points.front() == outline_.points.back()) {
        outline_.points.pop_back();
        outline_.corners.pop_back();
    }
    if (outline_.points.size() < face.count)
        repaired(repeated_, face, "corner that stands twice in a row left out");
    outline_.shape = face_shape(outline_.points);
}

void ObjBuilder::add_face(const ObjFace& face)
{
    take_outline(face);
    const bool enough = outline_.points.size() >= 3, has_area = enough && outline_.shape.has_area();
    const bool with_normals = has_area && smooth(face);
    const bool shows_picture = enough && !with_normals && pictured(face);
    if (has_area && !with_normals && !shows_picture && outline_.shape.planar()) {
        imported_.scene.root.add_polygon(outline_.points, modifier_of(face.state), face_name(face.number));
        imported_.ledger.made("face", layer_of(file_.states[face.state]));
        return;
    }
    const std::size_t before = imported_.ledger.made_count();
    if (enough)
        add_to_mesh(with_normals    ? smooth_meshes_
                    : shows_picture ? pictured_meshes_
                                    : flat_meshes_,
                    face, with_normals);
    if (imported_.ledger.made_count() == before) {
        imported_.ledger.skipped("face", layer_of(file_.states[face.state]), "zero area");
        return;
    }
    if (!has_area)
        repaired(crossing_, face, "outline crosses itself: cut into a fan of triangles");
    else if (!outline_.shape.planar())
        repaired(warped_, face, "corners out of plane: cut into triangles");
    worst_deviation_m_ = std::fmax(worst_deviation_m_, outline_.shape.deviation_m);
}

/// True when a picture lies on the face: polygons have no coordinates, so it becomes part of a mesh.
bool ObjBuilder::pictured(const ObjFace& face) const
{
    return pictured_states_[face.state] && std::all_of(outline_.corners.begin(), outline_.corners.end(),
                                                       [](const ObjCorner& corner) { return corner.texture >= 0; });
}

void ObjBuilder::repaired(ObjTally& tally, const ObjFace& face, const char* what)
{
    tally.add(face.line);
    imported_.ledger.repaired("face", layer_of(file_.states[face.state]), what);
}

/// True when the corner normals say something that the plane of the face does not.
bool ObjBuilder::smooth(const ObjFace& face)
{
    const Direction front = normalized(outline_.shape.area);
    double spread = 0, from_front = 0, from_back = 0;
    for (const ObjCorner& corner : outline_.corners) {
        if (corner.normal < 0)
            return false;
        const Direction& normal = normals_[static_cast<std::size_t>(corner.normal)];
        if (normal == Vec3{})
            return false;
        spread = std::fmax(spread, max_abs(normal - normals_[static_cast<std::size_t>(outline_.corners[0].normal)]));
        from_front = std::fmax(from_front, max_abs(normal - front));
        from_back = std::fmax(from_back, max_abs(normal + front));
    }
    const bool flat = spread <= same_normal && std::fmin(from_front, from_back) <= face_normal_tolerance;
    if (flat && from_back < from_front)
        repaired(against_, face, "normals against the order of the corners left out");
    return !flat && !outline_.corners.empty();
}

std::uint32_t ObjBuilder::mesh_point(MeshInProgress& target, std::size_t corner, bool with_normals)
{
    ObjCorner key = outline_.corners[corner];
    if (!with_normals)
        key.normal = -1;
    const std::uint32_t known = target.known.size(), point = target.known.find_or_add(key);
    if (point < known)
        return point;
    target.mesh.points.push_back(outline_.points[corner]);
    if (with_normals)
        target.mesh.normals.push_back(normals_[static_cast<std::size_t>(key.normal)]);
    target.textured = target.textured && key.texture >= 0;
    for (std::size_t i = 0; i < 2; ++i)
        target.mesh.texture.push_back(key.texture < 0 ? 0
                                                      : file_.texture[2 * static_cast<std::size_t>(key.texture) + i]);
    return point;
}

void ObjBuilder::add_to_mesh(std::unordered_map<std::uint32_t, MeshInProgress>& meshes, const ObjFace& face,
                             bool with_normals)
{
    constexpr std::uint32_t not_yet = std::numeric_limits<std::uint32_t>::max();
    mesh_points_.assign(outline_.points.size(), not_yet);
    cut_face(outline_.points, outline_.shape, triangles_);
    bool any = false;
    for (const auto& triangle : triangles_) {
        if (!(length(triangle_area(outline_.points, triangle)) > outline_.shape.least_area_m2()))
            continue;
        const auto [entry, fresh] = meshes.try_emplace(face.state);
        if (fresh)
            entry->second.first_face = face.number;
        for (const std::uint32_t corner : triangle) {
            std::uint32_t& point = mesh_points_[corner];
            if (point == not_yet)
                point = mesh_point(entry->second, corner, with_normals);
            entry->second.mesh.triangles.push_back(point);
        }
        any = true;
    }
    imported_.ledger.made("face", layer_of(file_.states[face.state]), any ? 1 : 0);
}

void ObjBuilder::finish_meshes(std::unordered_map<std::uint32_t, MeshInProgress>& meshes)
{
    for (std::uint32_t state = 0; state < file_.states.size(); ++state) {
        const auto found = meshes.find(state);
        if (found == meshes.end())
            continue;
        MeshInProgress& ready = found->second;
        if (!ready.textured || !pictured_states_[state])
            ready.mesh.texture.clear();
        imported_.scene.root.add_mesh(std::make_shared<const Mesh>(std::move(ready.mesh)), modifier_of(state),
                                      face_name(ready.first_face));
    }
    meshes.clear();
}

ModifierId ObjBuilder::modifier_of(std::uint32_t index)
{
    std::optional<ModifierId>& modifier = modifiers_[index];
    if (modifier)
        return *modifier;
    const ObjState& state = file_.states[index];
    SurfaceKey key{layer_of(state), {}, state.object, state.material, "face", {}};
    for (const std::string& group : state.groups) {
        if (!key.group.empty())
            key.group += ' ';
        key.group += group;
    }
    if (const auto colour = colours_.find(state.material); colour != colours_.end())
        key.colour = colour->second;
    modifier = keys_.modifier_for(key);
    return *modifier;
}

void ObjBuilder::write_notes()
{
    const auto note = [&](const ObjTally& tally, Finding finding, const std::string& text) {
        if (tally.count > 0)
            imported_.report.add(finding, file_.name + ":" + std::to_string(tally.line) + ": face", text, tally.count);
    };
    note(warped_, Finding::approximated,
         "corners do not lie in one plane; cut into triangles, corners were off the mean plane by at most " +
             shortest(worst_deviation_m_) + " m");
    note(crossing_, Finding::approximated, "outline crosses itself; cut into a fan of triangles");
    note(repeated_, Finding::repaired, "a corner stands twice in a row; once is enough");
    note(against_, Finding::repaired,
         "vertex normals point against the order of the corners; the order decides which side is the front");
}

} // namespace

void build_obj(const ObjFile& file, const Affine& to_metres, const std::map<std::string, Spectrum>& colours,
               Imported& imported)
{
    ObjBuilder(file, to_metres, colours, imported).build();
}

} // namespace lightwell
