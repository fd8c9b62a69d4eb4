#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace lightwell::test {
namespace {

using nlohmann::json;

const std::filesystem::path folder = std::filesystem::path{LIGHTWELL_ROOT} / "tests/fixtures/dxf";

json read_json(const std::string& name)
{
    std::ifstream in{folder / name};
    EXPECT_TRUE(in.good()) << name;
    return json::parse(in);
}

Point point_of(const json& numbers)
{
    return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

/// Surfaces of one shape in world coordinates, instances expanded under similarity maps.
struct Expanded {
    std::vector<Cone> cylinders, parts_of_cylinders;
    std::vector<Ring> rings;
    std::vector<std::vector<Point>> polygons;
};

/// @param layer  of which surfaces
Expanded expanded(const Imported& imported, const std::string& layer)
{
    Expanded found;
    visit_expanded(imported.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId id) {
        if (imported.keys.at(static_cast<std::size_t>(id)).layer != layer)
            return;
        const double scale = similarity_scale(map);
        if (surface.shape == Shape::polygon) {
            const Polygon& polygon = part.polygons[surface.index];
            std::vector<Point> corners;
            for (std::uint32_t i = 0; i < polygon.count; ++i)
                corners.push_back(map.point(part.points[polygon.first + i]));
            found.polygons.push_back(std::move(corners));
        } else if (surface.shape == Shape::cylinder || surface.shape == Shape::tube) {
            const Cone& c = part.cones[surface.index];
            const Vec3 axis = c.ends[1] - c.ends[0];
            (c.sector.is_whole() ? found.cylinders : found.parts_of_cylinders)
                .push_back({{map.point(c.ends[0]), map.point(c.ends[1])},
                            {c.radii[0] * scale, c.radii[1] * scale},
                            image_of(c.sector, normalized(axis), map, normalized(map.vector(axis)))});
        } else if (surface.shape == Shape::ring) {
            const Ring& r = part.rings[surface.index];
            found.rings.push_back(
                {map.point(r.centre), transform_normal(map, r.normal), r.inner_radius * scale, r.outer_radius * scale});
        }
    });
    return found;
}

double distance(const std::vector<Point>& a, const std::vector<Point>& b)
{
    double largest = a.size() == b.size() ? 0 : infinity;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, length(a[i] - b[i]));
    return largest;
}

/// The drawing and what it holds; lengths are compared within `within_m`.
struct ExactCase {
    std::string name;
    double within_m;
};

class DxfExactness : public testing::TestWithParam<ExactCase> {
protected:
    json truth = read_json(GetParam().name + ".exact.json");
    Imported imported = import_dxf(folder / (GetParam().name + ".dxf"), {});
    double within = GetParam().within_m;
};

TEST_P(DxfExactness, ThickCirclesAreCylindersWithEndsAndRadiiOfTheTruth)
{
    Expanded found = expanded(imported, "COLUMN");
    ASSERT_EQ(found.cylinders.size(), 1u);
    const Expanded group = expanded(imported, "GROUP");
    found.cylinders.insert(found.cylinders.end(), group.cylinders.begin(), group.cylinders.end());
    ASSERT_EQ(found.cylinders.size(), truth["cylinders"].size()); // 3 in the block, 6 copies, and one beside them
    ASSERT_EQ(found.cylinders.size(), 19u);
    for (const json& expected : truth["cylinders"]) {
        const std::vector<Point> ends{point_of(expected["ends"][0]), point_of(expected["ends"][1])};
        const auto cylinder =
            std::min_element(found.cylinders.begin(), found.cylinders.end(), [&](const Cone& a, const Cone& b) {
                return distance({a.ends[0], a.ends[1]}, ends) < distance({b.ends[0], b.ends[1]}, ends);
            });
        EXPECT_LE(distance({cylinder->ends[0], cylinder->ends[1]}, ends), within) << expected;
        const double radius = expected["radius"].get<double>();
        EXPECT_NEAR(cylinder->radii[0], radius, 1e-12 * radius);
        EXPECT_EQ(cylinder->radii[0], cylinder->radii[1]);
    }
}

TEST_P(DxfExactness, TwoHalfCirclesWithWidthAreARing)
{
    const Expanded found = expanded(imported, "RING");
    ASSERT_EQ(found.rings.size(), 1u);
    EXPECT_TRUE(found.polygons.empty());
    const json& expected = truth["rings"][0];
    EXPECT_LE(length(found.rings[0].centre - point_of(expected["centre"])), within);
    EXPECT_EQ(found.rings[0].normal, (Vec3{0, 0, 1}));
    EXPECT_NEAR(found.rings[0].inner_radius, expected["inner"].get<double>(), within);
    EXPECT_NEAR(found.rings[0].outer_radius, expected["outer"].get<double>(), within);
}

/// A point of the lower edge, by its share of the way along the arc.
Point point_of_arc(const Cone& wall, double along)
{
    const Frame frame = sector_frame(wall.sector, normalized(wall.ends[1] - wall.ends[0]));
    const double angle = wall.sector.sweep_rad * along;
    return wall.ends[0] + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * wall.radii[0];
}

