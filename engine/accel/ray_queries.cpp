#include "engine/accel/ray_queries.h"

#include "engine/accel/flat_test.h"
#include "engine/accel/round_test.h"
#include "engine/base/random.h"
#include "engine/scene/expansion.h"
#include "materials/bsdf.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <stdexcept>
#include <tuple>

namespace lightwell {

std::uint64_t instance_path(std::uint64_t outer, std::uint32_t instance_surface) noexcept
{
    return mix_bits(outer, instance_surface + std::uint64_t{1});
}

namespace {

constexpr double float_step = 0x1p-23;
/// In a part's own frame coordinates are at most 1: the boxes grow by what rounding a ray to single precision can
/// move it across the part (origin, direction times path length, slab test: a dozen half steps).
constexpr double box_padding = 16 * float_step;
/// Steps of double precision by which a computed position may lie off its surface: two transformations, the
/// intersection, and as much again to be sure.
constexpr double position_steps = 64;

struct PartQueries;
struct MeshGeometry;

/// One surface of a Part as its leaf test sees it, so that the test touches as little memory as possible.
struct Leaf {
    std::uint32_t surface; ///< into Part::surfaces
    std::uint32_t index;   ///< into the array of its shape
    Shape shape;
};
struct PlacedInstance {
    Affine to_local;
    double stretch; ///< metres of the parent per metre of the prototype, at most
};

/// Transparent surfaces that a shadow ray passes, to be multiplied in order of distance: the product must not
/// depend on the order of visits. Beyond the room for that, the order costs the last bits.
class PassedSurfaces {
public:
    void add(double t, Spectrum transmittance)
    {
        if (count_ < room)
            passed_[count_++] = {t, transmittance.r, transmittance.g, transmittance.b};
        else
            overflow_ *= transmittance;
    }
    Spectrum product()
    {
        std::sort(passed_, passed_ + count_, [](const Passed& a, const Passed& b) { return a.t < b.t; });
        Spectrum left = overflow_;
        for (std::size_t i = 0; i < count_; ++i)
            left *= Spectrum{passed_[i].r, passed_[i].g, passed_[i].b};
        return left;
    }

private:
    struct Passed {
        double t, r, g, b;
    };
    static constexpr std::size_t room = 32;
    Passed passed_[room]; // not initialised: most shadow rays pass nothing
    std::size_t count_ = 0;
    Spectrum overflow_ = Spectrum::grey(1);
};

/// What all levels of one query share.
struct Trace {
    double t_max;
    Hit* hit = nullptr;
    const MeshGeometry* mesh = nullptr; ///< of the best hit
    bool opaque = false;
    PassedSurfaces* passed = nullptr; ///< of a transmittance query
};

/// One level of instancing within a query; Embree hands it back to the callbacks.
struct Level {
    RTCIntersectContext rtc; // first: Embree's pointer to it is a pointer to the Level
    const PartQueries* part;
    Trace* trace;
    Point origin;
    Vec3 direction;
    double inverse_square;  ///< 1 / |direction|^2
    mutable RayFrame frame; ///< made when the first flat surface is met
    mutable bool has_frame;
    double float_t_per_t, t_shift; ///< Embree's t = (t - shift) * factor
    const Level* outer;
    const Instance* instance; ///< that leads to this level; null in the root
    std::uint64_t path;
    double stretch; ///< world metres per metre of this level
};

struct MeshGeometry {
    const PartQueries* part;
    std::uint32_t surface;
    std::vector<Direction> face_normals;
};

struct PartQueries {
    const Scene* scene = nullptr;
    const Part* part = nullptr;
    RTCScene embree = nullptr;
    const std::vector<PartQueries>* prototypes = nullptr;
    const std::vector<std::uint8_t>* see_through = nullptr; ///< by modifier
    const std::vector<const Material*>* materials = nullptr;
    Box box;
    Point centre;
    double scale = 1; ///< power of two: (p - centre) * scale lies within [-1, 1]
    std::vector<Leaf> leaves;
    std::vector<Direction> polygon_normals;
    std::vector<PlacedInstance> placed; ///< by instance
    std::vector<Box> instance_boxes;
    std::vector<std::unique_ptr<MeshGeometry>> meshes;

    PartQueries() = default;
    PartQueries(const PartQueries&) = delete;
    PartQueries& operator=(const PartQueries&) = delete;
    PartQueries(PartQueries&& other) noexcept { *this = std::move(other); }
    PartQueries& operator=(PartQueries&&) noexcept = default;
};

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

float float_t(const Level& level, double t)
{
    // A little too far is harmless (one more candidate), a little too near would lose a surface.
    const double scaled = (t - level.t_shift) * level.float_t_per_t;
    return static_cast<float>(std::fmin(scaled + std::fabs(scaled) * 4 * float_step + box_padding, 3e38));
}

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
    const double cosine = dot(normal, normalized(root->direction));
    const Bsdf bsdf(*material, cosine < 0);
    const double c = std::fmin(1, std::fabs(cosine));
    trace.passed->add(t, bsdf.straight_transmittance({std::sqrt(1 - c * c), 0, c}));
}

/// Normals and error of a hit found at this level.
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
        hit.error_m = std::fmax(hit.error_m, reach * l->stretch + moved);
    }
    hit.error_m *= position_steps * std::numeric_limits<double>::epsilon();
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

void descend(const Level& outer, const Leaf& leaf);

const RayFrame& frame_of(const Level& level)
{
    if (!level.has_frame) {
        level.frame = RayFrame(level.origin, level.direction);
        level.has_frame = true;
    }
    return level.frame;
}

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

