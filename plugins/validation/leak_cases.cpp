#include "engine/accel/ray_queries.h"
#include "engine/base/random.h"
#include "engine/base/threads.h"
#include "plugins/validation/case.h"

#include <array>
#include <atomic>

namespace lightwell {
namespace {

const std::array<Point, 8> corners{
    {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 2.5}, {4, 0, 2.5}, {4, 3, 2.5}, {0, 3, 2.5}}};
constexpr std::uint32_t faces[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                       {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};

/// The box as six quadrilaterals or as twelve triangles, where it stands.
Scene box(bool triangles, const Affine& place)
{
    Scene scene;
    const ModifierId black = scene.add_material("black", Plastic{});
    Mesh mesh;
    for (const Point& corner : corners)
        mesh.points.push_back(place.point(corner));
    for (const auto& face : faces) {
        mesh.triangles.insert(mesh.triangles.end(), {face[0], face[1], face[2], face[0], face[2], face[3]});
        if (!triangles)
            scene.root.add_polygon(
                {mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]], mesh.points[face[3]]}, black,
                "face");
    }
    if (triangles)
        scene.root.add_mesh(std::make_shared<const Mesh>(std::move(mesh)), black, "box");
    return scene;
}

struct Variant {
    bool triangles;
    Affine place;
};

std::vector<Variant> variants()
{
    std::vector<Variant> all;
    const Affine turned = compose(Affine::rotate(2, std::sqrt(2.0)), Affine::rotate(0, std::sqrt(3.0)));
    for (const bool triangles : {false, true})
        for (const Affine& turn : {Affine{}, turned})
            for (const double scale : {1e-6, 1.0, 1e6})
                for (const double offset : {0.0, 1e6})
                    all.push_back({triangles, compose(Affine::translate({offset, -offset, 0.5 * offset}),
                                                      compose(Affine::scale(scale), turn))});
    return all;
}

/// A point well inside, and a target: anywhere around, on an edge, or at a corner, where leaks would be.
Ray ray_inside(const Affine& place, RandomStream& random)
{
    const double u = random.next(), v = random.next(), w = random.next();
    constexpr double margin = 0.01;
    const auto within = [](double t) { return margin + (1 - 2 * margin) * t; };
    const Point from{4 * within(u), 3 * within(v), 2.5 * within(w)};
    const auto bits = random.bits();
    const auto& face = faces[bits % 6];
    const Point &a = corners[face[(bits >> 8) % 4]], &b = corners[face[((bits >> 8) + 1) % 4]];
    Vec3 target;
    switch ((bits >> 16) % 4) {
    case 0: // the diagonal of the triangles
        target = corners[face[0]] + (corners[face[2]] - corners[face[0]]) * random.next();
        break;
    case 1:
        target = a + (b - a) * random.next();
        break;
    case 2:
        target = a;
        break;
    default:
        target = from + Vec3{2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1};
    }
    const Point start = place.point(from);
    return {start, place.point(target) - start, infinity};
}

std::size_t escapes(const Variant& variant, std::size_t rays, std::uint64_t key, int threads)
{
    constexpr std::size_t batch = 1 << 14;
    const Scene scene = box(variant.triangles, variant.place);
    const RayQueries queries(scene);
    std::atomic<std::size_t> escaped{0};
    parallel_for((rays + batch - 1) / batch, threads, [&](std::size_t i) {
        RandomStream random(key, 0, i);
        Hit hit;
        for (std::size_t n = i * batch; n < std::min(rays, (i + 1) * batch); ++n)
            escaped += queries.closest(ray_inside(variant.place, random), hit) ? 0 : 1;
    });
    return escaped;
}

ValidationRow count_escapes(const ValidationOptions& options)
{
    constexpr std::size_t quick_rays = 1000000, full_rays = 100000000;
    const std::vector<Variant> all = variants();
    const std::size_t rays = options.full ? full_rays : quick_rays, each = (rays + all.size() - 1) / all.size();
    std::size_t escaped = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        escaped += escapes(all[i], each, mix_bits(options.seed, i), options.threads);
    ValidationRow row;
    row.quantity = "escapes of " + std::to_string(each * all.size()) + " rays";
    row.unit = "rays";
    row.found = static_cast<double>(escaped);
    row.passed = escaped == 0;
    if (!row.passed)
        row.reason = "rays leave a closed box";
    return row;
}

/// The same in light: nothing of a bright sky may arrive.
Setup dark_inside(const Variant& variant)
{
    constexpr double luminance = 1e9;
    Check check{"illuminance inside", 0, 0, {{{variant.place.point({2, 1.5, 1.2}), {0, 0, 1}}, 1}}};
    return {[=](const Perturbation& p) {
                Scene scene = box(variant.triangles, variant.place);
                scene.root.add_source({{0, 0, 1}, 360}, scene.add_material("glow", p.surroundings(luminance)), "sky");
                return scene;
            },
            {check}};
}

} // namespace

std::vector<Case> leak_cases()
{
    Case light{"ext_light_leak", static_cast<unsigned>(Technique::sky)};
    const std::vector<Variant> all = variants();
    light.setups = {dark_inside(all.front()), dark_inside(all.back())};
    Case rays{"ext_light_leak"};
    rays.count = count_escapes;
    return {rays, light};
}

} // namespace lightwell
