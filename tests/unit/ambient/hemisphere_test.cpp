#include "engine/ambient/hemisphere.h"
#include "engine/sampling/path_random.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lightwell {
namespace {

using Seen = std::function<double(const Direction&, double& distance_m)>; ///< radiance, and how far away it is

/// @param jitter  false: the middle of each cell; true: a random place of it
Hemisphere sampled(const Frame& frame, int rows, int columns, const Seen& seen, bool jitter = false)
{
    Hemisphere h(frame, rows, columns);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            PathRandom random(5, static_cast<std::uint64_t>(row), static_cast<std::uint32_t>(column));
            const UnitSquare in = jitter ? random.pair() : UnitSquare{0.5, 0.5};
            const Direction d = hemisphere_direction(frame, {(row + in.u) / rows, (column + in.v) / columns});
            double distance = 0;
            h.radiance[h.at(row, column)] = Spectrum::grey(seen(d, distance));
            h.closeness_per_m[h.at(row, column)] = 1 / distance;
        }
    return h;
}

Frame upright()
{
    return frame_about({0, 0, 1});
}

/// From (at.x, at.y, 0) up to an endless ceiling with a radiance of its own at each place.
Seen ceiling(const Point& at, double height, const std::function<double(double x, double y)>& radiance)
{
    return [=](const Direction& d, double& distance) {
        distance = height / d.z;
        return radiance(at.x + d.x * distance, at.y + d.y * distance);
    };
}

double irradiance_of(const Hemisphere& h)
{
    double sum = 0;
    for (const Spectrum& s : h.radiance)
        sum += photopic(s);
    return pi * sum / static_cast<double>(h.radiance.size());
}

TEST(Hemisphere, CellsHaveEqualProjectedSolidAngleAndLieAboveTheSurface)
{
    const Frame tilted = frame_about(normalized({1, -2, 3}));
    double cosines = 0, squares = 0;
    constexpr int rows = 100, columns = 40;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const Direction d = hemisphere_direction(tilted, {(row + 0.5) / rows, (column + 0.5) / columns});
            const double cosine = dot(d, tilted.z);
            EXPECT_GT(cosine, 0);
            EXPECT_NEAR(length(d), 1, 1e-12);
            cosines += cosine / (rows * columns);
            squares += cosine * cosine / (rows * columns);
        }
    // Means of cos and cos^2 over a density of cos / pi.
    EXPECT_NEAR(cosines, 2.0 / 3, 1e-3);
    EXPECT_NEAR(squares, 1.0 / 2, 1e-3);
}

/// Endless ceiling at height h: r = h / cos, so that the mean of cos / h is 2 / (3 h). On the wall of a sphere of
/// radius 1: r = 2 cos, and the mean of 1 / (2 cos) is 1.
TEST(HarmonicDistance, IsOneAndAHalfOfTheHeightOfACeilingAndTheRadiusOfASphere)
{
    const Hemisphere under = sampled(upright(), 64, 128, ceiling({}, 2.5, [](double, double) { return 0; }));
    EXPECT_NEAR(harmonic_distance_m(under), 3.75, 1e-3);
    const Hemisphere inside = sampled(upright(), 4096, 8, [](const Direction& d, double& distance) {
        distance = 2 * d.z;
        return 0.0;
    });
    EXPECT_NEAR(harmonic_distance_m(inside), 1, 0.01);
    const Hemisphere open = sampled(upright(), 4, 8, [](const Direction&, double& distance) {
        distance = infinity;
        return 1.0;
    });
    EXPECT_EQ(harmonic_distance_m(open), infinity);
}

/// The floor of a cube of side 1 in its middle: 0.77768 m, by quadrature elsewhere.
TEST(HarmonicDistance, OfABoxIsThatOfTheTable)
{
    const Hemisphere box = sampled(upright(), 256, 256, [](const Direction& d, double& distance) {
        distance = std::min(1 / d.z, 0.5 / std::max(std::fabs(d.x), std::fabs(d.y)));
        return 0.0;
    });
    EXPECT_NEAR(harmonic_distance_m(box), 0.7776764658, 1e-4);
}

/// Ceiling of radiance a + b x: E = pi (a + b x), whatever the height.
TEST(Gradient, UnderACeilingOfLinearRadianceIsItsSlope)
{
    for (const double height : {0.5, 2.0}) {
        const auto seen = ceiling({}, height, [](double x, double y) { return 100 + 3 * x - 2 * y; });
        const IrradianceGradient g = gradient_of(sampled(upright(), 64, 200, seen));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(g.translation[c].x, 3 * pi, 0.02 * 3 * pi);
            EXPECT_NEAR(g.translation[c].y, -2 * pi, 0.02 * 2 * pi);
            EXPECT_NEAR(g.translation[c].z, 0, 1e-12);
        }
    }
}

