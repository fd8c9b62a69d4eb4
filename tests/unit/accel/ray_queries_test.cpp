#include "engine/accel/ray_queries.h"
#include "engine/base/random.h"
#include "engine/sampling/warps.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

ModifierId add_grey(Scene& scene)
{
    return scene.add_material("grey", Plastic{Spectrum::grey(0.5), 0, 0});
}

/// A closed box [0,4] x [0,3] x [0,3] of six polygons that share corners, placed by a map.
Scene closed_box(const Affine& place, bool as_triangles)
{
    Scene scene;
    const ModifierId grey = add_grey(scene);
    const Box box{{0, 0, 0}, {4, 3, 3}};
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(place.point(box.corner(i)));
    for (const auto& face : faces) {
        std::vector<Point> corners;
        for (const int i : face)
            corners.push_back(mesh.points[static_cast<std::size_t>(i)]);
        if (!as_triangles)
            scene.root.add_polygon(corners, grey, "face");
        for (const int i : {0, 1, 2, 0, 2, 3})
            mesh.triangles.push_back(static_cast<std::uint32_t>(face[i]));
    }
    if (as_triangles)
        scene.root.add_mesh(std::make_shared<Mesh>(std::move(mesh)), grey, "box");
    return scene;
}

Affine irrational_turn()
{
    return compose(Affine::rotate(0, std::sqrt(2.0)), compose(Affine::rotate(1, std::sqrt(3.0)), Affine::rotate(2, 1)));
}

int escapes(const Affine& place, bool as_triangles, int count)
{
    const Scene scene = closed_box(place, as_triangles);
    const RayQueries rays(scene);
    RandomStream random(7);
    int escaped = 0;
    for (int i = 0; i < count; ++i) {
        const Point inside{0.1 + 3.8 * random.next(), 0.1 + 2.8 * random.next(), 0.1 + 2.8 * random.next()};
        // Half of the rays aim at points of edges and corners, where leaks would be.
        Vec3 target{4 * random.next(), 3 * random.next(), 3 * random.next()};
        const auto snap = [&](double& value, double end) { value = random.next() < 0.5 ? 0 : end; };
        snap(target.x, 4);
        if (i % 2 == 0)
            snap(target.y, 3);
        if (i % 8 == 0)
            snap(target.z, 3);
        const Point origin = place.point(inside);
        Hit hit;
        escaped += !rays.closest({origin, place.point(target) - origin}, hit);
    }
    return escaped;
}

TEST(RayQueries, NoRayLeavesAClosedBoxOfPolygonsOrTriangles)
{
    for (const bool as_triangles : {false, true})
        for (const double size : {1e-6, 1.0, 1e6})
            for (const double offset : {0.0, 1e6}) {
                SCOPED_TRACE(testing::Message() << as_triangles << " " << size << " " << offset);
                const Affine place = compose(Affine::translate({offset, -offset, offset / 2}),
                                             compose(irrational_turn(), Affine::scale(size)));
                // At 1e6 m a box of 4e-6 m is 34,000 steps of the coordinates wide: still closed.
                EXPECT_EQ(escapes(place, as_triangles, 100000), 0);
            }
}

/// Nearest sphere by trying them all, in double.
int brute_force(const std::vector<Sphere>& spheres, const Ray& ray, double& nearest)
{
    int best = -1;
    nearest = infinity;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3 to_centre = spheres[i].centre - ray.origin;
        const double a = dot(ray.direction, ray.direction), along = dot(to_centre, ray.direction) / a;
        const Vec3 foot = ray.direction * along - to_centre;
        const double room = spheres[i].radius * spheres[i].radius - dot(foot, foot);
        if (room < 0)
            continue;
        for (const double t : {along - std::sqrt(room / a), along + std::sqrt(room / a)})
            if (t > 0 && t < nearest) {
                nearest = t;
                best = static_cast<int>(i);
            }
    }
    return best;
}

TEST(RayQueries, SphereFieldGivesTheHitsOfBruteForceNearAndFarFromTheOrigin)
{
    for (const double offset : {0.0, 1e5, 1e7}) {
        Scene scene;
        const ModifierId grey = add_grey(scene);
        RandomStream random(3);
        for (int i = 0; i < 2000; ++i) {
            const Sphere sphere{{offset + 10 * random.next(), offset + 10 * random.next(), 10 * random.next()},
                                0.02 + 0.2 * random.next()};
            scene.root.add_sphere(sphere, Shape::sphere, grey, "s");
        }
        const RayQueries rays(scene);
        int hits = 0;
        for (int i = 0; i < 3000; ++i) {
            const Ray ray{{offset + 10 * random.next(), offset + 10 * random.next(), 10 * random.next()},
                          uniform_sphere(random.square())};
            double t = 0;
            const int expected = brute_force(scene.root.spheres, ray, t);
            Hit hit;
            const bool found = rays.closest(ray, hit);
            ASSERT_EQ(found, expected >= 0);
            if (found) {
                EXPECT_EQ(static_cast<int>(hit.surface), expected);
                EXPECT_NEAR(hit.t, t, 4e-16 * (1 + offset) + 1e-15 * t);
                ++hits;
            }
        }
        EXPECT_GT(hits, 1000);
    }
}

