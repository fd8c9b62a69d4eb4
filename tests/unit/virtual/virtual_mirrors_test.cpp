#include "engine/sources/virtual_mirrors.h"

#include "engine/base/random.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

ModifierId add_mirror_material(Scene& scene, double reflectance = 0.9)
{
    return scene.add_material("mirror", Mirror{Spectrum::grey(reflectance)});
}

/// Rays from random places: the ray queries and the mirror set must agree on which mirror a ray meets and where.
void expect_agrees_with_rays(const Scene& scene, const MirrorSet& set)
{
    const RayQueries rays(scene);
    RandomStream random(7);
    const auto somewhere = [&] { return Point{6 * random.next() - 3, 6 * random.next() - 3, 6 * random.next() - 3}; };
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point from = somewhere();
        const Ray ray{from, normalized(somewhere() - from)};
        Hit hit;
        const int by_rays = rays.closest(ray, hit) ? set.mirror_at(hit) : -1;
        int by_outline = -1;
        double nearest = infinity;
        for (std::size_t m = 0; m < set.mirrors().size(); ++m) {
            const PlanarMirror& mirror = set.mirrors()[m];
            const double t = -mirror.height_m(from) / dot(mirror.frame.z, ray.direction);
            if (t > 0 && t < nearest && set.holds(m, from + ray.direction * t)) {
                nearest = t;
                by_outline = static_cast<int>(m);
            }
        }
        ASSERT_EQ(by_rays, by_outline) << "ray " << i;
        met += by_rays >= 0 ? 1 : 0;
    }
    EXPECT_GT(met, 500);
}

TEST(MirrorSet, ConcaveOutlinesHolesRingsMeshesAndInstancesAreHitWhereRaysHitThem)
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene);
    scene.root.add_polygon_with_holes({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {0, 0.5, 0}, {-2, 2, 0}},
                                      {{{-1, -1, 0}, {0, -1, 0}, {0, 0, 0}, {-1, 0, 0}}}, mirror, "with hole");
    Part part;
    part.name = "part";
    part.add_ring({{0, 0, 1}, normalized({1, 1, 2}), 0.4, 1.2}, mirror, "ring");
    part.add_ring({{0, 0, 2.2}, {0, 0, 1}, 0, 1.5, {{0, 1, 0}, 4}}, mirror, "part of a disc");
    auto cube = std::make_shared<Mesh>();
    for (int i = 0; i < 8; ++i)
        cube->points.push_back({(i & 1) - 2.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) + 0.5});
    cube->triangles = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    part.add_mesh(cube, mirror, "cube");
    scene.prototypes.push_back(part);
    scene.root.add_instance({0, compose(Affine::rotate(1, 0.4), Affine::scale({-1, 0.6, 1.3})), {}}, "squeezed");
    validate(scene);
    const MirrorSet set(scene);
    EXPECT_EQ(set.mirrors().size(), 1u + 2u + 6u);
    EXPECT_TRUE(set.unreachable().empty());
    expect_agrees_with_rays(scene, set);
}

TEST(MirrorSet, AreasAreThoseOfTheWorld)
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene);
    Part part;
    part.name = "part";
    part.add_ring({{0, 0, 0}, {0, 0, 1}, 1, 2}, mirror, "ring");
    part.add_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, mirror, "triangle");
    scene.prototypes.push_back(part);
    scene.root.add_instance({0, Affine::scale({2, 3, 1}), {}}, "stretched");
    const MirrorSet set(scene);
    ASSERT_EQ(set.mirrors().size(), 2u);
    EXPECT_NEAR(set.mirrors()[0].area_m2, 3 * pi * 6, 1e-12);
    EXPECT_NEAR(set.mirrors()[1].area_m2, 3, 1e-12);
}

TEST(MirrorSet, CurvedMirrorsAreNamedWithAreaAndReflectance)
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene, 0.7);
    scene.root.add_sphere({{0, 0, 0}, 2}, Shape::sphere, mirror, "ball");
    scene.root.add_cone({{{5, 0, 0}, {5, 0, 3}}, {1, 1}}, Shape::cylinder, mirror, "column");
    auto bent = std::make_shared<Mesh>();
    bent->points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    bent->triangles = {0, 1, 2};
    bent->normals = {normalized({0.1, 0, 1}), {0, 0, 1}, {0, 0, 1}};
    scene.root.add_mesh(bent, mirror, "bent");
    auto flat = std::make_shared<Mesh>(*bent);
    flat->normals[0] = {0, 0, 1};
    scene.root.add_mesh(flat, mirror, "flat");
    const std::vector<UnreachableMirror> found = unreachable_mirrors(scene);
    ASSERT_EQ(found.size(), 3u);
    const std::pair<std::string, double> expected[] = {{"ball", 16 * pi}, {"column", 6 * pi}, {"bent", 2}};
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].name, expected[i].first);
        EXPECT_NEAR(found[i].area_m2, expected[i].second, 1e-9);
        EXPECT_EQ(found[i].reflectance, Spectrum::grey(0.7));
        EXPECT_TRUE(found[i].curved);
    }
    EXPECT_EQ(MirrorSet(scene).mirrors().size(), 1u);
}

TEST(MirrorSet, OfTooManyMirrorsTheSmallestAreLeftOutAndNamed)
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene);
    for (int i = 0; i < 100; ++i) {
        const double size = 0.1 + 0.01 * i;
        scene.root.add_polygon({{0, 0, 1.0 * i}, {size, 0, 1.0 * i}, {0, size, 1.0 * i}}, mirror, std::to_string(i));
    }
    const MirrorSet set(scene);
    EXPECT_EQ(set.mirrors().size(), 64u);
    ASSERT_EQ(set.unreachable().size(), 36u);
    for (const UnreachableMirror& left : set.unreachable()) {
        EXPECT_LT(std::stoi(left.name), 36);
        EXPECT_FALSE(left.curved);
    }
}

TEST(MirrorSet, AMillionMirrorsInAPrototypeAndMirrorsWithoutAreaDoNotStopIt)
{
    Scene scene;
    const ModifierId mirror = add_mirror_material(scene);
    Part part;
    part.name = "leaf";
    part.add_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, mirror, "line");
    part.add_polygon({{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}}, mirror, "scale");
    scene.prototypes.push_back(part);
    for (std::uint32_t level = 0; level < 4; ++level) {
        Part row;
        row.name = "row";
        for (int i = 0; i < 32; ++i)
            row.add_instance({level, Affine::translate({1.0 * i, 0, 1.0 * level}), {}}, "copy");
        scene.prototypes.push_back(row);
    }
    scene.root.add_instance({4, {}, {}}, "field");
    const MirrorSet set(scene);
    EXPECT_EQ(set.mirrors().size(), 64u);
    EXPECT_FALSE(set.complete());
    ASSERT_EQ(set.unreachable().size(), 1u) << "copies are listed together";
    EXPECT_GT(set.unreachable()[0].count, 100000u);
}

} // namespace
} // namespace lightwell
