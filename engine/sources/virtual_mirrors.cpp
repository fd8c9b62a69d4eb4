#include "engine/sources/virtual_mirrors.h"

#include "engine/sources/placed_surfaces.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace lightwell {
namespace {

/// Images grow with the power of the number of mirrors: only the largest are followed.
constexpr std::size_t most_mirrors = 64;
/// A mesh with more planes than this stands for something curved.
constexpr std::size_t most_planes_of_a_mesh = 64;
/// Surfaces and triangles of material Mirror that are looked at, so that a field of a million copies of one does not
/// stop the start. What comes after is left to scattered rays.
constexpr std::size_t most_looked_at = 1 << 18;
/// Corners and normals from files in single precision stray by about 1e-7 of their size.
constexpr double flat_slack = 1e-6;
/// Roundings between the corner in a file and the place where a ray meets the surface.
constexpr double error_steps = 1024 * std::numeric_limits<double>::epsilon();

/// A mirror and what it is known by, before the largest are chosen.
struct Found {
    PlanarMirror mirror;
    std::uint64_t path;
    std::uint32_t surface;
    std::vector<std::uint32_t> triangles; ///< of a mesh
    const Surface* drawn;                 ///< copies share it
    UnreachableMirror description;
    std::size_t number; ///< order of finding, for equal weights
};

double stretch_of(const Affine& map)
{
    return max_abs(map.x) + max_abs(map.y) + max_abs(map.z);
}

PlanarMirror mirror_on(const Direction& normal, const Point& on_plane, Spectrum reflectance)
{
    PlanarMirror mirror;
    mirror.frame = frame_about(normal);
    mirror.centre = on_plane;
    mirror.reflectance = reflectance;
    return mirror;
}

void add_edge(PlanarMirror& mirror, const Point& a, const Point& b)
{
    const Vec3 p = mirror.frame.to_local(a - mirror.centre), q = mirror.frame.to_local(b - mirror.centre);
    mirror.outline.edges.push_back({p.x, p.y, q.x, q.y});
}

/// Moves the origin to the middle of the points, so that the ball about it is small.
void centre_on(PlanarMirror& mirror, const std::vector<Point>& points)
{
    Box box;
    for (const Point& p : points)
        box.extend(p);
    const Point middle = box.centre();
    mirror.centre = middle - mirror.frame.z * mirror.height_m(middle);
    for (const Point& p : points)
        mirror.radius_m = std::max(mirror.radius_m, length(p - mirror.centre));
    mirror.error_m = error_steps * (max_abs(box.low) + max_abs(box.high));
}

std::optional<PlanarMirror> polygon_mirror(const PlacedSurface& placed, Spectrum reflectance)
{
    const Polygon& polygon = placed.part.polygons[placed.surface.index];
    std::vector<Point> corners;
    double inner = 0;
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
        const Point& p = placed.part.points[polygon.first + i];
        inner = std::max(inner, max_abs(p));
        corners.push_back(placed.to_world.point(p));
    }
    const Vec3 area = polygon_area_vector(corners.data(), corners.size());
    if (!(length(area) > 0))
        return {};
    PlanarMirror mirror = mirror_on(normalized(area), corners[0], reflectance);
    mirror.area_m2 = length(area);
    centre_on(mirror, corners);
    mirror.error_m += error_steps * inner * stretch_of(placed.to_world);
    for (std::size_t i = 0; i < corners.size(); ++i)
        add_edge(mirror, corners[i], corners[(i + 1) % corners.size()]);
    return mirror;
}

std::optional<PlanarMirror> ring_mirror(const PlacedSurface& placed, Spectrum reflectance)
{
    const Ring& ring = placed.part.rings[placed.surface.index];
    const Frame local = sector_frame(ring.sector, ring.normal);
    const Vec3 x = placed.to_world.vector(local.x), y = placed.to_world.vector(local.y);
    const Vec3 across = cross(x, y);
    if (!(length(across) > 0))
        return {};
    PlanarMirror mirror = mirror_on(normalized(across), placed.to_world.point(ring.centre), reflectance);
    const Vec3 px = mirror.frame.to_local(x), py = mirror.frame.to_local(y);
    const double determinant = px.x * py.y - py.x * px.y;
    mirror.outline.to_disc = {py.y / determinant, -py.x / determinant, -px.y / determinant, px.x / determinant};
    mirror.outline.inner_squared = ring.inner_radius * ring.inner_radius;
    mirror.outline.outer_squared = ring.outer_radius * ring.outer_radius;
    mirror.outline.sweep_rad = ring.sector.sweep_rad;
    mirror.area_m2 =
        pi * (mirror.outline.outer_squared - mirror.outline.inner_squared) * length(across) * ring.sector.share();
    mirror.radius_m = ring.outer_radius * std::sqrt(dot(x, x) + dot(y, y));
    mirror.error_m =
        error_steps * (max_abs(mirror.centre) + mirror.radius_m + max_abs(ring.centre) * stretch_of(placed.to_world));
    return mirror;
}

