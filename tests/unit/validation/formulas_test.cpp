#include "plugins/validation/cie_sky.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/lamp_formulas.h"
#include "plugins/validation/quadrature.h"
#include "plugins/validation/rectangle_factors.h"
#include "plugins/validation/room_formulas.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

// Each closed form against another way to the same number.

TEST(Quadrature, IntegratesPolynomialsOfTwiceItsDegreeExactly)
{
    for (const int count : {1, 2, 5, 12}) {
        const int degree = 2 * count - 1;
        double sum = 0;
        for (const QuadratureNode& node : gauss_legendre(count, 0, 2))
            sum += node.weight * std::pow(node.x, degree);
        EXPECT_NEAR(sum, std::pow(2.0, degree + 1) / (degree + 1), 1e-12 * std::pow(2.0, degree)) << count;
    }
}

/// The mean of Lambert's point values over the floor, on the sensors that the validation uses.
TEST(FormFactors, AreTheMeansOfLambertsPointValues)
{
    struct Rectangles {
        double x, y, z;
        bool parallel;
    };
    for (const Rectangles& r : {Rectangles{1, 1, 1, true}, Rectangles{2, 1, 0.5, true}, Rectangles{4, 3, 2.5, true},
                                Rectangles{1, 1, 1, false}, Rectangles{4, 4, 3, false}, Rectangles{2, 0.5, 3, false}}) {
        SCOPED_TRACE(testing::Message() << r.x << " " << r.y << " " << r.z << (r.parallel ? " parallel" : " upright"));
        const std::vector<Point> lamp =
            r.parallel ? std::vector<Point>{{0, 0, r.z}, {0, r.y, r.z}, {r.x, r.y, r.z}, {r.x, 0, r.z}}
                       : std::vector<Point>{{0, 0, 0}, {0, 0, r.z}, {r.x, 0, r.z}, {r.x, 0, 0}};
        double mean = 0;
        for (const QuadratureNode& x : gauss_legendre(12, 0, r.x))
            for (const QuadratureNode& y : gauss_legendre(12, 0, r.y))
                mean += x.weight * y.weight * polygon_illuminance(lamp, 1 / pi, {x.x, y.x, 0}, {0, 0, 1});
        const double expected =
            r.parallel ? parallel_rectangles(r.x, r.y, r.z) : perpendicular_rectangles(r.x, r.y, r.z);
        EXPECT_NEAR(mean / (r.x * r.y), expected, 2e-4 * expected);
    }
}

/// Rectangles anywhere along the axes: Lambert's point values over one of them, and a whole room, whose factors from
/// each side add up to 1.
TEST(FormFactors, BetweenRectanglesAnywhereAreTheMeansOfLambertsPointValues)
{
    const AxisRectangle floor{{0.2, 0.1, 0}, {1.1, 0.7, 0}, 2};
    const AxisRectangle above{{0.5, -0.3, 0.8}, {2, 0.4, 0.8}, 2}, beside{{1.5, 0.3, 0.2}, {1.5, 1.4, 0.9}, 0},
        before{{-0.5, -0.2, 0}, {0.6, -0.2, 0.5}, 1};
    for (const AxisRectangle& lamp : {above, beside, before}) {
        const int i = (lamp.axis + 1) % 3, k = (lamp.axis + 2) % 3;
        std::vector<Point> corners(4, lamp.low);
        corners[1][i] = corners[2][i] = lamp.high[i];
        corners[2][k] = corners[3][k] = lamp.high[k];
        double sum = 0;
        for (const QuadratureNode& x : gauss_legendre(16, floor.low.x, floor.high.x))
            for (const QuadratureNode& y : gauss_legendre(16, floor.low.y, floor.high.y))
                sum += x.weight * y.weight * std::fabs(polygon_illuminance(corners, 1 / pi, {x.x, y.x, 0}, {0, 0, 1}));
        EXPECT_NEAR(exchange_area(floor, lamp), sum, 1e-6) << lamp.axis;
        EXPECT_NEAR(exchange_area(lamp, floor), sum, 1e-6) << lamp.axis;
    }
    const AxisRectangle sides[] = {{{0, 0, 0}, {4, 3, 0}, 2}, {{0, 0, 2}, {4, 3, 2}, 2}, {{0, 0, 0}, {0, 3, 2}, 0},
                                   {{4, 0, 0}, {4, 3, 2}, 0}, {{0, 0, 0}, {4, 0, 2}, 1}, {{0, 3, 0}, {4, 3, 2}, 1}};
    double sum = 0;
    for (std::size_t side = 1; side < 6; ++side)
        sum += exchange_area(sides[0], sides[side]);
    EXPECT_NEAR(sum, 12, 1e-10);
}

TEST(FormFactors, OfDiscsAreTheMeansOfThePointValues)
{
    for (const auto& [r1, r2, h] : {std::tuple{1.0, 1.0, 1.0}, {0.5, 2.0, 1.0}, {3.0, 0.2, 0.7}}) {
        double mean = 0;
        for (const QuadratureNode& r : gauss_legendre(48, 0, 1))
            mean += 2 * r.x * r.weight * disc_illuminance(r2, h, r1 * r.x, 1 / pi);
        EXPECT_NEAR(mean, coaxial_discs(r1, r2, h), 1e-9) << r1;
    }
}

