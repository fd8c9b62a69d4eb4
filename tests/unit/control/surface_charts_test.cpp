#include "engine/base/errors.h"
#include "engine/control/surface_charts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

double sum_of(const std::vector<double>& numbers)
{
    return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

SurfaceChart only_chart(const Scene& scene, double spacing)
{
    const std::vector<SurfaceChart> charts = surface_charts(scene, "*", spacing);
    EXPECT_EQ(charts.size(), 1u);
    return charts.front();
}

ModifierId paint(Scene& scene, const std::string& name = "paint")
{
    return scene.add_material(name, Plastic{Spectrum::grey(0.5)});
}

TEST(SurfaceCharts, ARectangleHasEvenTexelsAlongItsEdges)
{
    Scene scene;
    scene.root.add_polygon({{1, 2, 3}, {5, 2, 3}, {5, 4, 3}, {1, 4, 3}}, paint(scene), "floor");
    const SurfaceChart chart = only_chart(scene, 0.5);
    EXPECT_EQ(chart.columns, 8);
    EXPECT_EQ(chart.rows, 4);
    ASSERT_EQ(chart.sensors.size(), 32u);
    EXPECT_EQ(chart.id, "floor");
    EXPECT_EQ(chart.layer, "paint");
    EXPECT_NEAR(chart.sensors[0].position.x, 1.25, 1e-12);
    EXPECT_NEAR(chart.sensors[0].position.y, 2.25, 1e-12);
    EXPECT_NEAR(chart.sensors[0].position.z, 3, 1e-12);
    EXPECT_NEAR(chart.sensors[0].normal.z, 1, 1e-12);
    for (const double area : chart.areas_m2)
        EXPECT_NEAR(area, 0.25, 1e-12);
    EXPECT_NEAR(length(chart.across), 4, 1e-12);
    EXPECT_NEAR(length(chart.up), 2, 1e-12);
}

TEST(SurfaceCharts, ThePlaneOfAChartLeadsToItsSensors)
{
    Scene scene; // leaning, turned, far away
    scene.root.add_polygon({{100, 0, 0}, {103, 4, 0}, {99, 7, 5}, {96, 3, 5}}, paint(scene), "roof");
    const SurfaceChart chart = only_chart(scene, 0.3);
    for (int row = 0; row < chart.rows; ++row)
        for (int column = 0; column < chart.columns; ++column) {
            const int cell = chart.cells[static_cast<std::size_t>(row * chart.columns + column)];
            ASSERT_GE(cell, 0) << "a rectangle covers all of its texels";
            const Point middle =
                chart.corner + chart.across * ((column + 0.5) / chart.columns) + chart.up * ((row + 0.5) / chart.rows);
            EXPECT_LT(length(chart.sensors[static_cast<std::size_t>(cell)].position - middle), 1e-9);
        }
}

TEST(SurfaceCharts, AnOutlineWithAHoleKeepsItsAreaAndLeavesTheHoleOut)
{
    Scene scene;
    scene.root.add_polygon_with_holes({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
                                      {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}}, paint(scene), "wall");
    const SurfaceChart chart = only_chart(scene, 0.1);
    EXPECT_NEAR(sum_of(chart.areas_m2), 11, 1e-9);
    EXPECT_EQ(chart.sensors.size(), 1100u);
    for (const Sensor& sensor : chart.sensors)
        EXPECT_FALSE(sensor.position.x > 1 && sensor.position.x < 2 && sensor.position.y > 1 && sensor.position.y < 2);
}

TEST(SurfaceCharts, PartsOfRoundShapesHaveSensorsWithinTheirSector)
{
    const Sector quarter{{0, 1, 0}, pi / 2}; // x <= 0, y >= 0
    Scene cylinder, ring, disc;
    cylinder.root.add_cone({{{0, 0, 0}, {0, 0, 2}}, {3, 3}, quarter}, Shape::cylinder, paint(cylinder), "wall");
    ring.root.add_ring({{0, 0, 0}, {0, 0, 1}, 1, 3, quarter}, paint(ring), "ring");
    disc.root.add_ring({{0, 0, 0}, {0, 0, 1}, 0, 3, quarter}, paint(disc), "disc");
    for (const auto& [scene, area] :
         {std::pair{&cylinder, 3 * pi}, std::pair{&ring, 2 * pi}, std::pair{&disc, 9 * pi / 4}}) {
        const SurfaceChart chart = only_chart(*scene, 0.2);
        EXPECT_NEAR(sum_of(chart.areas_m2), area, 1e-9);
        EXPECT_GT(chart.sensors.size(), 100u);
        for (const Sensor& sensor : chart.sensors) {
            EXPECT_LE(sensor.position.x, 1e-9);
            EXPECT_GE(sensor.position.y, -1e-9);
        }
    }
}

TEST(SurfaceCharts, SensorsOfATriangleLieWithinIt)
{
    Scene scene;
    scene.root.add_polygon({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, paint(scene), "gable");
    const SurfaceChart chart = only_chart(scene, 0.25);
    EXPECT_NEAR(sum_of(chart.areas_m2), 3, 1e-12);
    for (const Sensor& sensor : chart.sensors) {
        const Point& p = sensor.position;
        EXPECT_TRUE(p.x > 0 && p.y > 0 && p.x / 3 + p.y / 2 < 1) << p.x << ' ' << p.y;
    }
}

TEST(SurfaceCharts, ASliverBetweenAllPlacesHasASensorInsideIt)
{
    Scene scene;
    scene.root.add_polygon({{0, 0, 0}, {1, 0.01, 0}, {1, 0.010001, 0}}, paint(scene), "sliver");
    const SurfaceChart chart = only_chart(scene, 5);
    ASSERT_EQ(chart.sensors.size(), 1u);
    EXPECT_NEAR(sum_of(chart.areas_m2), 0.5e-6, 1e-12);
    const Point& p = chart.sensors[0].position;
    EXPECT_TRUE(p.y > 0.01 * p.x && p.y < 0.010001 * p.x);
}

TEST(SurfaceCharts, RoundSurfacesHaveTheirAreaAndFaceOutwardsOrInwards)
{
    struct Case {
        Shape shape;
        double area;
        double side;
    };
    for (const auto& [shape, area, side] :
         {Case{Shape::sphere, 16 * pi, 1}, Case{Shape::bubble, 16 * pi, -1}, Case{Shape::cylinder, 12 * pi, 1},
          Case{Shape::tube, 12 * pi, -1}, Case{Shape::ring, 3 * pi, 1}}) {
        Scene scene;
        const ModifierId modifier = paint(scene);
        if (shape == Shape::ring)
            scene.root.add_ring({{0, 0, 0}, {0, 0, 1}, 1, 2}, modifier, "s");
        else if (shape == Shape::sphere || shape == Shape::bubble)
            scene.root.add_sphere({{0, 0, 0}, 2}, shape, modifier, "s");
        else
            scene.root.add_cone({{{0, 0, 0}, {0, 0, 3}}, {2, 2}}, shape, modifier, "s");
        const SurfaceChart chart = only_chart(scene, 0.2);
        EXPECT_NEAR(sum_of(chart.areas_m2), area, 1e-9);
        for (const Sensor& sensor : chart.sensors) {
            const Vec3 from_axis{sensor.position.x, sensor.position.y, 0};
            if (shape == Shape::ring) {
                EXPECT_TRUE(length(from_axis) > 0.99 && length(from_axis) < 2.01);
                EXPECT_NEAR(sensor.normal.z, 1, 1e-12);
            } else if (shape == Shape::sphere || shape == Shape::bubble) {
                EXPECT_NEAR(dot(sensor.position, sensor.normal), 2 * side, 1e-9);
            } else {
                EXPECT_NEAR(dot(from_axis, sensor.normal), 2 * side, 1e-9);
            }
        }
    }
}

TEST(SurfaceCharts, AConeFacesAwayFromItsAxisAtItsSlope)
{
    Scene scene;
    scene.root.add_cone({{{0, 0, 0}, {0, 0, 1}}, {2, 1}}, Shape::cone, paint(scene), "cone");
    const SurfaceChart chart = only_chart(scene, 0.1);
    EXPECT_NEAR(sum_of(chart.areas_m2), pi * 3 * std::sqrt(2), 1e-9);
    for (const Sensor& sensor : chart.sensors)
        EXPECT_NEAR(sensor.normal.z, std::sqrt(0.5), 1e-12);
}

TEST(SurfaceCharts, AFlatMeshIsOnePlaneAndABentOneATexelForEachTriangle)
{
    for (const double lift : {0.0, 1.0}) {
        Scene scene;
        auto mesh = std::make_shared<Mesh>();
        mesh->points = {{0, 0, 0}, {2, 0, 0}, {2, 2, lift}, {0, 2, 0}};
        mesh->triangles = {0, 1, 2, 0, 2, 3, 0, 0, 1};
        scene.root.add_mesh(mesh, paint(scene), "m");
        const SurfaceChart chart = only_chart(scene, 0.5);
        if (lift == 0) {
            EXPECT_EQ(chart.kind, SurfaceChart::Kind::plane);
            EXPECT_EQ(chart.sensors.size(), chart.cells.size());
            EXPECT_NEAR(sum_of(chart.areas_m2), 4, 1e-12);
        } else {
            EXPECT_EQ(chart.kind, SurfaceChart::Kind::triangles);
            EXPECT_EQ(chart.sensors.size(), 2u) << "the third has no area";
        }
    }
}

TEST(SurfaceCharts, InstancesAreNamedByTheirPathBoundAndTurnedToTheirFront)
{
    Scene scene;
    const ModifierId inherited = scene.add_modifier({"0", Inherited{}});
    Part part;
    part.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, inherited, "top");
    scene.prototypes.push_back(part);
    scene.root.add_instance({0, Affine::scale({-2, 2, 1}), {{inherited, paint(scene, "A-DESK/oak")}}}, "desk1");
    const std::vector<SurfaceChart> charts = surface_charts(scene, "A-DESK", 0.5);
    ASSERT_EQ(charts.size(), 1u);
    EXPECT_EQ(charts[0].id, "desk1/top");
    EXPECT_EQ(charts[0].layer, "A-DESK/oak");
    EXPECT_NEAR(sum_of(charts[0].areas_m2), 4, 1e-12);
    for (const Sensor& sensor : charts[0].sensors) {
        EXPECT_NEAR(sensor.normal.z, 1, 1e-12) << "a mirrored copy keeps its front";
        EXPECT_LT(sensor.position.x, 0);
    }
}

TEST(SurfaceCharts, RefuseWhatCannotBeMeant)
{
    Scene scene;
    scene.root.add_polygon({{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {0, 1000, 0}}, paint(scene), "site");
    EXPECT_THROW(surface_charts(scene, "*", 0.01), InputError) << "1e10 texels";
    EXPECT_THROW(surface_charts(scene, "*", 1e-300), InputError);
    EXPECT_THROW(surface_charts(scene, "roof", 1), InputError);
    for (const double spacing : {0.0, -1.0, std::nan(""), HUGE_VAL})
        EXPECT_THROW(surface_charts(scene, "*", spacing), InputError);
}

} // namespace
} // namespace lightwell
