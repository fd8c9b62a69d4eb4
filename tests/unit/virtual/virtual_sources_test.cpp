#include "engine/direct/mirrored_light.h"

#include "engine/base/random.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

constexpr double lamp_radius = 0.3;

struct Prepared {
    Scene scene;
    RayQueries rays;
    SourceList sources;
    VirtualSources images;

    Prepared(Scene s, const VirtualSettings& settings)
        : scene(std::move(s)), rays(scene), sources(scene, rays), images(scene, sources, settings)
    {
    }
};

/// A lamp, a sun, and mirrors on the left, on the right, and below a table.
Scene three_mirrors()
{
    Scene scene;
    const ModifierId mirror = scene.add_material("mirror", Mirror{{0.9, 0.8, 0.7}});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(10)});
    scene.root.add_polygon({{-2, -1, 0}, {-2, 1, 0}, {-2, 1, 2}, {-2, -1, 2}}, mirror, "left");
    scene.root.add_polygon({{2, -1, 0}, {2, 1, 0}, {2, 1, 2}, {2, -1, 2}}, mirror, "right");
    scene.root.add_polygon({{5, 5, -1}, {6, 5, -1}, {6, 6, -1}, {5, 6, -1}}, mirror, "floor");
    scene.root.add_sphere({{0.5, 0, 1}, lamp_radius}, Shape::sphere, lamp, "lamp");
    scene.root.add_source({normalized({0.5, 0, 1}), 0.533}, lamp, "sun");
    return scene;
}

Reflections through(std::initializer_list<int> mirrors)
{
    Reflections reflections;
    for (const int m : mirrors)
        reflections.add(m);
    return reflections;
}

TEST(VirtualSources, ImagesStandWhereMirrorsShowThem)
{
    const Prepared p(three_mirrors(), {2});
    const int left = p.images.image_of(through({0}), false, 0);
    ASSERT_GE(left, 0);
    const VirtualSource& image = p.images.images()[static_cast<std::size_t>(left)];
    EXPECT_NEAR(length(image.ball.centre - Point{-4.5, 0, 1}), 0, 1e-12);
    // Seen in the left mirror, which shows the right one: the image of the image, 2 - (-2) = 4 to either side.
    const int both = p.images.image_of(through({0, 1}), false, 0);
    ASSERT_GE(both, 0);
    const VirtualSource& second = p.images.images()[static_cast<std::size_t>(both)];
    EXPECT_NEAR(length(second.ball.centre - Point{-7.5, 0, 1}), 0, 1e-12);
    const MirrorRoute& route = p.images.routes()[second.route];
    EXPECT_NEAR(route.reflectance.g, 0.64, 1e-12);
    EXPECT_NEAR(length(route.unfold.point({0, 0, 0}) - Point{8, 0, 0}), 0, 1e-12);
    EXPECT_EQ(p.images.image_of(through({0, 0}), false, 0), -1);
    EXPECT_EQ(p.images.image_of(through({0}), false, 1), -1);
    EXPECT_EQ(p.images.image_of(through({0, 1, 0}), false, 0), -1) << "beyond the depth";
}

