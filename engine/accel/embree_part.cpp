#include "engine/accel/part_queries.h"
#include "engine/scene/expansion.h"

#include <embree3/rtcore.h>

#include <bit>

namespace lightwell {
namespace {

constexpr double float_step = 0x1p-23;
/// In a part's own frame coordinates are at most 1: the boxes grow by what rounding a ray to single precision can
/// move it across the part (origin, direction times path length, slab test: a dozen half steps).
constexpr double box_padding = 16 * float_step;

float float_t(const Level& level, double t)
{
    // A little too far is harmless (one more candidate), a little too near would lose a surface.
    const double scaled = (t - level.t_shift) * level.float_t_per_t;
    return static_cast<float>(std::min(scaled + std::fabs(scaled) * 4 * float_step + box_padding, 3e38));
}

/// Embree's own test of a box is over; the rest is ours.
void finish_callback(RTCRay& ray, const Level& level)
{
    if (level.trace->passed != nullptr) {
        if (level.trace->opaque)
            ray.tfar = -std::numeric_limits<float>::infinity();
    } else {
        ray.tfar = std::min(ray.tfar, float_t(level, level.trace->t_max));
    }
}

/// What Embree hands back to the callbacks.
struct EmbreeContext {
    RTCIntersectContext rtc; // first: Embree's pointer to it is a pointer to the whole
    const Level* level;
};

const Level& level_of(RTCIntersectContext* context)
{
    return *reinterpret_cast<const EmbreeContext*>(context)->level;
}

RTCRay& ray_of(const RTCIntersectFunctionNArguments* a)
{
    return reinterpret_cast<RTCRayHit*>(a->rayhit)->ray;
}
RTCRay& ray_of(const RTCOccludedFunctionNArguments* a)
{
    return *reinterpret_cast<RTCRay*>(a->ray);
}

template <class Arguments>
void leaf_callback(const Arguments* a)
{
    if (!a->valid[0])
        return;
    const Level& level = level_of(a->context);
    test_leaf(level, level.part->leaves[a->primID]);
    finish_callback(ray_of(a), level);
}

template <class Arguments>
void triangle_callback(const Arguments* a)
{
    if (!a->valid[0])
        return;
    const Level& level = level_of(a->context);
    test_triangle(level, *static_cast<const MeshGeometry*>(a->geometryUserPtr), a->primID);
    finish_callback(ray_of(a), level);
}

bool holds(const Box& box, const Point& p)
{
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.low.z &&
           p.z <= box.high.z;
}

/// The t at which the ray enters the box, in double; false when it misses it.
bool clip_to_box(const Box& box, const Point& origin, const Vec3& direction, double t_max, double& enter)
{
    enter = 0;
    if (holds(box, origin))
        return true;
    double low = 0, high = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1 / direction[axis];
        double t0 = (box.low[axis] - origin[axis]) * inverse, t1 = (box.high[axis] - origin[axis]) * inverse;
        if (t0 > t1)
            std::swap(t0, t1);
        // A NaN (0 * inf: the ray runs within the slab's face) leaves the bounds as they are.
        low = t0 > low ? t0 : low;
        high = t1 < high ? t1 : high;
    }
    enter = low;
    return low <= high;
}

/// 2^-floor(log2(x)), by the exponent's bits.
double inverse_power_of_two(double x)
{
    constexpr std::uint64_t bias_twice = 2046, exponent_bits = 52;
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(x) >> exponent_bits;
    return exponent == 0 || exponent >= bias_twice ? 1
                                                   : std::bit_cast<double>((bias_twice - exponent) << exponent_bits);
}

RTCBounds float_bounds(const PartQueries& queries, const Box& box)
{
    const Vec3 low = (box.low - queries.centre) * queries.scale, high = (box.high - queries.centre) * queries.scale;
    const auto down = [](double v) { return static_cast<float>(v - box_padding); };
    const auto up = [](double v) { return static_cast<float>(v + box_padding); };
    return {down(low.x), down(low.y), down(low.z), 0, up(high.x), up(high.y), up(high.z), 0};
}

void leaf_bounds(const RTCBoundsFunctionArguments* a)
{
    const auto& queries = *static_cast<const PartQueries*>(a->geometryUserPtr);
    const Surface& surface = queries.part->surfaces[queries.leaves[a->primID].surface];
    *a->bounds_o = float_bounds(queries, surface.shape == Shape::instance ? queries.instance_boxes[surface.index]
                                                                          : surface_bounds(*queries.part, surface));
}

void triangle_bounds(const RTCBoundsFunctionArguments* a)
{
    const auto& geometry = *static_cast<const MeshGeometry*>(a->geometryUserPtr);
    const Part& part = *geometry.part->part;
    const Mesh& mesh = *part.meshes[part.surfaces[geometry.surface].index];
    Box box;
    for (std::size_t i = 0; i < 3; ++i)
        box.extend(mesh.points[mesh.triangles[3 * std::size_t{a->primID} + i]]);
    *a->bounds_o = float_bounds(*geometry.part, box);
}

void attach(const PartQueries& queries, RTCDevice device, std::size_t count, void* user, RTCBoundsFunction bounds_of,
            RTCIntersectFunctionN intersect, RTCOccludedFunctionN occluded)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
    rtcSetGeometryUserData(geometry, user);
    rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(queries.embree, geometry);
    rtcReleaseGeometry(geometry);
}

