// Rays on sphere fields: Lightwell's queries beside raw Embree user geometry in single precision, in one run.
// Prints, for 1e2 to 1e6 spheres, nanoseconds a ray of both (CPU time of one thread, best of five alternating runs),
// their ratio, the share of hits, and the exponents of time against number.

#include "engine/accel/ray_queries.h"
#include "engine/base/random.h"
#include "engine/sampling/warps.h"
#include "tests/bench/measure.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace lightwell;

/// The plainest use of Embree: float spheres as user geometry, nothing kept but the distance.
class RawEmbree {
public:
    explicit RawEmbree(const std::vector<Sphere>& spheres) : spheres_(spheres), device_(rtcNewDevice(nullptr))
    {
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres.size()));
        rtcSetGeometryUserData(geometry, const_cast<std::vector<Sphere>*>(&spheres_));
        rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~RawEmbree()
    {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    bool hit(const Ray& ray) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray.org_x = static_cast<float>(ray.origin.x);
        query.ray.org_y = static_cast<float>(ray.origin.y);
        query.ray.org_z = static_cast<float>(ray.origin.z);
        query.ray.dir_x = static_cast<float>(ray.direction.x);
        query.ray.dir_y = static_cast<float>(ray.direction.y);
        query.ray.dir_z = static_cast<float>(ray.direction.z);
        query.ray.tfar = std::numeric_limits<float>::infinity();
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }

private:
    static const Sphere& sphere(void* user, unsigned i) { return (*static_cast<const std::vector<Sphere>*>(user))[i]; }
    static void bounds_of(const RTCBoundsFunctionArguments* a)
    {
        const Sphere& s = sphere(a->geometryUserPtr, a->primID);
        const auto f = [](double v) { return static_cast<float>(v); };
        *a->bounds_o = {f(s.centre.x - s.radius), f(s.centre.y - s.radius), f(s.centre.z - s.radius), 0,
                        f(s.centre.x + s.radius), f(s.centre.y + s.radius), f(s.centre.z + s.radius), 0};
    }
    static void intersect(const RTCIntersectFunctionNArguments* a)
    {
        if (!a->valid[0])
            return;
        auto& query = *reinterpret_cast<RTCRayHit*>(a->rayhit);
        const Sphere& s = sphere(a->geometryUserPtr, a->primID);
        const float cx = static_cast<float>(s.centre.x) - query.ray.org_x,
                    cy = static_cast<float>(s.centre.y) - query.ray.org_y,
                    cz = static_cast<float>(s.centre.z) - query.ray.org_z, r = static_cast<float>(s.radius);
        const float dx = query.ray.dir_x, dy = query.ray.dir_y, dz = query.ray.dir_z;
        const float along = cx * dx + cy * dy + cz * dz;
        const float fx = dx * along - cx, fy = dy * along - cy, fz = dz * along - cz;
        const float room = r * r - (fx * fx + fy * fy + fz * fz);
        if (room < 0)
            return;
        const float half = std::sqrt(room), t = along - half > 0 ? along - half : along + half;
        if (t <= 0 || t >= query.ray.tfar)
            return;
        query.ray.tfar = t;
        query.hit.geomID = a->geomID;
        query.hit.primID = a->primID;
    }
    const std::vector<Sphere>& spheres_;
    RTCDevice device_;
    RTCScene scene_;
};

struct Field {
    std::vector<Sphere> spheres;
    std::vector<Ray> rays;
};

Field make_field(int count, int ray_count)
{
    // As many spheres as fill the unit cube so that about a fifth of the rays from inside meet one.
    Field field;
    RandomStream random(1, static_cast<std::uint64_t>(count), 0);
    const double radius = 0.62 * std::sqrt(1.0 / (pi * count));
    for (int i = 0; i < count; ++i)
        field.spheres.push_back({{random.next(), random.next(), random.next()}, radius});
    for (int i = 0; i < ray_count; ++i) {
        const Point origin{0.2 + 0.6 * random.next(), 0.2 + 0.6 * random.next(), 0.2 + 0.6 * random.next()};
        field.rays.push_back({origin, uniform_sphere(random.square()), infinity});
    }
    return field;
}

template <class Query>
double time_per_ray_ns(const std::vector<Ray>& rays, const Query& query, int& hits)
{
    const double start = cpu_seconds();
    hits = 0;
    for (const Ray& ray : rays)
        hits += query(ray) ? 1 : 0;
    return 1e9 * (cpu_seconds() - start) / static_cast<double>(rays.size());
}

} // namespace

int main()
{
    std::printf("%9s %12s %12s %7s %8s\n", "spheres", "raw ns/ray", "ours ns/ray", "ratio", "hits %");
    double first_raw = 0, first_ours = 0;
    int first_count = 0, count = 0;
    double raw = 0, ours = 0;
    for (count = 100; count <= 1000000; count *= 10) {
        const Field field = make_field(count, 200000);
        Scene scene;
        const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(0.5), 0, 0});
        for (const Sphere& sphere : field.spheres)
            scene.root.add_sphere(sphere, Shape::sphere, grey, "s");
        const RayQueries queries(scene);
        const RawEmbree embree(field.spheres);
        raw = ours = infinity;
        int raw_hits = 0, our_hits = 0;
        for (int run = 0; run < 5; ++run) {
            raw = std::min(raw, time_per_ray_ns(
                                    field.rays, [&](const Ray& ray) { return embree.hit(ray); }, raw_hits));
            ours = std::min(ours, time_per_ray_ns(
                                      field.rays,
                                      [&](const Ray& ray) {
                                          Hit hit;
                                          return queries.closest(ray, hit);
                                      },
                                      our_hits));
        }
        std::printf("%9d %12.0f %12.0f %7.2f %8.2f\n", count, raw, ours, ours / raw,
                    100.0 * our_hits / static_cast<double>(field.rays.size()));
        if (first_count == 0) {
            first_count = count;
            first_raw = raw;
            first_ours = ours;
        }
    }
    const double decades = std::log(count / 10.0 / first_count);
    std::printf("exponent: raw %.3f, ours %.3f\n", std::log(raw / first_raw) / decades,
                std::log(ours / first_ours) / decades);
    return EXIT_SUCCESS;
}
