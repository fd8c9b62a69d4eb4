#include "engine/base/errors.h"
#include "importers/dxf/geometry.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>

namespace lightwell::test {
namespace {

using dxf::arc_of_bulge;
using dxf::chord_count;
using dxf::chord_error;
using dxf::object_axes;

const std::string face = "0 3DFACE 5 2F 8 WALLS 10 0 20 0 30 0 11 4 21 0 31 0 12 4 22 0 32 3 13 0 23 0 33 3";

TEST(DxfGeometry, ObjectAxesFollowTheArbitraryAxisAlgorithm)
{
    // Worked by hand from the algorithm: below 1/64 in x and y the first axis comes from world y, else from world z.
    const Affine down = object_axes({0, 0, -5});
    EXPECT_EQ(down.x, (Vec3{-1, 0, 0}));
    EXPECT_EQ(down.y, (Vec3{0, 1, 0}));
    EXPECT_EQ(down.z, (Vec3{0, 0, -1}));
    const Affine along_x = object_axes({1, 0, 0});
    EXPECT_EQ(along_x.x, (Vec3{0, 1, 0}));
    EXPECT_EQ(along_x.y, (Vec3{0, 0, 1}));
    const Affine nearly_up = object_axes({1 / 65.0, 0, 1});
    EXPECT_NEAR(nearly_up.x.y, 0, 1e-15);
    const Affine just_beyond = object_axes({1 / 63.0, 0, 1});
    EXPECT_NEAR(just_beyond.x.y, 1, 1e-15);
    EXPECT_EQ(object_axes({0, 0, 0}).z, (Vec3{0, 0, 1}));
}

TEST(DxfGeometry, BulgesGiveTheCircleThroughTheCornersAndTheMiddleOfTheArc)
{
    for (const double bulge : {1.0, -1.0, 0.3, -2.5, 1e-4}) {
        SCOPED_TRACE(bulge);
        const Point from{3, -2, 7}, to{5, 4, 7};
        const auto arc = arc_of_bulge(from, to, bulge);
        EXPECT_LT(length(arc.at(0) - from), 1e-9);
        EXPECT_LT(length(arc.at(1) - to), 1e-9);
        // A bulge is the height of the arc over half its chord, to the right of the way for a positive one.
        const Vec3 chord = to - from, right = Vec3{chord.y, -chord.x, 0} / length(chord);
        const Point middle = (from + to) * 0.5 + right * (bulge * length(chord) / 2);
        EXPECT_LT(length(arc.at(0.5) - middle), 1e-9);
    }
}

TEST(DxfGeometry, ChordsStayWithinTheToleranceAndNoneIsTooMany)
{
    for (const double radius : {0.01, 1.0, 30.0})
        for (const double tolerance : {0.0005, 0.01}) {
            const double sweep_rad = 2;
            const int count = chord_count(radius, sweep_rad, tolerance);
            EXPECT_LE(chord_error(radius, sweep_rad, count), tolerance);
            const bool is_fewest = count == 3; // for 2 of 2 pi rad
            EXPECT_TRUE(is_fewest || chord_error(radius, sweep_rad, count - 1) > tolerance);
        }
    EXPECT_EQ(chord_count(1e30, 2 * pi, 1e-9), 4096);
}

TEST(DxfUnits, ComeFromTheOptionTheHeaderOrAnAssumptionThatIsReported)
{
    const auto with_header = [](const std::string& header) {
        return tags("0 SECTION 2 HEADER " + header + " 0 ENDSEC 0 SECTION 2 ENTITIES " + face + " 0 ENDSEC 0 EOF");
    };
    struct Case {
        std::string header, unit;
        double area_m2;
        bool is_assumed;
    };
    const Case cases[] = {
        {"9 $INSUNITS 70 6", "m (from $INSUNITS)", 12, false},
        {"9 $INSUNITS 70 4", "mm (from $INSUNITS)", 12e-6, false},
        {"9 $INSUNITS 70 2 9 $MEASUREMENT 70 1", "ft (from $INSUNITS)", 12 * 0.3048 * 0.3048, false},
        {"9 $MEASUREMENT 70 1", "m (assumed: in mm the model would be too small)", 12, true},
        {"9 $INSUNITS 70 0 9 $MEASUREMENT 70 0", "in (assumed: $MEASUREMENT is English)", 12 * 0.0254 * 0.0254, true},
        {"9 $INSUNITS 70 99", "m (assumed: in mm the model would be too small)", 12, true},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.header);
        const Imported imported = imported_text(with_header(c.header));
        EXPECT_EQ(imported.unit, c.unit);
        EXPECT_NEAR(layer_areas(imported).at("WALLS").area_m2, c.area_m2, 1e-12 * c.area_m2);
        EXPECT_EQ(imported.report.has(Finding::assumed), c.is_assumed);
    }
    ImportOptions options;
    options.metres_per_unit = 0.5;
    EXPECT_NEAR(layer_areas(imported_text(with_header(""), options)).at("WALLS").area_m2, 3, 1e-12);
}

TEST(DxfUnits, TurnsAFileWithYUpOntoItsFeet)
{
    ImportOptions options;
    options.up = "y";
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + face + " 0 ENDBLK";
    const Imported imported = imported_text(drawing(block, face + " 0 INSERT 2 B 10 0 20 5 30 0"), options);
    const Box box = exact_bounds(imported); // drawn x 0..4, y 0 and 5, z 0..3; y up means z = y, y = -z
    EXPECT_LT(length(box.low - Point{0, -3, 0}), 1e-12);
    EXPECT_LT(length(box.high - Point{4, 0, 5}), 1e-12);
}

TEST(DxfArcs, OfABandThatWidensStateTheErrorOfTheirFacetsInTheModelAlsoInsideScaledBlocks)
{
    // A half circle of radius 1 that widens to 0.02: its outer border is a little more than 1 away.
    const std::string arc = "0 LWPOLYLINE 8 A 90 2 70 0 10 -1 20 0 40 0 41 0.02 42 1 10 1 20 0";
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + arc + " 0 ENDBLK";
    ImportOptions options;
    options.chord_tolerance_m = 0.01;
    const auto facets = [&](const std::string& scale) {
        const Imported imported =
            imported_text(drawing(block, "0 INSERT 2 B 41 " + scale + " 42 " + scale + " 43 " + scale), options);
        const Part& part = imported.scene.prototypes.at(0);
        EXPECT_EQ(part.polygons.size(), 1u);
        return (part.polygons.at(0).count - 1) / 2; // two borders that meet at the start
    };
    // r (1 - cos(sweep / 2n)) <= 0.01 m for r = 1.01 m and r = 101 m
    EXPECT_EQ(facets("1"), static_cast<std::size_t>(std::ceil(pi / (2 * std::acos(1 - 0.01 / 1.01)))));
    EXPECT_EQ(facets("100"), static_cast<std::size_t>(std::ceil(pi / (2 * std::acos(1 - 0.0001 / 1.01)))));
}

TEST(DxfSolids, DrawnInTheOrderOfTheOutlineAreTheTwoTrianglesThatAreSeen)
{
    // Corners in the order of a rectangle make a bow tie: half the area, in two triangles.
    const Imported imported = imported_text(drawing("", "0 SOLID 8 S 10 0 20 0 11 4 21 0 12 4 22 3 13 0 23 3"));
    const LayerArea area = layer_areas(imported).at("S");
    EXPECT_EQ(area.surfaces, 2u);
    EXPECT_NEAR(area.area_m2, 6, 1e-12);
}

TEST(DxfPolylines, SkipTheControlPointsOfFittedCurves)
{
    const std::string line = "0 POLYLINE 8 P 66 1 70 4 39 2 "
                             "0 VERTEX 10 0 20 0 70 16 0 VERTEX 10 500 20 900 70 16 0 VERTEX 10 3 20 0 70 16 "
                             "0 VERTEX 10 0 20 0 70 8 0 VERTEX 10 3 20 0 70 8 0 SEQEND";
    const LayerArea area = layer_areas(imported_text(drawing("", line))).at("P");
    EXPECT_EQ(area.surfaces, 1u);
    EXPECT_NEAR(area.area_m2, 6, 1e-12);
}

TEST(DxfPolylines, StaySquareWhereAMitreWouldRunAway)
{
    // A fold of 1 degree: a mitre would reach 115 widths far.
    const Imported imported =
        imported_text(drawing("", "0 LWPOLYLINE 8 P 90 3 70 0 43 0.1 10 0 20 0 10 10 20 0 10 0 20 0.17453"));
    const Box box = exact_bounds(imported);
    EXPECT_LT(box.high.x, 10.1);
    EXPECT_NEAR(layer_areas(imported).at("P").area_m2, (10 + std::hypot(10, 0.17453)) * 0.1, 1e-9);
}

TEST(DxfThickSurfaces, FaceOutwards)
{
    // The volume from the divergence theorem is positive only when all normals point out of the body.
    const auto volume = [](const Imported& imported) {
        double six_volumes = 0;
        visit_expanded(imported.scene, [&](const Part& part, const Surface& surface, const Affine&, ModifierId) {
            const Polygon& polygon = part.polygons.at(surface.index);
            const Point* corners = &part.points[polygon.first];
            six_volumes += 2 * dot(polygon_area_vector(corners, polygon.count), corners[0]);
        });
        return six_volumes / 6;
    };
    const std::string corners = "10 1 20 1 11 3 21 1 12 1 22 2 13 3 23 2";
    EXPECT_NEAR(volume(imported_text(drawing("", "0 SOLID " + corners + " 39 5"))), 10, 1e-12);
    EXPECT_NEAR(volume(imported_text(drawing("", "0 SOLID " + corners + " 39 -5"))), 10, 1e-12);
    EXPECT_NEAR(volume(imported_text(drawing("", "0 SOLID " + corners + " 39 5 210 0 220 0 230 -1"))), 10, 1e-12);
    const std::string bar = "0 LWPOLYLINE 90 3 70 0 43 0.2 10 0 20 0 10 5 20 0 10 5 20 5";
    EXPECT_NEAR(volume(imported_text(drawing("", bar + " 39 3"))), 10 * 0.2 * 3, 1e-12);
    EXPECT_NEAR(volume(imported_text(drawing("", bar + " 39 -3"))), 10 * 0.2 * 3, 1e-12);
    const std::string frame = "0 LWPOLYLINE 90 4 70 1 43 0.2 10 0 20 0 10 5 20 0 10 5 20 5 10 0 20 5 39 1";
    EXPECT_NEAR(volume(imported_text(drawing("", frame))), 20 * 0.2, 1e-12);
}

/// A cube from -1 to 1 as MESH with two subdivision levels.
std::string smooth_cube(const std::string& crease)
{
    std::string text = "0 MESH 5 3A 8 M 100 AcDbSubdMesh 71 2 72 0 91 2 92 8 ";
    for (int i = 0; i < 8; ++i)
        text += "10 " + std::to_string(i & 1 ? 1 : -1) + " 20 " + std::to_string(i & 2 ? 1 : -1) + " 30 " +
                std::to_string(i & 4 ? 1 : -1) + " ";
    text += "93 30 ";
    for (const char* corners : {"0 2 3 1", "4 5 7 6", "0 1 5 4", "1 3 7 5", "3 2 6 7", "2 0 4 6"})
        text +=
            "90 4 90 " + std::string{corners}.replace(1, 1, " 90 ").replace(6, 1, " 90 ").replace(11, 1, " 90 ") + " ";
    text += "94 12 ";
    for (const char* edge : {"0 1", "2 3", "4 5", "6 7", "0 2", "1 3", "4 6", "5 7", "0 4", "1 5", "2 6", "3 7"})
        text += "90 " + std::string{edge}.replace(1, 1, " 90 ") + " ";
    text += "95 12 ";
    for (int i = 0; i < 12; ++i)
        text += "140 " + crease + " ";
    return text;
}

TEST(DxfMeshes, WithSubdivisionLevelsAreTheirLimitSurfaceAndKeepTheirCreases)
{
    // Catmull, Clark 1978: the middle of a face moves to (16 v + 4 e + f) / 36 with v = 1, e = 4 x 0.75, f = 4 x 5/9.
    const Imported smooth = imported_text(drawing("", smooth_cube("0")));
    const double middle = (16 + 12 + 20.0 / 9) / 36;
    EXPECT_NEAR(bounds(smooth.scene).high.x, middle, 0.0005);
    EXPECT_NEAR(bounds(smooth.scene).low.z, -middle, 0.0005);
    EXPECT_EQ(layer_areas(smooth).at("M").surfaces, 1u);
    EXPECT_TRUE(smooth.report.has(Finding::approximated));
    const Imported sharp = imported_text(drawing("", smooth_cube("-1"))); // never rounded: the cube itself
    EXPECT_NEAR(layer_areas(sharp).at("M").area_m2, 24, 1e-9);
}

} // namespace
} // namespace lightwell::test
