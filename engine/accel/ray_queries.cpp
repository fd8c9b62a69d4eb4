#include "engine/accel/ray_queries.h"

#include "engine/accel/part_queries.h"
#include "engine/accel/volumes.h"
#include "engine/base/random.h"
#include "engine/base/tally.h"
#include "materials/bsdf.h"
#include "materials/placed.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <stdexcept>

namespace lightwell {

std::uint64_t instance_path(std::uint64_t outer, std::uint32_t instance_surface) noexcept
{
    return mix_bits(outer, instance_surface + std::uint64_t{1});
}

namespace {

/// Surfaces that have a front alone where backs are not seen.
bool has_a_front(const Material& material) noexcept
{
    const auto* functional = std::get_if<Functional>(&material);
    return !(std::holds_alternative<Dielectric>(material) || std::holds_alternative<Interface>(material) ||
             std::holds_alternative<Mist>(material) || std::holds_alternative<Antimatter>(material) ||
             std::holds_alternative<Prism>(material) || std::holds_alternative<Measured>(material) ||
             std::holds_alternative<Wgmd>(material) ||
             (functional != nullptr && functional->kind == Functional::Kind::BRTDfunc));
}

bool count_memory(void* counter, ssize_t bytes, bool)
{
    *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
    return true;
}

/// What stands in place of an Illum for light that passes it; void: nothing.
ModifierId alternate_of(const Scene& scene, const Material* material)
{
    const auto* illum = material != nullptr ? std::get_if<Illum>(material) : nullptr;
    if (illum == nullptr || illum->alternate.empty() || illum->alternate == "void")
        return void_modifier;
    const ModifierId alternate = scene.find_modifier(illum->alternate);
    const Material* instead = alternate != void_modifier ? resolve(scene, alternate).material : nullptr;
    return instead == nullptr || std::holds_alternative<Illum>(*instead) ? void_modifier : alternate;
}

} // namespace

struct RayQueries::State {
    RTCDevice device = nullptr;
    std::atomic<std::int64_t> embree_bytes{0};
    std::vector<std::uint8_t> see_through, unseen_backs;
    BackFaces backs = BackFaces::seen;
    std::vector<const Material*> materials;
    std::vector<ModifierId> alternates;
    VariedMaterials varied;
    Volumes volumes;
    std::vector<PartQueries> prototypes;
    PartQueries root;

    explicit State(const Scene& scene) : varied(scene), volumes(scene) {}
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
        queries.unseen_backs = &unseen_backs;
        queries.materials = &materials;
        queries.alternates = &alternates;
        queries.varied = &varied;
    }
};

RayQueries::RayQueries(const Scene& scene, BackFaces backs) : state_(std::make_unique<State>(scene))
{
    State& state = *state_;
    state.backs = backs;
    state.device = rtcNewDevice(nullptr);
    if (state.device == nullptr)
        throw std::runtime_error("the ray tracing kernel could not be started");
    rtcSetDeviceMemoryMonitorFunction(state.device, count_memory, &state.embree_bytes);
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const auto id = static_cast<ModifierId>(i);
        state.materials.push_back(resolve(scene, id).material);
        state.alternates.push_back(alternate_of(scene, state.materials.back()));
        bool see_through = false;
        for (const Material* material : state.varied.possible(id))
            see_through |= material == nullptr || stands_for_geometry(*material) ||
                           std::holds_alternative<Illum>(*material) ||
                           Bsdf(*material, true).lobes().transparent_to_shadows;
        const Material* const material = state.materials.back();
        state.see_through.push_back(material != nullptr && see_through);
        state.unseen_backs.push_back(backs == BackFaces::unseen && material != nullptr && has_a_front(*material));
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
    ++rays_of_thread.followed;
    return nearest(ray, hit, state_->backs);
}

bool RayQueries::nearest(const Ray& ray, Hit& hit, BackFaces backs) const noexcept
{
    hit = Hit{};
    Trace trace{};
    trace.backs_unseen = backs == BackFaces::unseen;
    trace.t_max = ray.t_max;
    trace.hit = &hit;
    Level level = make_level(state_->root, trace, ray.origin, ray.direction);
    run(state_->root, level);
    if (hit.part == nullptr)
        return false;
    if (hit.path == 0)
        describe(level, hit, trace.mesh);
    hit.position = ray.origin + ray.direction * hit.t;
    hit.in = ray.in;
    return true;
}

const Volumes& RayQueries::volumes() const noexcept
{
    return state_->volumes;
}

namespace {

/// More surfaces than this behind one another are taken for the end of the way.
constexpr int most_passed = 1000;

} // namespace

InVolumes RayQueries::volumes_at(const Point& point) const noexcept
{
    const Volumes& volumes = state_->volumes;
    InVolumes around;
    if (!volumes.any())
        return around;
    // Which boundaries are left before they were entered.
    InVolumes entered;
    Ray ray{point, {0.2672612419124244, 0.5345224838248488, 0.8017837257372732}, infinity};
    Hit hit;
    for (int i = 0; i < most_passed && closest(ray, hit); ++i) {
        const bool entering = dot(hit.normal, ray.direction) < 0;
        if (volumes.bounds(hit.modifier)) {
            const InVolumes one = volumes.behind({}, hit.modifier, true);
            if (entering)
                entered.inside |= one.inside;
            else if ((entered.inside & one.inside) == 0)
                around.inside |= one.inside;
        }
        ray.origin = hit.leave(ray.direction);
    }
    return around;
}

/// A shadow ray where there are volumes: surface by surface.
Spectrum RayQueries::through_volumes(Ray ray, bool* illum_front) const noexcept
{
    const Volumes& volumes = state_->volumes;
    const double metres_per_t = length(ray.direction);
    Spectrum left = Spectrum::grey(1);
    for (int i = 0; i < most_passed && !left.is_black(); ++i) {
        Hit hit;
        ++rays_of_thread.followed;
        const bool met = nearest(ray, hit, BackFaces::seen);
        if (const Volumes::Haze haze = volumes.haze(ray.in); haze.thick())
            left *= left_by_haze(haze.extinction_per_m, (met ? hit.t : ray.t_max) * metres_per_t);
        if (!met)
            return left;
        const bool entering = dot(hit.normal, ray.direction) < 0;
        if (volumes.cut_face(ray.in, hit.modifier, entering) != void_modifier)
            return {};
        if (!volumes.bounds(hit.modifier) && !volumes.erased(ray.in, hit.modifier))
            left *= passage(hit, ray.direction / metres_per_t, hit.t * metres_per_t, state_->root, illum_front);
        ray.in = volumes.behind(ray.in, hit.modifier, entering);
        ray.origin = hit.leave(ray.direction);
        ray.t_max -= hit.t;
    }
    return {};
}

Spectrum RayQueries::transmittance(const Ray& ray, bool* illum_front) const noexcept
{
    ++rays_of_thread.shadow;
    if (state_->volumes.any())
        return through_volumes(ray, illum_front);
    PassedSurfaces passed;
    Trace trace{};
    trace.t_max = ray.t_max;
    trace.passed = &passed;
    trace.illum_front = illum_front;
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