/// Embree's own test of a box is over; the rest is ours.
void finish_callback(RTCRay& ray, const Level& level)
{
    if (level.trace->passed != nullptr) {
        if (level.trace->opaque)
            ray.tfar = -std::numeric_limits<float>::infinity();
    } else {
        ray.tfar = std::fmin(ray.tfar, float_t(level, level.trace->t_max));
    }
}

const Level& level_of(RTCIntersectContext* context)
{
    return *reinterpret_cast<const Level*>(context);
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
    rtcInitIntersectContext(&level.rtc);
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
        rtcOccluded1(queries.embree, &level.rtc, &query.ray);
    else
        rtcIntersect1(queries.embree, &level.rtc, &query);
}

Level make_level(const PartQueries& queries, Trace& trace, const Point& origin, const Vec3& direction)
{
    return {{},  &queries, &trace,  origin, direction, 1 / dot(direction, direction), RayFrame{}, false, 1.0,
            0.0, nullptr,  nullptr, 0,      1.0};
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

void prepare_part(PartQueries& queries, const std::vector<Box>& prototype_boxes)
{
    const Part& part = *queries.part;
    queries.box = part_bounds(part, prototype_boxes);
    for (const Polygon& polygon : part.polygons)
        queries.polygon_normals.push_back(normalized(polygon_area_vector(&part.points[polygon.first], polygon.count)));
    for (const Instance& instance : part.instances) {
        const Affine& m = instance.to_parent;
        queries.placed.push_back({inverse(m), std::fmax(length(m.x), std::fmax(length(m.y), length(m.z)))});
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

void build_part(PartQueries& queries, RTCDevice device)
{
    if (queries.box.empty())
        return;
    queries.centre = queries.box.centre();
    const double half =
        std::fmax(max_abs(queries.box.high - queries.centre), max_abs(queries.box.low - queries.centre));
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

bool count_memory(void* counter, ssize_t bytes, bool)
{
    *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
    return true;
}

} // namespace

struct RayQueries::State {
    RTCDevice device = nullptr;
    std::atomic<std::int64_t> embree_bytes{0};
    std::vector<std::uint8_t> see_through;
    std::vector<const Material*> materials;
    std::vector<PartQueries> prototypes;
    PartQueries root;

    ~State()
    {
        for (PartQueries& queries : prototypes)
            if (queries.embree != nullptr)
                rtcReleaseScene(queries.embree);
        if (root.embree != nullptr)
            rtcReleaseScene(root.embree);
        if (device != nullptr)
            rtcReleaseDevice(device);
    }
    void link(PartQueries& queries, const Scene& scene, const Part& part)
    {
        queries.scene = &scene;
        queries.part = &part;
        queries.prototypes = &prototypes;
        queries.see_through = &see_through;
        queries.materials = &materials;
    }
};

RayQueries::RayQueries(const Scene& scene) : state_(std::make_unique<State>())
{
    State& state = *state_;
    state.device = rtcNewDevice(nullptr);
    if (state.device == nullptr)
        throw std::runtime_error("the ray tracing kernel could not be started");
    rtcSetDeviceMemoryMonitorFunction(state.device, count_memory, &state.embree_bytes);
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const Material* material = resolve(scene, static_cast<ModifierId>(i)).material;
        state.materials.push_back(material);
        state.see_through.push_back(material != nullptr && Bsdf(*material, true).lobes().transparent_to_shadows);
    }
    state.prototypes.resize(scene.prototypes.size());
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
        state.link(state.prototypes[i], scene, scene.prototypes[i]);
        prepare_part(state.prototypes[i], boxes);
        boxes.push_back(state.prototypes[i].box);
        build_part(state.prototypes[i], state.device);
    }
    state.link(state.root, scene, scene.root);
    prepare_part(state.root, boxes);
    build_part(state.root, state.device);
}

RayQueries::~RayQueries() = default;
RayQueries::RayQueries(RayQueries&&) noexcept = default;
RayQueries& RayQueries::operator=(RayQueries&&) noexcept = default;

bool RayQueries::closest(const Ray& ray, Hit& hit) const noexcept
{
    hit = Hit{};
    Trace trace{};
    trace.t_max = ray.t_max;
    trace.hit = &hit;
    Level level = make_level(state_->root, trace, ray.origin, ray.direction);
    run(state_->root, level);
    if (hit.part == nullptr)
        return false;
    if (hit.path == 0)
        describe(level, hit, trace.mesh);
    hit.position = ray.origin + ray.direction * hit.t;
    return true;
}

Spectrum RayQueries::transmittance(const Ray& ray) const noexcept
{
    PassedSurfaces passed;
    Trace trace{};
    trace.t_max = ray.t_max;
    trace.passed = &passed;
    Level level = make_level(state_->root, trace, ray.origin, ray.direction);
    run(state_->root, level);
    return trace.opaque ? Spectrum{} : passed.product();
}

std::size_t RayQueries::bytes() const noexcept
{
    std::size_t total = static_cast<std::size_t>(std::max<std::int64_t>(0, state_->embree_bytes));
    const auto add = [&](const PartQueries& queries) {
        total += queries.leaves.capacity() * sizeof(Leaf) + queries.polygon_normals.capacity() * sizeof(Direction) +
                 queries.placed.capacity() * sizeof(PlacedInstance) + queries.instance_boxes.capacity() * sizeof(Box);
        for (const auto& mesh : queries.meshes)
            total += mesh->face_normals.capacity() * sizeof(Direction);
    };
    for (const PartQueries& queries : state_->prototypes)
        add(queries);
    add(state_->root);
    return total;
}

} // namespace lightwell