TEST(Disc, IsTheLimitOfAPolygonWithManyCorners)
{
    std::vector<Point> corners;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i)
        corners.push_back({std::cos(2 * pi * i / count), std::sin(2 * pi * i / count), 0.7});
    for (const double aside : {0.0, 0.5, 3.0})
        EXPECT_NEAR(disc_illuminance(1, 0.7, aside, 1000), polygon_illuminance(corners, 1000, {aside, 0, 0}, {0, 0, 1}),
                    1e-3)
            << aside;
}

/// The silhouette of a sphere is a circle; what of it lies above the horizon, as a polygon.
TEST(Sphere, CutByTheHorizonIsTheCutDiscOfItsSilhouette)
{
    for (const double radius : {0.2, 0.9}) {
        // The disc in which the tangent cone meets the plane z = 1.
        const double reach = radius / std::sqrt(1 - radius * radius);
        std::vector<Point> silhouette;
        constexpr int count = 8000;
        for (int i = 0; i < count; ++i)
            silhouette.push_back({reach * std::cos(2 * pi * i / count), reach * std::sin(2 * pi * i / count), 1});
        for (const double tilt : {0.0, 0.5, 1.2, 1.5, 1.6, 1.7}) {
            const double expected =
                polygon_illuminance(silhouette, 1000, {0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)});
            EXPECT_NEAR(sphere_illuminance(radius, 1, tilt, 1000), expected, 1e-3) << radius << " " << tilt;
        }
    }
}

TEST(Glass, TransmissivityGivesTheTransmittanceItCameFrom)
{
    for (const double t : {0.05, 0.5, 0.9})
        EXPECT_NEAR(pane_transmittance(pane_transmissivity(t, 1.52), 1.52, 0), t, 1e-14);
}

TEST(Prism, DeviatesLeastWhenTheRayRunsSymmetrically)
{
    const double apex = 1, index = 1.5, symmetric = std::asin(index * std::sin(0.5 * apex));
    const double least = through_prism(apex, index, symmetric).deviation_rad;
    EXPECT_NEAR(least, 2 * symmetric - apex, 1e-14);
    for (const double other : {symmetric - 0.1, symmetric + 0.1})
        EXPECT_GT(through_prism(apex, index, other).deviation_rad, least);
    EXPECT_TRUE(through_prism(apex, index, 0).total);
}

TEST(Corner, TendsToTheLimitInTheEdgeAndToTheDirectLightFarAway)
{
    const Corner corner(0.8, 0.6, 1, 1000);
    const double shared = 1000 / (1 - 0.25 * 0.8 * 0.6);
    EXPECT_NEAR(corner.on_floor(1e-7), shared * 1.3, 1);
    EXPECT_NEAR(corner.on_wall(1e-7), shared * 1.4, 1);
    EXPECT_NEAR(corner.on_floor(1e4), 1000, 1e-3);
}

/// Type 5 is the uniform sky, and the traditional overcast sky has a closed form.
TEST(Sky, GeneralSkiesWithoutDirectionGiveTheClosedForms)
{
    for (const double altitude : {0.4, 1.05}) {
        const Direction sun{0, -std::cos(altitude), std::sin(altitude)};
        for (const double tilt : {0.0, 0.9, 0.5 * pi}) {
            const Direction normal{std::sin(tilt), 0, std::cos(tilt)};
            EXPECT_NEAR(CieSkyFormula(5, sun).on_plane(normal), tilted_plane(SkyGradation::uniform, tilt), 1e-5);
            EXPECT_NEAR(CieSkyFormula(traditional_overcast, sun).on_plane(normal),
                        tilted_plane(SkyGradation::overcast, tilt), 1e-5);
        }
    }
}

/// Half a sphere of sky by summing small squares of it.
TEST(Sky, TiltedPlanesAgreeWithASumOverTheHemisphere)
{
    constexpr int rows = 800, columns = 1600;
    for (const double tilt : {0.0, 0.7, 1.5, 2.3}) {
        double uniform = 0, overcast = 0;
        for (int i = 0; i < rows; ++i)
            for (int k = 0; k < columns; ++k) {
                const double z = (i + 0.5) / rows, angle = 2 * pi * (k + 0.5) / columns, r = std::sqrt(1 - z * z);
                const double cosine = std::fmax(0, std::sin(tilt) * r * std::cos(angle) + std::cos(tilt) * z);
                uniform += cosine * 2 * pi / (rows * columns);
                overcast += (1 + 2 * z) / 3 * cosine * 2 * pi / (rows * columns);
            }
        EXPECT_NEAR(tilted_plane(SkyGradation::uniform, tilt), uniform, 1e-4) << tilt;
        EXPECT_NEAR(tilted_plane(SkyGradation::overcast, tilt), overcast, 1e-4) << tilt;
    }
    EXPECT_NEAR(sky_cone(SkyGradation::overcast, 0.5 * pi), 7 * pi / 9, 1e-14);
}

} // namespace
} // namespace lightwell