/// The triangles of a mesh, plane by plane.
struct MeshPlane {
    Direction normal;
    Point on_plane;
    double area_m2 = 0;
    std::vector<std::uint32_t> triangles;
};

class MeshPlanes {
public:
    MeshPlanes(const Mesh& mesh, const Affine& to_world) : mesh_(mesh)
    {
        for (const Point& p : mesh.points)
            points_.push_back(to_world.point(p));
        const std::size_t count = mesh.triangles.size() / 3;
        for (std::size_t t = 0; t < count && !curved_; ++t)
            add(static_cast<std::uint32_t>(t), to_world);
    }
    bool curved() const { return curved_; }
    const std::vector<MeshPlane>& planes() const { return planes_; }
    const std::vector<Point>& points() const { return points_; }

private:
    /// A corner's normal that turns away from the triangle makes the reflection that of a curved surface.
    bool smooth(std::size_t t, const Affine& to_world, const Direction& normal) const
    {
        for (std::size_t c = 0; c < 3 && !mesh_.normals.empty(); ++c) {
            const Direction n = transform_normal(to_world, normalized(mesh_.normals[mesh_.triangles[3 * t + c]]));
            if (!(length(cross(n, normal)) <= flat_slack))
                return true;
        }
        return false;
    }
    void add(std::uint32_t t, const Affine& to_world)
    {
        const Point& a = points_[mesh_.triangles[3 * t]];
        const Vec3 area = cross(points_[mesh_.triangles[3 * t + 1]] - a, points_[mesh_.triangles[3 * t + 2]] - a) * 0.5;
        if (!(length(area) > 0))
            return;
        const Direction normal = normalized(area);
        curved_ = curved_ || smooth(t, to_world, normal);
        auto at = std::find_if(planes_.begin(), planes_.end(), [&](const MeshPlane& plane) {
            const Vec3 apart = a - plane.on_plane;
            return length(cross(plane.normal, normal)) <= flat_slack &&
                   std::fabs(dot(plane.normal, apart)) <= flat_slack * (length(apart) + std::sqrt(length(area)));
        });
        if (at == planes_.end())
            at = planes_.insert(planes_.end(), MeshPlane{normal, a, 0, {}});
        at->area_m2 += length(area);
        at->triangles.push_back(t);
        curved_ = curved_ || planes_.size() > most_planes_of_a_mesh;
    }

    const Mesh& mesh_;
    std::vector<Point> points_;
    std::vector<MeshPlane> planes_;
    bool curved_ = false;
};

/// Edges that two triangles share cancel by the even-odd rule and are left out.
PlanarMirror mesh_mirror(const Mesh& mesh, const MeshPlanes& planes, const MeshPlane& plane, Spectrum reflectance)
{
    PlanarMirror mirror = mirror_on(plane.normal, plane.on_plane, reflectance);
    mirror.area_m2 = plane.area_m2;
    std::vector<Point> corners;
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> odd;
    for (const std::uint32_t t : plane.triangles)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t a = mesh.triangles[3 * t + c], b = mesh.triangles[3 * t + (c + 1) % 3];
            bool& is_odd = odd[std::minmax(a, b)];
            is_odd = !is_odd;
            corners.push_back(planes.points()[a]);
        }
    centre_on(mirror, corners);
    for (const auto& [edge, is_odd] : odd)
        if (is_odd)
            add_edge(mirror, planes.points()[edge.first], planes.points()[edge.second]);
    return mirror;
}

double weight_of(const Found& found)
{
    return found.mirror.area_m2 * photopic(found.mirror.reflectance);
}

bool on_one_another(const PlanarMirror& a, const PlanarMirror& b)
{
    return length(cross(a.frame.z, b.frame.z)) * b.radius_m <= a.error_m + b.error_m &&
           std::fabs(a.height_m(b.centre)) <= a.error_m + b.error_m &&
           length(a.centre - b.centre) < a.radius_m + b.radius_m;
}

} // namespace

bool FlatOutline::holds(double x, double y) const noexcept
{
    if (outer_squared > 0) {
        const double u = to_disc[0] * x + to_disc[1] * y, v = to_disc[2] * x + to_disc[3] * y;
        const double squared = u * u + v * v;
        const Sector sector{{1, 0, 0}, sweep_rad};
        return squared >= inner_squared && squared <= outer_squared && sector.holds({0, 0, 1}, {u, v, 0});
    }
    bool inside = false;
    for (const Edge& e : edges) {
        if ((e.ay > y) == (e.by > y))
            continue;
        const double side = (e.ax - x) * (e.by - y) - (e.bx - x) * (e.ay - y);
        if (e.by > e.ay ? side > 0 : side < 0)
            inside = !inside;
    }
    return inside;
}

/// Collects the mirrors, then keeps the largest.
struct MirrorSet::Builder {
    MirrorSet& set;
    std::vector<Found> found = {};
    std::size_t looked_at = 0;

    std::map<std::pair<const Surface*, bool>, std::size_t> listed = {}; ///< places in set.unreachable_