TEST(RayQueries, NestedMirroredInstancesMeetTheSameSurfacesAsTheirExpansion)
{
    Scene scene;
    const ModifierId grey = add_grey(scene);
    Part leaf{"leaf", {}, {}, {}, {}, {}, {}, {}, {}, {}};
    leaf.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, grey, "quad");
    leaf.add_sphere({{0.5, 0.5, 0.4}, 0.2}, Shape::sphere, grey, "ball");
    Part twig{"twig", {}, {}, {}, {}, {}, {}, {}, {}, {}};
    const Affine inner = compose(Affine::translate({2, 0, 0.5}), compose(Affine::rotate(1, 0.7), Affine::scale(-1)));
    twig.add_instance({0, inner, {}}, "leaf");
    const Affine outer =
        compose(Affine::translate({-3, 2, 1}), compose(Affine::rotate(2, 1.1), Affine::scale({2, 0.5, 1.5})));
    scene.prototypes = {leaf, twig};
    scene.root.add_instance({1, outer, {}}, "twig");
    const Affine whole = compose(outer, inner);
    Scene flat;
    std::vector<Point> corners;
    for (const Point& p : leaf.points)
        corners.push_back(whole.point(p));
    flat.root.add_polygon(corners, add_grey(flat), "quad");
    const RayQueries nested(scene), expanded(flat);
    RandomStream random(5);
    const Box around = bounds(flat);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 to = around.low + Vec3{(around.high.x - around.low.x) * random.next(),
                                          (around.high.y - around.low.y) * random.next(),
                                          (around.high.z - around.low.z) * random.next()};
        const Direction direction = uniform_sphere(random.square());
        const Ray ray{to - direction * 10, direction};
        Hit a, b;
        const bool found = nested.closest(ray, a);
        if (expanded.closest(ray, b) && found && a.surface == 0) {
            EXPECT_NEAR(a.t, b.t, 1e-12 * b.t);
            EXPECT_NEAR(dot(a.normal, transform_normal(whole, {0, 0, 1})), 1, 1e-12);
            ++met;
        }
    }
    EXPECT_GT(met, 1000);
}

/// A cone and a ring, whole or in parts that make up the whole turn.
Scene round_scene(int parts)
{
    Scene scene;
    const ModifierId grey = add_grey(scene);
    const Direction axis = normalized({1, 2, -1});
    const Frame frame = frame_about(axis);
    for (int i = 0; i < parts; ++i) {
        const double from = 0.7 + 2 * pi * i / parts;
        const Sector sector =
            parts == 1 ? Sector{} : Sector{frame.x * std::cos(from) + frame.y * std::sin(from), 2 * pi / parts};
        scene.root.add_cone({{{0, 0, 0}, axis * 2}, {1, 0.4}, sector}, Shape::cone, grey, "cone");
        scene.root.add_ring({axis * 2.5, axis, 0.3, 1.1, sector}, grey, "ring");
    }
    return scene;
}

TEST(RayQueries, PartsThatMakeUpAWholeTurnAreMetWhereTheWholeIs)
{
    const Scene whole = round_scene(1), halves = round_scene(2), fifths = round_scene(5);
    const RayQueries rays(whole), rays_of_halves(halves), rays_of_fifths(fifths);
    RandomStream random(5);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point from{6 * random.next() - 3, 6 * random.next() - 3, 6 * random.next() - 3};
        const Ray ray{from, uniform_sphere(random.square())};
        Hit hit;
        const bool met = rays.closest(ray, hit);
        for (const RayQueries* parts : {&rays_of_halves, &rays_of_fifths}) {
            Hit part;
            ASSERT_EQ(parts->closest(ray, part), met) << i;
            if (met) {
                ASSERT_NEAR(part.t, hit.t, 1e-14) << i;
                ASSERT_LT(length(part.normal - hit.normal), 1e-14) << i;
            }
        }
        hits += met;
    }
    EXPECT_GT(hits, 1000);
}

