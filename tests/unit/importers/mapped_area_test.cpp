#include "importers/mapped_area.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

double area_of(const Part& part, const Affine& map)
{
    return mapped_area_m2(part, part.surfaces.at(0), map);
}

Part one_sphere(double radius)
{
    Part part;
    part.add_sphere({{1, 2, 3}, radius}, Shape::sphere, 0, "s");
    return part;
}

const Affine sheared{{2, 0.3, 0}, {0.5, 0.7, -0.2}, {0.1, 0, 3}, {10, 20, 30}};

TEST(MappedArea, PolygonsUnderShearMatchThePolygonOfTheImages)
{
    Part part;
    const std::vector<Point> corners{{0, 0, 0}, {2, 0, 1}, {2, 3, 1}, {0, 3, 0}};
    part.add_polygon(corners, 0, "p");
    std::vector<Point> images;
    for (const Point& corner : corners)
        images.push_back(sheared.point(corner));
    EXPECT_NEAR(area_of(part, sheared), length(polygon_area_vector(images.data(), images.size())), 1e-12);
}

TEST(MappedArea, MeshesUnderShearMatchTheTrianglesOfTheImages)
{
    auto mesh = std::make_shared<Mesh>();
    mesh->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh->triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    double expected = 0;
    for (std::size_t i = 0; i < mesh->triangles.size(); i += 3) {
        const Point a = sheared.point(mesh->points[mesh->triangles[i]]);
        expected += 0.5 * length(cross(sheared.point(mesh->points[mesh->triangles[i + 1]]) - a,
                                       sheared.point(mesh->points[mesh->triangles[i + 2]]) - a));
    }
    Part part;
    part.add_mesh(mesh, 0, "m");
    EXPECT_NEAR(area_of(part, sheared), expected, 1e-12);
}

TEST(MappedArea, SpheresBecomeEllipsoidsWithTheAreaOfTheClosedForms)
{
    // Prolate a a c (c > a): 2 pi a^2 (1 + c / (a e) asin e), e^2 = 1 - a^2 / c^2.
    for (const double c : {1.01, 2.0, 10.0, 1000.0}) {
        const double e = std::sqrt(1 - 1 / (c * c));
        const double expected = 2 * pi * (1 + c / e * std::asin(e));
        EXPECT_NEAR(area_of(one_sphere(1), Affine::scale(Vec3{1, 1, c})) / expected, 1, 1e-10) << c;
    }
    // Oblate a a c (c < a): 2 pi a^2 (1 + (1 - e^2) / e atanh e), e^2 = 1 - c^2 / a^2.
    for (const double c : {0.99, 0.5, 0.1, 1e-3}) {
        const double e = std::sqrt(1 - c * c);
        const double expected = 2 * pi * (1 + (1 - e * e) / e * std::atanh(e));
        EXPECT_NEAR(area_of(one_sphere(1), Affine::scale(Vec3{c, 1, 1})) / expected, 1, 1e-10) << c;
    }
}

TEST(MappedArea, ShearedSpheresMatchAFineQuadrature)
{
    // Midpoint rule over the directions: the image of an area vector is the matrix of cofactors times it.
    const Vec3 cx = cross(sheared.y, sheared.z), cy = cross(sheared.z, sheared.x), cz = cross(sheared.x, sheared.y);
    constexpr int rows = 2000, columns = 400;
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const double z = -1 + (i + 0.5) * 2 / rows, s = std::sqrt(1 - z * z), a = 2 * pi * k / columns;
            sum += length(cx * (s * std::cos(a)) + cy * (s * std::sin(a)) + cz * z);
        }
    EXPECT_NEAR(area_of(one_sphere(0.5), sheared) / (4 * pi * 0.25 * sum / (rows * columns)), 1, 1e-6);
}

TEST(MappedArea, CylindersAndConesMatchTheirFacetsInTheLimit)
{
    for (const auto& [r0, r1] : {std::pair{1.0, 1.0}, std::pair{1.0, 0.0}, std::pair{0.2, 0.7}}) {
        Part part;
        const Cone cone{{{0, 0, 0}, {1, 2, 2}}, {r0, r1}};
        part.add_cone(cone, Shape::cone, 0, "c");
        const Direction w = normalized(cone.ends[1] - cone.ends[0]);
        const Direction u = normalized(cross(w, Vec3{1, 0, 0})), v = cross(w, u);
        constexpr int facets = 20000;
        double expected = 0;
        for (int i = 0; i < facets; ++i) {
            const auto rim = [&](int end, int k) {
                const double angle = 2 * pi * k / facets;
                return sheared.point(cone.ends[end] + (u * std::cos(angle) + v * std::sin(angle)) * cone.radii[end]);
            };
            const Point a = rim(0, i), b = rim(0, i + 1), c = rim(1, i + 1), d = rim(1, i);
            expected += 0.5 * (length(cross(b - a, c - a)) + length(cross(c - a, d - a)));
        }
        EXPECT_NEAR(area_of(part, sheared) / expected, 1, 1e-7) << r0 << ' ' << r1;
    }
}

TEST(MappedArea, PartsOfACylinderAddUpToTheWhole)
{
    const Direction start{0, 1, 0};
    Part whole;
    whole.add_cone({{{0, 0, 0}, {0, 0, 2}}, {1, 1}}, Shape::cylinder, 0, "c");
    double sum = 0;
    for (const auto& [from, sweep] : {std::pair{0.0, 0.4}, std::pair{0.4, 2 * pi - 0.4}}) {
        Part part;
        part.add_cone({{{0, 0, 0}, {0, 0, 2}}, {1, 1}, {Affine::rotate(2, from).vector(start), sweep}}, Shape::cylinder,
                      0, "c");
        sum += area_of(part, sheared);
    }
    EXPECT_NEAR(sum / area_of(whole, sheared), 1, 1e-9);
}

TEST(MappedArea, RingsBecomeEllipticAnnuli)
{
    Part part;
    part.add_ring({{0, 0, 5}, {0, 0, 1}, 1, 2}, 0, "r");
    EXPECT_NEAR(area_of(part, Affine::scale(Vec3{3, 0.5, 7})), pi * (4 - 1) * 3 * 0.5, 1e-12);
}

TEST(MappedArea, SimilarityMapsScaleWithTheSquareMirroredOrNot)
{
    const Affine mirrored{{0, -2, 0}, {2, 0, 0}, {0, 0, -2}, {1e6, 0, 0}};
    EXPECT_NEAR(area_of(one_sphere(1), mirrored), 4 * 4 * pi, 1e-12);
}

TEST(MappedArea, ExtremeFlatteningKeepsSevenDigits)
{
    // A sphere flattened to a disc has the area of both sides of the disc.
    EXPECT_NEAR(area_of(one_sphere(1), Affine::scale(Vec3{1, 1, 1e-7})) / (2 * pi), 1, 1e-7);
    // Drawn out to a needle of length 2e7: pi^2 a c / ... the prolate closed form tends to pi^2 a c.
    EXPECT_NEAR(area_of(one_sphere(1), Affine::scale(Vec3{1, 1, 1e7})) / (pi * pi * 1e7), 1, 1e-7);
}

} // namespace
} // namespace lightwell