TEST(Gradient, OfUniformLightIsNone)
{
    const Hemisphere h = sampled(upright(), 16, 32, ceiling({}, 2, [](double, double) { return 100; }));
    const IrradianceGradient g = gradient_of(h);
    EXPECT_LT(length(g.translation[1]), 1e-9);
    EXPECT_LT(length(g.rotation[1]), 1e-9);
    EXPECT_LT(std::fabs(hessian_of(h).value[0]), 0.01 * irradiance_of(h));
}

TEST(Gradient, TurnsWithTheFrame)
{
    const auto seen = ceiling({}, 2, [](double x, double y) { return 100 + 3 * x - 2 * y; });
    const double c = std::cos(0.7), s = std::sin(0.7);
    const IrradianceGradient g = gradient_of(sampled({{c, s, 0}, {-s, c, 0}, {0, 0, 1}}, 64, 200, seen));
    EXPECT_NEAR(g.translation[0].x, 3 * pi, 0.02 * 3 * pi);
    EXPECT_NEAR(g.translation[0].y, -2 * pi, 0.02 * 2 * pi);
}

/// Uniform sky, black ground, the surface tilted by b: E = pi L (1 + cos b) / 2, dE/db = -pi L sin b / 2.
TEST(Gradient, OfRotationUnderAnOpenSkyIsTheDerivativeOfTheClosedForm)
{
    for (const double degrees : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
        const double b = degrees * radians_per_degree;
        const Direction normal{std::sin(b), 0, std::cos(b)};
        const Hemisphere h = sampled(frame_about(normal), 128, 256, [](const Direction& d, double& distance) {
            distance = infinity;
            return d.z > 0 ? 1000.0 : 0.0;
        });
        const double e = b + 1e-3;
        const Vec3 turn = cross(normal, Direction{std::sin(e), 0, std::cos(e)});
        EXPECT_NEAR(dot(turn, gradient_of(h).rotation[1]) / 1e-3, -500 * pi * std::sin(b), 0.02 * 500 * pi) << degrees;
        EXPECT_NEAR(irradiance_of(h), 500 * pi * (1 + std::cos(b)), 0.01 * 1000 * pi) << degrees;
    }
}

/// A square lamp under a black ceiling: values, gradients and second derivatives from the table of techniques.
TEST(Gradient, UnderASquareIsThatOfTheTable)
{
    const char* folder = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path shared =
        folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path(LIGHTWELL_ROOT "/../shared");
    std::ifstream file(shared / "validation/techniques.json");
    if (!file)
        GTEST_SKIP() << "no table of techniques at " << shared;
    const nlohmann::json table = nlohmann::json::parse(file);
    int compared = 0;
    for (const auto& entry : table.at("cases")) {
        if (entry.at("id") != "ext_gradients_rect")
            continue;
        const double largest = 230.8, tolerance = entry.at("tolerance").at("accept_rel");
        for (const auto& sensor : entry.at("sensors")) {
            const auto& p = sensor.at("position");
            const auto& expected = entry.at("expected").at(sensor.at("id").get<std::string>());
            const Point at{p[0], p[1], p[2]};
            const auto lamp = [](double x, double y) {
                return std::fabs(x) < 0.5 && std::fabs(y) < 0.5 ? 1000.0 : 0.0;
            };
            const Hemisphere h = sampled(upright(), 256, 512, ceiling(at, 2 - at.z, lamp), true);
            const IrradianceGradient g = gradient_of(h);
            EXPECT_NEAR(irradiance_of(h), expected.at("E").get<double>(), tolerance * largest);
            for (int axis = 0; axis < 2; ++axis) {
                EXPECT_NEAR(g.translation[1][axis], expected.at("translational_gradient_xy")[axis].get<double>(),
                            tolerance * largest)
                    << sensor.at("id");
                EXPECT_NEAR(g.rotation[1][axis], expected.at("rotational_gradient_n_cross_F")[axis].get<double>(),
                            tolerance * largest)
                    << sensor.at("id");
            }
            ++compared;
        }
    }
    EXPECT_EQ(compared, 3);
}

