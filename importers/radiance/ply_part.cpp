#include "importers/radiance/ply_part.h"

#include "engine/base/random.h"
#include "engine/base/text.h"
#include "engine/geometry/face_shape.h"

#include <bit>
#include <cmath>
#include <memory>

namespace lightwell::scene_text {
namespace {

/// Normals that differ from the face's own by less say nothing that its plane does not.
constexpr double face_normal_tolerance = 1e-3;

struct Corner {
    std::uint32_t vertex = 0;
    Direction normal{0, 0, 0};
    double u = 0, v = 0;

    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& corner) const noexcept
    {
        std::uint64_t hash = corner.vertex;
        for (const double value : {corner.normal.x, corner.normal.y, corner.normal.z, corner.u, corner.v})
            hash = mix_bits(std::bit_cast<std::uint64_t>(value + 0.0), hash); // -0 becomes 0, as == sees them
        return hash;
    }
};

/// Triangles of one modifier whose equal corners are shared.
struct GrowingMesh {
    Mesh mesh;
    std::unordered_map<Corner, std::uint32_t, CornerHash> known;
    std::vector<std::uint32_t> faces; ///< by triangle

    std::uint32_t index_of(const Corner& corner, const Point& point, bool with_normals, bool with_texture)
    {
        const auto [entry, fresh] = known.try_emplace(corner, static_cast<std::uint32_t>(mesh.points.size()));
        if (fresh) {
            mesh.points.push_back(point);
            if (with_normals)
                mesh.normals.push_back(corner.normal);
            if (with_texture)
                mesh.texture.insert(mesh.texture.end(), {corner.u, corner.v});
        }
        return entry->second;
    }
};

void add_mesh(PlyPart& to, Mesh&& mesh, std::vector<std::uint32_t>&& faces, std::size_t modifier)
{
    if (mesh.triangles.empty())
        return;
    auto shared = std::make_shared<const Mesh>(std::move(mesh));
    // Named by its first face, with a sign that others are in it.
    to.part.add_mesh(shared, static_cast<ModifierId>(modifier), std::to_string(faces.front()) + "+");
    to.file->faces[shared.get()] = std::move(faces);
}

class FaceBuilder {
public:
    FaceBuilder(const PlyMesh& mesh, const std::vector<bool>& textured, const std::string& name)
        : mesh_(mesh), textured_(textured), name_(name), bent_(2 * textured.size())
    {
    }

    PlyPart build()
    {
        result_.part.name = name_;
        result_.modifiers = mesh_.modifiers;
        result_.file->face_sizes = mesh_.cage.face_sizes;
        result_.used.assign(textured_.size(), false);
        std::size_t first = 0;
        for (std::uint32_t face = 0; face < mesh_.cage.face_sizes.size(); ++face) {
            add_face(face, first);
            first += mesh_.cage.face_sizes[face];
        }
        for (std::size_t i = 0; i < bent_.size(); ++i)
            add_mesh(result_, std::move(bent_[i].mesh), std::move(bent_[i].faces), i / 2);
        write_notes();
        return std::move(result_);
    }

private:
    void take_outline(std::uint32_t face, std::size_t first)
    {
        points_.clear();
        corners_.clear();
        for (std::size_t i = first; i < first + mesh_.cage.face_sizes[face]; ++i) {
            const std::uint32_t vertex = mesh_.cage.corners[i];
            const Point& point = mesh_.cage.points[vertex];
            if (!points_.empty() && point == points_.back())
                continue;
            points_.push_back(point);
            corners_.push_back({vertex, {0, 0, 0}, 0, 0});
            if (!mesh_.normals.empty())
                corners_.back().normal = mesh_.normals[i];
            if (!mesh_.texture.empty()) {
                corners_.back().u = mesh_.texture[2 * i];
                corners_.back().v = mesh_.texture[2 * i + 1];
            }
        }
        while (points_.size() > 1 && points_.front() == points_.back()) {
            points_.pop_back();
            corners_.pop_back();
        }
    }

    bool smooth(const Direction& front) const
    {
        if (mesh_.normals.empty())
            return false;
        double from_front = 0, from_back = 0;
        for (const Corner& corner : corners_) {
            if (corner.normal == Vec3{})
                return false;
            from_front = std::fmax(from_front, max_abs(corner.normal - front));
            from_back = std::fmax(from_back, max_abs(corner.normal + front));
        }
        return std::fmin(from_front, from_back) > face_normal_tolerance;
    }