    void leave_out(const Surface* drawn, const UnreachableMirror& description)
    {
        const auto [at, is_new] = listed.try_emplace({drawn, description.curved}, set.unreachable_.size());
        if (is_new) {
            set.unreachable_.push_back(description);
            return;
        }
        set.unreachable_[at->second].count += description.count;
        set.unreachable_[at->second].area_m2 += description.area_m2;
    }
    void keep(const PlacedSurface& placed, std::optional<PlanarMirror> mirror, std::vector<std::uint32_t> triangles)
    {
        if (!mirror)
            return;
        mirror->hidden = !std::get<Mirror>(placed.material).alternate.empty();
        UnreachableMirror description{placed.surface.name, placed.modifier, mirror->area_m2, mirror->reflectance};
        found.push_back({std::move(*mirror), placed.path, placed.index, std::move(triangles), &placed.surface,
                         std::move(description), looked_at});
        if (found.size() > 16 * most_mirrors)
            keep_largest();
    }
    void add(const PlacedSurface& placed)
    {
        ++looked_at;
        const Spectrum reflectance = std::get<Mirror>(placed.material).reflectance;
        if (reflectance.is_black())
            return;
        if (placed.surface.shape == Shape::polygon)
            return keep(placed, polygon_mirror(placed, reflectance), {});
        if (placed.surface.shape == Shape::ring)
            return keep(placed, ring_mirror(placed, reflectance), {});
        if (placed.surface.shape == Shape::mesh) {
            const Mesh& mesh = *placed.part.meshes[placed.surface.index];
            looked_at += mesh.triangles.size() / 3;
            const MeshPlanes planes(mesh, placed.to_world);
            if (!planes.curved()) {
                for (const MeshPlane& plane : planes.planes())
                    keep(placed, mesh_mirror(mesh, planes, plane, reflectance), plane.triangles);
                return;
            }
        }
        // Exact for similarities.
        const double area =
            surface_area_m2(placed.part, placed.surface) * std::pow(std::fabs(placed.to_world.determinant()), 2.0 / 3);
        leave_out(&placed.surface, {placed.surface.name, placed.modifier, area, reflectance, 1, true});
    }
    void keep_largest()
    {
        std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            const double weight_a = weight_of(a), weight_b = weight_of(b);
            return std::tie(weight_b, a.number) < std::tie(weight_a, b.number);
        });
        for (std::size_t i = most_mirrors; i < found.size(); ++i)
            leave_out(found[i].drawn, found[i].description);
        if (found.size() > most_mirrors)
            found.erase(found.begin() + most_mirrors, found.end());
    }
    void finish()
    {
        keep_largest();
        std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            return std::tie(a.path, a.surface, a.number) < std::tie(b.path, b.surface, b.number);
        });
        for (Found& f : found) {
            const int index = static_cast<int>(set.mirrors_.size());
            Place& place = set.by_place_[place_key(f.path, f.surface)];
            place.mirror = index;
            for (const std::uint32_t t : f.triangles) {
                if (place.by_triangle.size() <= t)
                    place.by_triangle.resize(t + 1, -1);
                place.by_triangle[t] = index;
            }
            std::vector<std::uint32_t> before;
            for (std::size_t i = 0; i < set.mirrors_.size(); ++i)
                if (on_one_another(set.mirrors_[i], f.mirror))
                    before.push_back(static_cast<std::uint32_t>(i));
            set.before_.push_back(std::move(before));
            set.mirrors_.push_back(std::move(f.mirror));
        }
    }
};

MirrorSet::MirrorSet(const Scene& scene)
{
    Builder builder{*this};
    visit_placed(
        scene, [](const Material& material) { return std::holds_alternative<Mirror>(material); },
        [&](const PlacedSurface& placed) {
            // A mirror with a pattern or a texture has no one image: scattered rays find what it shows.
            if (!resolve(scene, placed.modifier).varies)
                builder.add(placed);
            return builder.looked_at < most_looked_at;
        });
    complete_ = builder.looked_at < most_looked_at;
    builder.finish();
}

int MirrorSet::mirror_at(const Hit& hit) const noexcept
{
    const auto found = by_place_.find(place_key(hit.path, hit.surface));
    if (found == by_place_.end())
        return -1;
    const Place& place = found->second;
    int mirror = place.mirror;
    if (!place.by_triangle.empty())
        mirror = hit.triangle < place.by_triangle.size() ? place.by_triangle[hit.triangle] : -1;
    if (mirror < 0)
        return -1;
    for (const std::uint32_t first : before_[static_cast<std::size_t>(mirror)])
        if (holds(first, hit.position))
            return static_cast<int>(first);
    return mirror;
}

bool MirrorSet::holds(std::size_t mirror, const Point& p) const noexcept
{
    if (!mirrors_[mirror].holds(p))
        return false;
    for (const std::uint32_t first : before_[mirror])
        if (mirrors_[first].holds(p))
            return false;
    return true;
}

std::vector<UnreachableMirror> unreachable_mirrors(const Scene& scene)
{
    return MirrorSet(scene).unreachable();
}

} // namespace lightwell