/// Disc of radius R at height h, seen from r beside its axis, Q = (h^2 + R^2 + r^2)^2 - 4 r^2 R^2, N = h^2 - R^2 + r^2:
/// E = pi L / 2 (1 - N / sqrt(Q)). With s = r^2: dE/ds = -2 pi L R^2 h^2 / Q^1.5, d2E/ds2 = 6 pi L R^2 h^2 N / Q^2.5;
/// second derivatives 2 dE/ds + 4 s d2E/ds2 outwards and 2 dE/ds around.
struct DiscLight {
    double height, radius;

    void second_derivatives(double r, double& outwards, double& around) const
    {
        const double h2 = height * height, r2 = radius * radius, s = r * r;
        const double q = (h2 + r2 + s) * (h2 + r2 + s) - 4 * s * r2, n = h2 - r2 + s;
        const double first = -2 * pi * r2 * h2 / std::pow(q, 1.5), second = 6 * pi * r2 * h2 * n / std::pow(q, 2.5);
        outwards = 2 * first + 4 * s * second;
        around = 2 * first;
    }
};

TEST(Hessian, UnderADiscIsTheSecondDerivativeOfTheClosedForm)
{
    const DiscLight disc{1, 0.8};
    for (const double r : {0.0, 0.5, 1.5}) {
        SCOPED_TRACE(r);
        const Point at{r * std::cos(0.4), r * std::sin(0.4), 0};
        const auto seen = ceiling(
            at, disc.height, [&](double x, double y) { return x * x + y * y < disc.radius * disc.radius ? 1.0 : 0.0; });
        double outwards = 0, around = 0;
        disc.second_derivatives(r, outwards, around);
        const IrradianceHessian found = hessian_of(sampled(upright(), 64, 256, seen));
        const double larger = std::max(std::fabs(outwards), std::fabs(around));
        const bool outwards_first = std::fabs(outwards) > std::fabs(around);
        EXPECT_NEAR(found.value[0], outwards_first ? outwards : around, 0.1 * larger);
        EXPECT_NEAR(found.value[1], outwards_first ? around : outwards, 0.1 * larger);
        EXPECT_GE(std::fabs(found.value[0]), std::fabs(found.value[1]));
        if (r > 0) {
            const Direction principal = outwards_first ? normalized(at) : cross({0, 0, 1}, normalized(at));
            EXPECT_GT(std::fabs(dot(found.axis, principal)), std::cos(0.1));
        }
    }
}

/// A long lamp over the receiver: light changes across it, not along.
TEST(Hessian, ItsFirstAxisLiesAcrossALongLamp)
{
    for (const double turn : {0.0, 0.3, 1.2, 2.5}) {
        const Direction across{std::cos(turn), std::sin(turn), 0};
        const auto seen = ceiling(
            {}, 1, [&](double x, double y) { return std::fabs(x * across.x + y * across.y) < 0.3 ? 1.0 : 0.0; });
        const IrradianceHessian found = hessian_of(sampled(upright(), 64, 128, seen));
        EXPECT_GT(std::fabs(dot(found.axis, across)), std::cos(0.05)) << turn;
        // Strip |x| < a at height h: E = pi a / sqrt(a^2 + h^2) under its middle; d2E/dx2 = -3 pi a h^2 / (a^2 +
        // h^2)^2.5.
        EXPECT_NEAR(found.value[0], -3 * pi * 0.3 / std::pow(1.09, 2.5), 0.1 * 3 * pi * 0.3) << turn;
        EXPECT_LT(std::fabs(found.value[1]), 0.1 * std::fabs(found.value[0])) << turn;
    }
}

/// Lengths times k: second derivatives divided by k^2.
TEST(Hessian, DoesNotNoticeTheScale)
{
    const auto at_scale = [](double k) {
        return hessian_of(sampled(upright(), 32, 64, ceiling({}, k, [&](double x, double y) {
                                      return std::hypot(x - 0.4 * k, y) < 0.7 * k ? 1.0 : 0.0;
                                  })));
    };
    const IrradianceHessian one = at_scale(1);
    for (const double k : {1e-9, 1e9}) {
        EXPECT_NEAR(at_scale(k).value[0] * k * k / one.value[0], 1, 1e-6) << k;
        EXPECT_GT(std::fabs(dot(at_scale(k).axis, one.axis)), 1 - 1e-6) << k;
    }
}

TEST(Hessian, UnderAnOpenSkyIsNone)
{
    const IrradianceHessian found = hessian_of(sampled(upright(), 8, 16, [](const Direction& d, double& distance) {
        distance = infinity;
        return d.x;
    }));
    EXPECT_EQ(found.value[0], 0);
    EXPECT_EQ(found.value[1], 0);
}

} // namespace
} // namespace lightwell