/// How far a wall is from an arc of the truth: ends, either way round, middle and height.
double distance_from_arc(const Cone& wall, const json& arc)
{
    const Point a = point_of(arc["ends"][0]), b = point_of(arc["ends"][1]), middle = point_of(arc["middle"]);
    const std::vector<Point> found{point_of_arc(wall, 0), point_of_arc(wall, 0.5), point_of_arc(wall, 1)};
    const double off = std::min(distance(found, {a, middle, b}), distance(found, {b, middle, a}));
    return std::max(off, length(wall.ends[1] - wall.ends[0] - point_of(arc["height"])));
}

TEST_P(DxfExactness, BulgesAndArcsWithThicknessArePartsOfCylindersThroughThePointsOfTheTruth)
{
    const Expanded outline = expanded(imported, "BULGED"), group = expanded(imported, "GROUP");
    EXPECT_EQ(outline.polygons.size(), 2u); // the straight walls
    std::vector<Cone> walls = outline.parts_of_cylinders;
    walls.insert(walls.end(), group.parts_of_cylinders.begin(), group.parts_of_cylinders.end());
    ASSERT_EQ(walls.size(), 20u); // 2 bulges, 3 copies in the block, 6 of the block
    ASSERT_EQ(walls.size(), truth["arcs"].size());
    for (const json& arc : truth["arcs"]) {
        double nearest = infinity;
        for (const Cone& wall : walls)
            nearest = std::min(nearest, distance_from_arc(wall, arc));
        EXPECT_LE(nearest, within) << arc;
    }
    for (const Note& note : imported.report.notes())
        EXPECT_NE(note.finding, Finding::approximated) << note.text;
}

TEST_P(DxfExactness, NestedMirroredScaledAndArrayedCopiesStandWhereTheReferenceLibraryPutsThem)
{
    const Expanded found = expanded(imported, "GROUP");
    ASSERT_EQ(found.polygons.size(), 18u);
    ASSERT_EQ(found.polygons.size(), truth["polygons"].size());
    EXPECT_EQ(imported.scene.prototypes.size(), 2u);
    for (const json& expected : truth["polygons"]) {
        std::vector<Point> corners;
        for (const json& corner : expected)
            corners.push_back(point_of(corner));
        double nearest = infinity;
        for (const std::vector<Point>& polygon : found.polygons)
            nearest = std::min(nearest, distance(polygon, corners));
        EXPECT_LE(nearest, within) << expected;
    }
}

// Coordinates of some 10 m: 1e-12 of that. Far away the truth itself, in millimetres, has an ulp of 1.9e-9 m.
INSTANTIATE_TEST_SUITE_P(Places, DxfExactness, testing::Values(ExactCase{"exact", 1e-11}, ExactCase{"exact_far", 1e-8}),
                         [](const auto& test) { return test.param.name; });

TEST(DxfFarAway, TheSameBuildingHasTheSameSurfaces)
{
    const Imported near = import_dxf(folder / "exact.dxf", {}), far = import_dxf(folder / "exact_far.dxf", {});
    const Point offset = point_of(read_json("exact_far.exact.json")["offset_m"]);
    ASSERT_EQ(offset, (Point{1e7, -1e7, 0}));
    const auto here = layer_areas(near), there = layer_areas(far);
    ASSERT_EQ(here.size(), there.size());
    for (const auto& [layer, area] : here) {
        EXPECT_EQ(area.surfaces, there.at(layer).surfaces) << layer;
        EXPECT_NEAR(area.area_m2, there.at(layer).area_m2, 1e-7 * area.area_m2)
            << layer; // corners are rounded to 2e-9 m
    }
    const Part &a = near.scene.root, &b = far.scene.root;
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i)
        EXPECT_LT(length(a.points[i] + offset - b.points[i]), 1e-8) << i;
    EXPECT_EQ(near.report.notes().size(), far.report.notes().size());
}

std::size_t heap_bytes()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

TEST(DxfMemory, TenThousandInsertsKeepNoMoreThan200BytesEach)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer counts memory of its own";
#endif
    const auto kept = [](int copies, const std::string& layer) {
        const std::string block = "0 BLOCK 2 CHAIR 10 0 20 0 30 0 0 3DFACE 8 " + layer +
                                  " 10 0 20 0 30 0 11 1 21 0 31 0 12 1 22 1 32 0 0 ENDBLK";
        std::string inserts;
        for (int i = 0; i < copies; ++i)
            inserts +=
                "0 INSERT 5 " + std::to_string(1000 + i) + " 2 CHAIR 8 FURNITURE 10 " + std::to_string(i) + " 20 0 ";
        const TemporaryFile file{drawing(block, inserts)};
        inserts.clear();
        inserts.shrink_to_fit();
        const std::size_t before = heap_bytes();
        const Imported imported = import_dxf(file.path(), {});
        EXPECT_EQ(imported.scene.root.instances.size(), static_cast<std::size_t>(copies));
        EXPECT_EQ(imported.scene.prototypes.size(), 1u);
        return heap_bytes() - before;
    };
    for (const std::string layer : {"SEAT", "0"})
        EXPECT_LE(static_cast<double>(kept(10001, layer) - kept(1, layer)) / 10000, 200) << layer;
}

} // namespace
} // namespace lightwell::test
