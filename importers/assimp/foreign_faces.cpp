#include "importers/assimp/foreign_faces.h"

#include "engine/base/box.h"
#include "engine/base/random.h"
#include "engine/base/text.h"
#include "engine/geometry/triangulate.h"

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <unordered_map>

namespace lightwell {
namespace {

/// Corners may leave the plane of their face by this share of the face's diameter: single precision does so.
constexpr double planar_tolerance = 1e-4;
/// Area below this share of the squared diameter is rounding of single precision, not a surface.
constexpr double zero_area_tolerance = 1e-10;
/// Normals that differ from the face's own by less say nothing that its plane does not.
constexpr double face_normal_tolerance = 1e-3;
/// Cutting ears takes time that grows with the cube of the corners at worst: 1024 corners take about a second.
constexpr std::size_t most_corners_for_ears = 1024;

struct Corner {
    Point point;
    Direction normal;
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& corner) const noexcept
    {
        std::uint64_t hash = 0;
        for (const Vec3& v : {corner.point, corner.normal})
            for (int axis = 0; axis < 3; ++axis) {
                const double value = v[axis] + 0.0; // -0 becomes 0, as == sees them
                std::uint64_t bits = 0;
                std::memcpy(&bits, &value, sizeof bits);
                hash = mix_bits(bits, hash);
            }
        return hash;
    }
};

/// A mesh whose equal corners are shared.
class SharedMesh {
public:
    explicit SharedMesh(bool with_normals) : with_normals_(with_normals) {}
    void add(const Corner& corner)
    {
        const Corner key{corner.point, with_normals_ ? corner.normal : Direction{}};
        const auto [entry, fresh] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.points.size()));
        if (fresh) {
            mesh_.points.push_back(key.point);
            if (with_normals_)
                mesh_.normals.push_back(key.normal);
        }
        mesh_.triangles.push_back(entry->second);
    }
    bool empty() const { return mesh_.triangles.empty(); }
    std::shared_ptr<const Mesh> take() { return std::make_shared<const Mesh>(std::move(mesh_)); }

private:
    const bool with_normals_;
    Mesh mesh_;
    std::unordered_map<Corner, std::uint32_t, CornerHash> known_;
};

} // namespace

struct ForeignFaces::Outline {
    std::vector<Corner> corners;
    std::vector<Point> points;
    bool with_normals = false;
};

struct ForeignFaces::Target {
    Part& part;
    ModifierId modifier;
    const std::string& name;
    SharedMesh flat{false}, smooth{true};
    std::size_t faces = 0;
};

FaceCounts count_faces(const ForeignMesh& mesh)
{
    FaceCounts counts;
    for (const std::uint32_t size : mesh.face_sizes)
        ++(size >= 3 ? counts.faces : size == 2 ? counts.lines : counts.dots);
    return counts;
}

/// Cuts ear by ear; what crosses itself or has too many corners becomes a fan.
static std::vector<std::array<std::uint32_t, 3>> cut(const std::vector<Point>& points)
{
    if (points.size() <= most_corners_for_ears)
        return triangulate(points.data(), points.size());
    std::vector<std::array<std::uint32_t, 3>> fan;
    for (std::uint32_t i = 1; i + 1 < points.size(); ++i)
        fan.push_back({0, i, i + 1});
    return fan;
}

static bool bent(const std::vector<Corner>& corners, const Direction& front)
{
    double from_front = 0, from_back = 0;
    for (const Corner& corner : corners) {
        if (corner.normal == Vec3{})
            return false;
        from_front = std::fmax(from_front, max_abs(corner.normal - front));
        from_back = std::fmax(from_back, max_abs(corner.normal + front));
    }
    return std::fmin(from_front, from_back) > face_normal_tolerance;
}

void ForeignFaces::add_outline(const Outline& outline, Target& target)
{
    Box box;
    Vec3 sum;
    for (const Point& point : outline.points) {
        box.extend(point);
        sum += point - outline.points[0];
    }
    const double diameter_m = box.diagonal();
    const Vec3 area = polygon_area_vector(outline.points.data(), outline.points.size());
    if (!(length(area) > zero_area_tolerance * diameter_m * diameter_m)) {
        ++empty_;
        return;
    }
    ++target.faces;
    const Direction front = normalized(area);
    const bool smooth = outline.with_normals && bent(outline.corners, front);
    const Point middle = outline.points[0] + sum / static_cast<double>(outline.points.size());
    double deviation_m = 0;
    for (const Point& point : outline.points)
        deviation_m = std::fmax(deviation_m, std::fabs(dot(point - middle, front)));
    const bool triangle = outline.points.size() == 3;
    const bool planar = triangle || deviation_m <= planar_tolerance * diameter_m;
    if (!smooth && planar && !triangle) {
        target.part.add_polygon(outline.points, target.modifier, target.name);
        return;
    }
    if (!planar) {
        ++warped_;
        worst_deviation_m_ = std::fmax(worst_deviation_m_, deviation_m);
    }
    for (const auto& corners : cut(outline.points))
        for (const std::uint32_t corner : corners)
            (smooth ? target.smooth : target.flat).add(outline.corners[corner]);
}

std::size_t ForeignFaces::add(const ForeignMesh& mesh, const Affine& map, ModifierId modifier, const std::string& name,
                              Part& part)
{
    Target target{.part = part, .modifier = modifier, .name = name};
    const bool mirrored = map.determinant() < 0;
    const auto vector = [](const std::vector<float>& numbers, std::uint32_t at) {
        return Vec3{numbers[3 * at], numbers[3 * at + 1], numbers[3 * at + 2]};
    };
    Outline outline;
    outline.with_normals = !mesh.normals.empty() && map.determinant() != 0;
    std::size_t first = 0;
    for (const std::uint32_t size : mesh.face_sizes) {
        outline.corners.clear();
        bool finite = true;
        for (std::uint32_t i = 0; i < size && size >= 3; ++i) {
            const std::uint32_t at = mesh.corners[first + (mirrored ? size - 1 - i : i)];
            Corner corner{map.point(vector(mesh.points, at)), {}};
            if (outline.with_normals && is_finite(vector(mesh.normals, at)))
                corner.normal = transform_normal(map, normalized(vector(mesh.normals, at)));
            finite = finite && is_finite(corner.point);
            if (outline.corners.empty() || corner.point != outline.corners.back().point)
                outline.corners.push_back(corner);
        }
        first += size;
        while (outline.corners.size() > 1 && outline.corners.front().point == outline.corners.back().point)
            outline.corners.pop_back();
        outline.points.clear();
        for (const Corner& corner : outline.corners)
            outline.points.push_back(corner.point);
        not_finite_ += !finite;
        if (finite && outline.points.size() >= 3)
            add_outline(outline, target);
        else if (finite && size >= 3)
            ++empty_;
    }
    for (SharedMesh* ready : {&target.flat, &target.smooth})
        if (!ready->empty())
            part.add_mesh(ready->take(), modifier, name);
    return target.faces;
}

void ForeignFaces::write_notes()
{
    const auto note = [&](std::size_t count, Finding finding, const std::string& text) {
        if (count > 0)
            report_.add(finding, file_, text, count);
    };
    note(warped_, Finding::approximated,
         "face whose corners do not lie in one plane; cut into triangles, corners were off the mean plane by at most " +
             shortest(worst_deviation_m_) + " m");
    note(empty_, Finding::ignored, "face without area");
    note(not_finite_, Finding::ignored, "face with a corner that is not finite");
}

} // namespace lightwell