    void add_face(std::uint32_t face, std::size_t first)
    {
        const std::size_t modifier =
            mesh_.face_modifiers.empty() ? 0 : static_cast<std::size_t>(mesh_.face_modifiers[face] + 1);
        take_outline(face, first);
        const FaceShape shape = points_.size() < 3 ? FaceShape{} : face_shape(points_);
        if (!shape.has_area()) {
            ++without_area_;
            return;
        }
        result_.used[modifier] = true;
        const bool with_normals = smooth(normalized(shape.area));
        const bool with_texture = !mesh_.texture.empty() && textured_[modifier];
        if (!with_normals && !with_texture && shape.planar()) {
            result_.part.add_polygon(points_, static_cast<ModifierId>(modifier), std::to_string(face));
            return;
        }
        if (!shape.planar()) {
            ++warped_;
            worst_deviation_m_ = std::fmax(worst_deviation_m_, shape.deviation_m);
        }
        GrowingMesh& bent = bent_[2 * modifier + (with_normals ? 1 : 0)];
        cut_face(points_, shape, triangles_);
        for (const auto& triangle : triangles_) {
            if (!(length(triangle_area(points_, triangle)) > shape.least_area_m2()))
                continue;
            for (const std::uint32_t i : triangle) {
                Corner corner = corners_[i];
                if (!with_normals)
                    corner.normal = {0, 0, 0};
                if (!with_texture)
                    corner.u = corner.v = 0;
                bent.mesh.triangles.push_back(bent.index_of(corner, points_[i], with_normals, with_texture));
            }
            bent.faces.push_back(face);
        }
    }

    void write_notes()
    {
        if (warped_ > 0)
            result_.report.add(
                Finding::approximated, name_,
                "face whose corners do not lie in one plane; cut into triangles, corners were off the mean "
                "plane by at most " +
                    shortest(worst_deviation_m_) + " m",
                warped_);
        if (without_area_ > 0)
            result_.report.add(Finding::ignored, name_, "face without area left out", without_area_);
    }

    const PlyMesh& mesh_;
    const std::vector<bool>& textured_;
    const std::string& name_;
    PlyPart result_;
    std::vector<GrowingMesh> bent_; ///< for each modifier: flat ones, those with normals
    std::vector<Point> points_;
    std::vector<Corner> corners_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::size_t warped_ = 0, without_area_ = 0;
    double worst_deviation_m_ = 0;
};

void note_limit(Report& report, const LimitSurface& surface, double chord_tolerance_m, const std::string& name)
{
    if (surface.faces_left_out > 0 && !report.has(Finding::ignored))
        report.add(Finding::ignored, name, "face of the cage without three different corners left out",
                   surface.faces_left_out);
    if (surface.creases_left_out > 0 && !report.has(Finding::repaired))
        report.add(Finding::repaired, name, "crease that is not along an edge of the cage left out",
                   surface.creases_left_out);
    if (!surface.reached_tolerance)
        report.add(Finding::approximated, name,
                   "limit surface within " + shortest(surface.largest_deviation_m) + " m in place of " +
                       shortest(chord_tolerance_m) + " m: more triangles would be too many");
}

} // namespace

PlyPart faces_of(const PlyMesh& mesh, const std::vector<bool>& textured, const std::string& name)
{
    return FaceBuilder(mesh, textured, name).build();
}

PlyPart limit_surface_of(const PlyMesh& mesh, double chord_tolerance_m, const std::string& name)
{
    PlyPart result;
    result.part.name = name;
    result.modifiers = mesh.modifiers;
    result.file->face_sizes = mesh.cage.face_sizes;
    result.used.assign(mesh.modifiers.size() + 1, false);
    for (const std::int32_t modifier : mesh.face_modifiers)
        result.used[static_cast<std::size_t>(modifier + 1)] = true;
    if (mesh.face_modifiers.empty())
        result.used[0] = true;
    for (std::size_t modifier = 0; modifier < result.used.size(); ++modifier) {
        if (!result.used[modifier])
            continue;
        // Faces of other modifiers shape the surface, but are not part of this mesh.
        SubdivisionCage cage = mesh.cage;
        for (std::uint32_t face = 0; face < mesh.face_modifiers.size(); ++face)
            if (static_cast<std::size_t>(mesh.face_modifiers[face] + 1) != modifier)
                cage.holes.push_back(face);
        LimitSurface surface = limit_surface(cage, chord_tolerance_m, name);
        note_limit(result.report, surface, chord_tolerance_m, name);
        add_mesh(result, std::move(surface.mesh), std::move(surface.faces), modifier);
    }
    if (!mesh.texture.empty())
        result.report.add(Finding::unsupported, name, "texture places on a limit surface are not modelled yet");
    return result;
}

} // namespace lightwell::scene_text