TEST(RayQueries, NoRayLeavesABodyOfPartsOfRoundShapes)
{
    // A slice of a cheese: two plates, a mantle, and two flat cuts through the axis.
    for (const double sweep : {0.3, 2.0, pi, 5.0}) {
        SCOPED_TRACE(sweep);
        Scene scene;
        const ModifierId grey = add_grey(scene);
        const Affine place = irrational_turn();
        const Vec3 axis = place.z, start = place.x;
        const Vec3 end = place.vector({std::cos(sweep), std::sin(sweep), 0});
        const Sector sector{start, sweep};
        scene.root.add_cone({{{}, axis}, {2, 2}, sector}, Shape::cylinder, grey, "mantle");
        scene.root.add_ring({{}, axis, 0, 2, sector}, grey, "plate");
        scene.root.add_ring({axis, axis, 0, 2, sector}, grey, "lid");
        for (const Vec3& cut : {start, end})
            scene.root.add_polygon({{}, cut * 2, cut * 2 + axis, axis}, grey, "cut");
        validate(scene);
        const RayQueries rays(scene);
        RandomStream random(8);
        int escaped = 0;
        for (int i = 0; i < 100000; ++i) {
            const double angle = sweep * (0.1 + 0.8 * random.next());
            const Point inside = place.point({std::cos(angle), std::sin(angle), 0.5});
            Hit hit;
            escaped += !rays.closest({inside, uniform_sphere(random.square())}, hit);
        }
        EXPECT_EQ(escaped, 0);
    }
}

TEST(RayQueries, ShadowRaysMultiplyGlassAndStopAtWalls)
{
    Scene scene;
    const ModifierId grey = add_grey(scene), clear = scene.add_material("clear", Glass{Spectrum::grey(0.96), 1.52});
    const auto sheet = [&](double z, ModifierId modifier) {
        scene.root.add_polygon({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, modifier, "sheet");
    };
    sheet(1, clear);
    sheet(2, clear);
    sheet(3, grey);
    const RayQueries rays(scene);
    const double one = rays.transmittance({{0, 0, 0}, {0, 0, 1}, 1.5}).g;
    EXPECT_NEAR(one, 0.881, 0.002); // a 0.96 pane of index 1.52 passes 88.1 % at normal incidence
    EXPECT_NEAR(rays.transmittance({{0, 0, 0}, {0, 0, 1}, 2.5}).g, one * one, 1e-15);
    EXPECT_EQ(rays.transmittance({{0, 0, 0}, {0, 0, 1}, 3.5}).g, 0);
}

/// What `-bv-` does there, recorded with one ray each: a look from behind passes, a shadow ray is stopped by plastic
/// and passes the back of a pane without loss.
TEST(RayQueries, UnseenBacksLetLooksThroughAndStopShadowRaysWhereTheyAreOpaque)
{
    Scene scene;
    const ModifierId grey = add_grey(scene), clear = scene.add_material("clear", Glass{Spectrum::grey(0.5), 1.52});
    const auto sheet = [&](Part& part, double z, ModifierId modifier) {
        part.add_polygon({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, modifier, "sheet"); // its front is up
    };
    sheet(scene.root, 1, clear);
    sheet(scene.root, 2, grey);
    const RayQueries seen(scene), unseen(scene, BackFaces::unseen);
    const Ray up{{0, 0, 0}, {0, 0, 1}, infinity}, down{{0, 0, 3}, {0, 0, -1}, infinity};
    Hit hit;
    EXPECT_TRUE(seen.closest(up, hit));
    EXPECT_FALSE(unseen.closest(up, hit));
    EXPECT_TRUE(unseen.closest(down, hit));
    EXPECT_DOUBLE_EQ(hit.position.z, 2);
    EXPECT_EQ(unseen.transmittance({{0, 0, 0}, {0, 0, 1}, 1.5}).g, 1);
    EXPECT_LT(seen.transmittance({{0, 0, 0}, {0, 0, 1}, 1.5}).g, 0.5);
    EXPECT_EQ(unseen.transmittance({{0, 0, 1.5}, {0, 0, 1}, 1}).g, 0);
    // An instance that is mirrored keeps its front where its mirrored front is.
    Scene mirrored;
    Part part{"part", {}, {}, {}, {}, {}, {}, {}, {}, {}};
    sheet(part, 1, add_grey(mirrored));
    mirrored.prototypes.push_back(part);
    mirrored.root.add_instance({0, Affine::scale({-1, 1, 1}), {}}, "copy");
    const RayQueries of_copy(mirrored, BackFaces::unseen), of_copy_seen(mirrored);
    for (const Ray& ray : {up, down}) {
        ASSERT_TRUE(of_copy_seen.closest(ray, hit));
        EXPECT_EQ(of_copy.closest(ray, hit), dot(hit.normal, ray.direction) < 0);
    }
}

TEST(RayQueries, HolesBySeamsAndConcaveOutlinesLetRaysThrough)
{
    Scene scene;
    scene.root.add_polygon_with_holes({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                                      {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}}, add_grey(scene), "wall");
    const RayQueries rays(scene);
    Hit hit;
    EXPECT_FALSE(rays.closest({{1.5, 1.5, 1}, {0, 0, -1}}, hit));
    EXPECT_TRUE(rays.closest({{0.5, 1.5, 1}, {0, 0, -1}}, hit));
    EXPECT_TRUE(rays.closest({{3, 3, 1}, {0, 0, -1}}, hit));
    EXPECT_EQ(surface_area_m2(scene.root, scene.root.surfaces[0]), 15);
}

} // namespace
} // namespace lightwell
