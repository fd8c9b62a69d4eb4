#include "engine/accel/part_queries.h"
#include "engine/accel/round_test.h"
#include "engine/scene/expansion.h"
#include "materials/bsdf.h"
#include "materials/placed.h"

#include <tuple>

namespace lightwell {
namespace {

/// Steps of double precision by which a computed position may lie off its surface: two transformations, the
/// intersection, and as much again to be sure.
constexpr double position_steps = 64;

ModifierId world_modifier(const Level& level, ModifierId modifier)
{
    for (const Level* l = &level; l->instance != nullptr; l = l->outer)
        modifier = bound_modifier(*l->part->scene, modifier, l->instance->bindings);
    return modifier;
}

Vec3 normal_to_world(const Level& level, Vec3 normal)
{
    for (const Level* l = &level; l->instance != nullptr; l = l->outer)
        normal = transform_normal(l->instance->to_parent, normal);
    return normal;
}

struct Normals {
    Vec3 geometric, shading;
};

Normals mesh_normals(const Mesh& mesh, const MeshGeometry& geometry, std::uint32_t triangle, const Point& at)
{
    const Direction flat = geometry.face_normals[triangle];
    if (mesh.normals.empty())
        return {flat, flat};
    const std::uint32_t* corner = &mesh.triangles[3 * std::size_t{triangle}];
    const Point &a = mesh.points[corner[0]], &b = mesh.points[corner[1]], &c = mesh.points[corner[2]];
    // Weights by the areas opposite to the corners, measured along the face normal.
    const double wa = dot(flat, cross(b - at, c - at)), wb = dot(flat, cross(c - at, a - at)),
                 wc = dot(flat, cross(a - at, b - at));
    const Vec3 smooth =
        normalized(mesh.normals[corner[0]] * wa + mesh.normals[corner[1]] * wb + mesh.normals[corner[2]] * wc);
    if (length(smooth) == 0)
        return {flat, flat};
    return {flat, dot(smooth, flat) < 0 ? -smooth : smooth};
}

/// What a picture that is laid on a mesh has at a place; 0 where there is none.
struct TexturePlace {
    UnitSquare coordinates{};
    Vec3 along_u{}, along_v{}; ///< change of the place with each of them, in the plane of the triangle
};

/// Across a triangle with edges e1, e2 from its first corner: position = e1 b + e2 c and u = u1 b + u2 c, v = v1 b + v2
/// c, so that (along_u, along_v) is (e1, e2) times the inverse of the matrix of u1, u2, v1, v2.
TexturePlace texture_at(const Mesh& mesh, std::uint32_t triangle, const Point& at)
{
    if (mesh.texture.size() != 2 * mesh.points.size())
        return {};
    const std::uint32_t* corner = &mesh.triangles[3 * std::size_t{triangle}];
    const Point &a = mesh.points[corner[0]], &b = mesh.points[corner[1]], &c = mesh.points[corner[2]];
    const Vec3 area = cross(b - a, c - a);
    const double whole = dot(area, area);
    if (!(whole > 0))
        return {};
    const double wb = dot(area, cross(at - a, c - a)) / whole, wc = dot(area, cross(b - a, at - a)) / whole;
    const auto of = [&](int i, std::size_t axis) { return mesh.texture[2 * std::size_t{corner[i]} + axis]; };
    const double u1 = of(1, 0) - of(0, 0), u2 = of(2, 0) - of(0, 0), v1 = of(1, 1) - of(0, 1), v2 = of(2, 1) - of(0, 1),
                 spread = u1 * v2 - u2 * v1;
    TexturePlace found;
    found.coordinates = {of(0, 0) + wb * u1 + wc * u2, of(0, 1) + wb * v1 + wc * v2};
    if (spread != 0) {
        found.along_u = ((b - a) * v2 - (c - a) * v1) / spread;
        found.along_v = ((c - a) * u1 - (b - a) * u2) / spread;
    }
    return found;
}

/// From the world into the frame of this level's part.
Affine into_part(const Level& level)
{
    Affine into;
    for (const Level* l = &level; l->instance != nullptr; l = l->outer) {
        const std::size_t index = static_cast<std::size_t>(l->instance - l->outer->part->part->instances.data());
        into = compose(into, l->outer->part->placed[index].to_local);
    }
    return into;
}

Normals surface_normals(const PartQueries& queries, const Surface& surface, const MeshGeometry* mesh,
                        std::uint32_t triangle, const Point& at)
{
    const Part& part = *queries.part;
    const auto both = [](const Vec3& n) { return Normals{n, n}; };
    switch (surface.shape) {
    case Shape::polygon:
        return both(queries.polygon_normals[surface.index]);
    case Shape::sphere:
        return both(sphere_normal(part.spheres[surface.index], at));
    case Shape::bubble:
        return both(-sphere_normal(part.spheres[surface.index], at));
    case Shape::cone:
    case Shape::cylinder:
        return both(cone_normal(part.cones[surface.index], at));
    case Shape::cup:
    case Shape::tube:
        return both(-cone_normal(part.cones[surface.index], at));
    case Shape::ring:
        return both(part.rings[surface.index].normal);
    case Shape::mesh:
        return mesh_normals(*part.meshes[surface.index], *mesh, triangle, at);
    case Shape::source:
    case Shape::instance:
        break;
    }
    return both({0, 0, 1});
}

} // namespace

PatternPlace pattern_place(const Hit& hit, const Direction& direction, double distance_m) noexcept
{
    PatternPlace place;
    place.position = hit.position;
    place.direction = direction;
    place.normal = hit.normal;
    place.distance_m = distance_m;
    if (hit.path != 0)
        place.to_part = &hit.to_part;
    const Surface& surface = hit.part->surfaces[hit.surface];
    if (surface.shape == Shape::mesh) {
        const TexturePlace laid =
            texture_at(*hit.part->meshes[surface.index], hit.triangle, hit.to_part.point(hit.position));
        place.texture = laid.coordinates;
        place.along_u = laid.along_u;
        place.along_v = laid.along_v;
        if (place.to_part != nullptr && !(laid.along_u == Vec3{})) {
            const Affine to_world = inverse(hit.to_part);
            place.along_u = to_world.vector(laid.along_u);
            place.along_v = to_world.vector(laid.along_v);
        }
    }
    return place;
}

Spectrum passage(Hit& hit, const Direction& direction, double distance_m, const PartQueries& queries,
                 bool* illum_front) noexcept
{
    const double cosine = dot(hit.normal, direction);
    const Material* material = (*queries.materials)[static_cast<std::size_t>(hit.modifier)];
    if (material != nullptr && std::holds_alternative<Illum>(*material)) {
        if (cosine < 0 && illum_front == nullptr)
            return {};
        if (cosine < 0)
            *illum_front = true;
        hit.modifier = (*queries.alternates)[static_cast<std::size_t>(hit.modifier)];
        if (hit.modifier == void_modifier)
            return Spectrum::grey(1);
        material = (*queries.materials)[static_cast<std::size_t>(hit.modifier)];
    }
    const ModifierId modifier = hit.modifier;
    if (!(*queries.see_through)[static_cast<std::size_t>(modifier)])
        return {};
    if (cosine > 0 && (*queries.unseen_backs)[static_cast<std::size_t>(modifier)])
        return Spectrum::grey(1);
    SeenMaterial seen;
    if (queries.varied->varies(modifier)) {
        queries.varied->look(modifier, pattern_place(hit, direction, distance_m), seen);
        material = seen.material;
        if (material == nullptr)
            return Spectrum::grey(1);
    }
    if (stands_for_geometry(*material))
        return Spectrum::grey(1);
    const Frame frame = frame_of(*material, cosine < 0 ? hit.normal : -hit.normal);
    const Bsdf bsdf(*material, cosine < 0, frame);
    if (!bsdf.lobes().transparent_to_shadows)
        return {};
    Direction to_viewer = frame.to_local(-direction);
    to_viewer.z = std::min(1.0, std::fabs(cosine));
    return bsdf.straight_transmittance(to_viewer);
}

void describe(const Level& level, Hit& hit, const MeshGeometry* mesh)
{
    const PartQueries& queries = *level.part;
    const Point at = level.origin + level.direction * hit.t;
    const Normals normals = surface_normals(queries, queries.part->surfaces[hit.surface], mesh, hit.triangle, at);
    hit.normal = normal_to_world(level, normals.geometric);
    hit.shading_normal = normal_to_world(level, normals.shading);
    hit.error_m = 0;
    for (const Level* l = &level; l != nullptr; l = l->outer) {
        const double reach = max_abs(l->origin) + hit.t * max_abs(l->direction);
        const double moved =
            l->instance != nullptr ? max_abs(l->instance->to_parent.translation) * l->outer->stretch : 0;
        hit.error_m = std::max(hit.error_m, reach * l->stretch + moved);
    }
    hit.error_m *= position_steps * std::numeric_limits<double>::epsilon();
    if (queries.varied->varies(hit.modifier))
        hit.to_part = into_part(level);
}

namespace {

/// The nearest surface wins; equal distances are decided by path, surface and triangle, so that the answer never
/// depends on the order of visits.
bool is_nearer(const Hit& best, double t, std::uint64_t path, std::uint32_t surface, std::uint32_t triangle)
{
    if (t != best.t)
        return t < best.t;
    if (best.part == nullptr)
        return true;
    return std::tie(path, surface, triangle) < std::tie(best.path, best.surface, best.triangle);
}

struct Candidate {
    std::uint32_t surface;
    const MeshGeometry* mesh;
    std::uint32_t triangle;
};

void record_passage(const Level& level, const Candidate& candidate, double t)
{
    const PartQueries& queries = *level.part;
    Trace& trace = *level.trace;
    const Surface& surface = queries.part->surfaces[candidate.surface];
    const ModifierId modifier = world_modifier(level, surface.modifier);
    const Material* material =
        modifier == void_modifier ? nullptr : (*queries.materials)[static_cast<std::size_t>(modifier)];
    if (material == nullptr)
        return;
    if (!(*queries.see_through)[static_cast<std::size_t>(modifier)]) {
        trace.opaque = true;
        return;
    }
    const Point at = level.origin + level.direction * t;
    const Normals normals = surface_normals(queries, surface, candidate.mesh, candidate.triangle, at);
    const Direction normal = normalized(normal_to_world(level, normals.geometric));
    const Level* root = &level;
    while (root->outer != nullptr)
        root = root->outer;
    Hit hit;
    hit.position = root->origin + root->direction * t;
    hit.normal = normal;
    hit.modifier = modifier;
    hit.path = level.path;
    hit.part = queries.part;
    hit.surface = candidate.surface;
    hit.triangle = candidate.triangle;
    const ModifierId alternate = (*queries.alternates)[static_cast<std::size_t>(modifier)];
    if (queries.varied->varies(modifier) || (alternate != void_modifier && queries.varied->varies(alternate)))
        hit.to_part = into_part(level);
    const double stretch = length(root->direction);
    const Spectrum passed = passage(hit, root->direction / stretch, t * stretch, queries, trace.illum_front);
    trace.opaque = passed.is_black();
    if (!trace.opaque)
        trace.passed->add(t, passed);
}

/// Whether the ray comes from behind to a surface that is seen from the front alone.
bool unseen_from_here(const Level& level, const Candidate& candidate, ModifierId modifier, double t)
{
    const PartQueries& queries = *level.part;
    if (!level.trace->backs_unseen || !(*queries.unseen_backs)[static_cast<std::size_t>(modifier)])
        return false;
    const Point at = level.origin + level.direction * t;
    const Normals normals =
        surface_normals(queries, queries.part->surfaces[candidate.surface], candidate.mesh, candidate.triangle, at);
    const Level* root = &level;
    while (root->outer != nullptr)
        root = root->outer;
    return dot(normal_to_world(level, normals.geometric), root->direction) > 0;
}

/// Keeps what is needed to describe the hit when the search is over: most candidates are beaten by nearer ones.
void record_hit(const Level& level, const Candidate& candidate, double t)
{
    Trace& trace = *level.trace;
    if (!is_nearer(*trace.hit, t, level.path, candidate.surface, candidate.triangle))
        return;
    const PartQueries& queries = *level.part;
    const ModifierId modifier = world_modifier(level, queries.part->surfaces[candidate.surface].modifier);
    if (modifier == void_modifier || (*queries.materials)[static_cast<std::size_t>(modifier)] == nullptr)
        return;
    if (unseen_from_here(level, candidate, modifier, t))
        return;
    Hit& best = *trace.hit;
    best.t = t;
    best.part = queries.part;
    best.surface = candidate.surface;
    best.triangle = candidate.triangle;
    best.path = level.path;
    best.modifier = modifier;
    trace.mesh = candidate.mesh;
    trace.t_max = t;
    if (level.instance != nullptr)
        describe(level, *trace.hit, candidate.mesh); // the levels are gone when the search is over
}

void record(const Level& level, const Candidate& candidate, double t)
{
    if (!(t > 0 && t <= level.trace->t_max)) // also NaN: no crossing
        return;
    if (level.trace->passed != nullptr)
        record_passage(level, candidate, t);
    else
        record_hit(level, candidate, t);
}

void descend(const Level& outer, const Leaf& leaf)
{
    const PartQueries& queries = *outer.part;
    const Instance& instance = queries.part->instances[leaf.index];
    const PlacedInstance& placed = queries.placed[leaf.index];
    const PartQueries& inner_queries = (*queries.prototypes)[instance.prototype];
    Level inner = make_level(inner_queries, *outer.trace, placed.to_local.point(outer.origin),
                             placed.to_local.vector(outer.direction));
    inner.outer = &outer;
    inner.instance = &instance;
    inner.path = instance_path(outer.path, leaf.surface);
    inner.stretch = outer.stretch * placed.stretch;
    run(inner_queries, inner);
}

const RayFrame& frame_of(const Level& level)
{
    if (!level.has_frame) {
        level.frame = RayFrame(level.origin, level.direction);
        level.has_frame = true;
    }
    return level.frame;
}

} // namespace

void test_leaf(const Level& level, const Leaf& leaf)
{
    const PartQueries& queries = *level.part;
    const Part& part = *queries.part;
    const Candidate candidate{leaf.surface, nullptr, 0};
    switch (leaf.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[leaf.index];
        const Point* corners = &part.points[polygon.first];
        record(level, candidate,
               flat_hit(frame_of(level), level.direction, queries.polygon_normals[leaf.index], corners[0],
                        polygon.count, [corners](std::size_t i) -> const Point& { return corners[i]; }));
        break;
    }
    case Shape::sphere:
    case Shape::bubble:
        for (const double t :
             sphere_hit(part.spheres[leaf.index], level.origin, level.direction, level.inverse_square).t)
            record(level, candidate, t);
        break;
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube:
        for (const double t : cone_hit(part.cones[leaf.index], level.origin, level.direction).t)
            record(level, candidate, t);
        break;
    case Shape::ring:
        record(level, candidate, ring_hit(part.rings[leaf.index], level.origin, level.direction));
        break;
    case Shape::instance:
        descend(level, leaf);
        break;
    case Shape::mesh:
    case Shape::source:
        break;
    }
}

void test_triangle(const Level& level, const MeshGeometry& geometry, std::uint32_t triangle)
{
    const Mesh& mesh = *level.part->part->meshes[level.part->part->surfaces[geometry.surface].index];
    const std::uint32_t* corner = &mesh.triangles[3 * std::size_t{triangle}];
    record(level, {geometry.surface, &geometry, triangle},
           flat_hit(frame_of(level), level.direction, geometry.face_normals[triangle], mesh.points[corner[0]], 3,
                    [&](std::size_t i) -> const Point& { return mesh.points[corner[i]]; }));
}

} // namespace lightwell