void prepare_meshes(PartQueries& queries)
{
    for (std::uint32_t i = 0; i < queries.part->surfaces.size(); ++i) {
        const Surface& surface = queries.part->surfaces[i];
        if (surface.shape != Shape::mesh)
            continue;
        auto geometry = std::make_unique<MeshGeometry>();
        geometry->part = &queries;
        geometry->surface = i;
        const Mesh& mesh = *queries.part->meshes[surface.index];
        for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
            const Point& a = mesh.points[mesh.triangles[t]];
            geometry->face_normals.push_back(
                normalized(cross(mesh.points[mesh.triangles[t + 1]] - a, mesh.points[mesh.triangles[t + 2]] - a)));
        }
        queries.meshes.push_back(std::move(geometry));
    }
}

} // namespace

void run(const PartQueries& queries, Level& level)
{
    double enter = 0;
    if (queries.embree == nullptr ||
        !clip_to_box(queries.box, level.origin, level.direction, level.trace->t_max, enter))
        return;
    const double size = max_abs(level.direction);
    const double unit = inverse_power_of_two(size);
    level.t_shift = enter;
    level.float_t_per_t = queries.scale / unit;
    const Vec3 start = (level.origin + level.direction * enter - queries.centre) * queries.scale;
    const Vec3 along = level.direction * unit;
    EmbreeContext context;
    rtcInitIntersectContext(&context.rtc);
    context.level = &level;
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(start.x);
    query.ray.org_y = static_cast<float>(start.y);
    query.ray.org_z = static_cast<float>(start.z);
    query.ray.dir_x = static_cast<float>(along.x);
    query.ray.dir_y = static_cast<float>(along.y);
    query.ray.dir_z = static_cast<float>(along.z);
    query.ray.tnear = 0;
    query.ray.time = 0;
    query.ray.tfar = float_t(level, level.trace->t_max);
    query.ray.mask = ~0u;
    query.ray.id = 0;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    if (level.trace->passed != nullptr)
        rtcOccluded1(queries.embree, &context.rtc, &query.ray);
    else
        rtcIntersect1(queries.embree, &context.rtc, &query);
}

Level make_level(const PartQueries& queries, Trace& trace, const Point& origin, const Vec3& direction)
{
    return {&queries, &trace,  origin, direction, 1 / dot(direction, direction), RayFrame{}, false, 1.0, 0.0,
            nullptr,  nullptr, 0,      1.0};
}

void prepare_part(PartQueries& queries, const std::vector<Box>& prototype_boxes)
{
    const Part& part = *queries.part;
    queries.box = part_bounds(part, prototype_boxes);
    for (const Polygon& polygon : part.polygons)
        queries.polygon_normals.push_back(normalized(polygon_area_vector(&part.points[polygon.first], polygon.count)));
    for (const Instance& instance : part.instances) {
        const Affine& m = instance.to_parent;
        queries.placed.push_back({inverse(m), std::max(length(m.x), std::max(length(m.y), length(m.z)))});
        queries.instance_boxes.push_back(transform_box(m, prototype_boxes[instance.prototype]));
    }
    for (std::uint32_t i = 0; i < part.surfaces.size(); ++i) {
        const Surface& surface = part.surfaces[i];
        const bool empty_instance = surface.shape == Shape::instance && queries.instance_boxes[surface.index].empty();
        if (surface.shape != Shape::mesh && surface.shape != Shape::source && !empty_instance)
            queries.leaves.push_back({i, surface.index, surface.shape});
    }
    prepare_meshes(queries);
}

void build_part(PartQueries& queries, RTCDeviceTy* device)
{
    if (queries.box.empty())
        return;
    queries.centre = queries.box.centre();
    const double half = std::max(max_abs(queries.box.high - queries.centre), max_abs(queries.box.low - queries.centre));
    queries.scale = half > 0 ? std::ldexp(1.0, -std::ilogb(half) - 1) : 1;
    // The clip of rays to the box must not lose a surface that lies in the box's face.
    const Vec3 slack = Vec3{1, 1, 1} * (box_padding / queries.scale);
    queries.box.low = queries.box.low - slack;
    queries.box.high = queries.box.high + slack;
    queries.embree = rtcNewScene(device);
    rtcSetSceneFlags(queries.embree, RTC_SCENE_FLAG_ROBUST);
    if (!queries.leaves.empty())
        attach(queries, device, queries.leaves.size(), &queries, leaf_bounds,
               leaf_callback<RTCIntersectFunctionNArguments>, leaf_callback<RTCOccludedFunctionNArguments>);
    for (const auto& mesh : queries.meshes)
        attach(queries, device, mesh->face_normals.size(), mesh.get(), triangle_bounds,
               triangle_callback<RTCIntersectFunctionNArguments>, triangle_callback<RTCOccludedFunctionNArguments>);
    rtcCommitScene(queries.embree);
}

} // namespace lightwell