/// Every way that light really takes from a lamp over mirrors must be in the table, and its volume must hold the point.
TEST(VirtualSources, CullingNeverDropsAWayThatLightTakes)
{
    RandomStream random(3);
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        const ModifierId mirror = scene.add_material("mirror", Mirror{Spectrum::grey(0.9)});
        const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(10)});
        const auto place = [&] { return Point{4 * random.next(), 4 * random.next(), 4 * random.next()}; };
        for (int i = 0; i < 6; ++i) {
            const Point a = place();
            scene.root.add_polygon({a, a + (place() - place()) * 0.5, a + (place() - place()) * 0.5}, mirror, "m");
        }
        scene.root.add_sphere({place(), 0.4}, Shape::sphere, lamp, "lamp");
        scene.root.add_source({normalized(place() - place()), 2}, lamp, "sun");
        const Prepared p(std::move(scene), {3});
        for (int i = 0; i < 20000; ++i) {
            const Point start = place();
            Ray ray{start, normalized(place() - place()), infinity};
            Reflections chain;
            Hit hit;
            bool is_sun = false, met = false;
            while (chain.count <= 3) {
                if (!p.rays.closest(ray, hit)) {
                    met = is_sun = p.sources.suns()[0].density_per_sr(ray.direction) > 0;
                    break;
                }
                const int m = p.images.mirrors().mirror_at(hit);
                if (m < 0) {
                    met = true;
                    break;
                }
                chain.add(m);
                const Direction onward =
                    p.images.mirrors().mirrors()[static_cast<std::size_t>(m)].reflect_vector(ray.direction);
                ray = {hit.leave(onward), onward, infinity};
            }
            if (!met || chain.count == 0 || chain.count > 3)
                continue;
            const int image = p.images.image_of(chain, is_sun, 0);
            ASSERT_GE(image, 0) << "round " << round << ", ray " << i;
            EXPECT_GT(p.images.potential(p.images.images()[static_cast<std::size_t>(image)], {start, {0, 0, 1}, true}),
                      0)
                << "round " << round << ", ray " << i;
        }
    }
}

TEST(VirtualSources, TheNumberOfImagesIsBoundedAndTheStrongestStay)
{
    Scene scene;
    const ModifierId mirror = scene.add_material("mirror", Mirror{Spectrum::grey(0.9)});
    for (int i = 0; i < 30; ++i)
        scene.root.add_polygon({{0.1 * i, -1, 0}, {0.1 * i, 1, 0}, {0.1 * i, 1, 2}, {0.1 * i, -1, 2}}, mirror, "m");
    for (int i = 0; i < 200; ++i)
        scene.root.add_sphere({{0.05 + 0.1 * (i % 29), 0, 5.0 + i}, 0.01}, Shape::sphere,
                              scene.add_material("lamp", Light{Spectrum::grey(i == 77 ? 1e6 : 1)}), "lamp");
    const Prepared p(std::move(scene), {4, 100});
    EXPECT_EQ(p.images.images().size(), 100u);
    EXPECT_GT(p.images.left_out(), 1000u);
    std::size_t of_the_strong = 0;
    for (const VirtualSource& image : p.images.images())
        of_the_strong += image.source == 77 ? 1 : 0;
    EXPECT_GE(of_the_strong, 60u);
}

TEST(VirtualSources, ASceneWithoutMirrorsOrWithoutDepthHasNone)
{
    Scene bare;
    bare.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, bare.add_material("lamp", Light{Spectrum::grey(1)}), "lamp");
    EXPECT_TRUE(Prepared(std::move(bare), {2}).images.empty());
    const Prepared off(three_mirrors(), {0});
    EXPECT_TRUE(off.images.empty());
    EXPECT_TRUE(off.images.mirrors().mirrors().empty());
}

TEST(MirrorChain, OnlyAWayOverMirrorsAloneFromAVertexThatGatheredIsAnswered)
{
    MirrorChain chain;
    chain.reflect(0);
    EXPECT_FALSE(chain.mirrored()) << "from the eye";
    chain.begin();
    EXPECT_FALSE(chain.mirrored()) << "straight from the vertex";
    chain.reflect(1);
    chain.reflect(0);
    EXPECT_TRUE(chain.mirrored());
    EXPECT_EQ(chain.reflections(), through({1, 0}));
    chain.reflect(-1);
    EXPECT_FALSE(chain.mirrored()) << "after a pane";
    chain.reflect(1);
    EXPECT_FALSE(chain.mirrored());
    chain.begin();
    for (int i = 0; i <= Reflections::most; ++i)
        chain.reflect(i % 2);
    EXPECT_FALSE(chain.mirrored()) << "longer than any in the table";
}

} // namespace
} // namespace lightwell
