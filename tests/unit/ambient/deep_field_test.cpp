#include "tests/unit/ambient/fake_rays.h"

#include "engine/sampling/statistics.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Places all over the sphere, on a spiral.
std::vector<SurfacePlace> sphere_places(int count)
{
    std::vector<SurfacePlace> places;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - 2 * (i + 0.5) / count, turn = pi * (3 - std::sqrt(5.0)) * i, s = std::sqrt(1 - z * z);
        places.push_back(SphereRays::place_at({s * std::cos(turn), s * std::sin(turn), z}));
    }
    return places;
}

DeepSettings settings_for(std::uint64_t seed = 1, int threads = 1)
{
    DeepSettings settings;
    settings.seed = seed;
    settings.threads = threads;
    return settings;
}

/// Direct light 1 everywhere: ambient light r / (1 - r), with no error at all, since every row sums to r.
TEST(DeepField, AUniformEnclosureIsExactAtAnyReflectance)
{
    for (const double absorbed : {0.8, 0.2, 1e-2, 1e-3, 1e-5}) {
        const double r = 1 - absorbed;
        DeepField deep;
        const SphereRays rays(&deep, r, [](const Point&) { return 1.0; });
        deep.place(sphere_places(500), rays, 2, settings_for());
        deep.solve_with(rays, settings_for());
        ASSERT_GT(deep.size(), 20u);
        for (std::uint32_t i = 0; i < deep.size(); ++i)
            for (int k = 0; k < replicates; ++k)
                EXPECT_NEAR(deep.ambient(i, k).g * absorbed / r, 1, 1e-7) << absorbed;
    }
}

/// Direct light 1 + 0.9 z: its mean over the sphere is 1, and the ambient light is as uniform as before.
TEST(DeepField, UnevenDirectLightInASphereGivesEvenAmbientLight)
{
    for (const double r : {0.5, 0.95}) {
        RunningStatistics of_seeds;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            DeepField deep;
            const SphereRays rays(&deep, r, [](const Point& p) { return 1 + 0.9 * p.z; });
            deep.place(sphere_places(500), rays, 2, settings_for(seed));
            deep.solve_with(rays, settings_for(seed));
            RunningStatistics all;
            for (std::uint32_t i = 0; i < deep.size(); ++i)
                for (int k = 0; k < replicates; ++k)
                    all.add(deep.ambient(i, k).g);
            of_seeds.add(all.mean());
        }
        const double expected = r / (1 - r);
        EXPECT_NEAR(of_seeds.mean(), expected, 6 * of_seeds.standard_error()) << r;
        EXPECT_LT(6 * of_seeds.standard_error(), 0.05 * expected) << r;
    }
}

/// Standard deviation, over seeds, of the mean ambient light on a sphere that is lit unevenly.
double noise_with(double work)
{
    RunningStatistics of_seeds;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        DeepField deep;
        const SphereRays rays(&deep, 0.5, [](const Point& p) { return 1 + 0.9 * p.z; });
        DeepSettings settings = settings_for(seed);
        settings.work = work;
        deep.place(sphere_places(200), rays, 2, settings);
        deep.solve_with(rays, settings);
        RunningStatistics all;
        for (std::uint32_t i = 0; i < deep.size(); ++i)
            for (int k = 0; k < replicates; ++k)
                all.add(deep.ambient(i, k).g);
        of_seeds.add(all.mean());
    }
    return of_seeds.standard_error() * 4;
}

TEST(DeepField, SixteenTimesTheWorkIsAtMostHalfTheNoise)
{
    EXPECT_LT(noise_with(16), noise_with(1) / 2);
}

/// Counts rays by the half of the sphere that they leave from.
class CountedRays : public SphereRays {
public:
    using SphereRays::SphereRays;
    Arrival arrive(const SurfacePlace& from, const Direction& direction, PathRandom& random,
                   std::vector<Dependence>& dependences) const override
    {
        ++(from.position.z > 0 ? upper : lower);
        return SphereRays::arrive(from, direction, random, dependences);
    }
    mutable int upper = 0, lower = 0;
};

/// Both halves have the same light; paths meet the upper one ten times as often.
TEST(DeepField, MoreWorkGoesToSitesThatPathsMeetMoreOften)
{
    std::vector<SurfacePlace> places = sphere_places(400);
    for (int n = 1; n < 10; ++n)
        for (const SurfacePlace& place : sphere_places(400))
            if (place.position.z > 0)
                places.push_back(place);
    DeepField deep;
    const CountedRays rays(&deep, 0.5, [](const Point& p) { return 1 + p.z * p.z; });
    deep.place(places, rays, 2, settings_for());
    deep.solve_with(rays, settings_for());
    const double first_look = static_cast<double>(rays.upper) / rays.lower; // as many rays a site
    DeepSettings more = settings_for();
    more.work = 8;
    const int all = rays.upper + rays.lower;
    rays.upper = rays.lower = 0;
    deep.refine(rays, more);
    EXPECT_GT(rays.upper, 3 * first_look * rays.lower);
    EXPECT_NEAR(rays.upper + rays.lower, more.work * all, 0.4 * more.work * all);
}

TEST(DeepField, WeightsSumToOneAndFollowAStraightLine)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point&) { return 1.0; };
    std::vector<SurfacePlace> places;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        PathRandom random(3, 3, i);
        const UnitSquare u = random.pair();
        places.push_back(CeilingRays::place_at(20 * u.u, 20 * u.v));
    }
    deep.place(places, rays, 40, settings_for());
    ASSERT_GT(deep.size(), 20u);
    const auto line = [](const Point& p) { return 5 + 2 * p.x - 3 * p.y; };
    double worst = 0;
    for (int i = 0; i < 400; ++i) {
        const Point at{3 + 0.7 * (i % 20), 3 + 0.7 * (i / 20), 0};
        DeepField::Weight found[DeepField::most_weights];
        const std::size_t count = deep.weights(at, {0, 0, 1}, found);
        ASSERT_GT(count, 0u) << at.x << ' ' << at.y;
        double sum = 0, value = 0;
        for (std::size_t k = 0; k < count; ++k) {
            sum += found[k].weight;
            value += found[k].weight * line(deep.sites()[found[k].site].position);
            EXPECT_GE(found[k].weight, -0.51);
        }
        EXPECT_NEAR(sum, 1, 1e-12);
        worst += std::fabs(value - line(at)) / 400;
    }
    // Sites lie about a metre apart: without the tilt of weights the line is missed by about this much.
    EXPECT_LT(worst, 0.15);
}

TEST(DeepField, WhereNoSiteIsNearNothingAnswers)
{
    DeepField deep;
    DeepField::Weight found[DeepField::most_weights];
    EXPECT_EQ(deep.weights({0, 0, 0}, {0, 0, 1}, found), 0u);
    const SphereRays rays(&deep, 0.5, [](const Point&) { return 1.0; });
    deep.place(sphere_places(100), rays, 2, settings_for());
    EXPECT_EQ(deep.weights({0, 0, 0}, {0, 0, 1}, found), 0u);
    const SurfacePlace known = sphere_places(100).front();
    EXPECT_EQ(deep.weights(known.position, -known.normal, found), 0u) << "the outside of the sphere";
    EXPECT_GT(deep.weights(known.position, known.normal, found), 0u);
}

TEST(DeepField, NoCandidatesGiveAnEmptyField)
{
    DeepField deep;
    const SphereRays rays(&deep, 0.5, [](const Point&) { return 1.0; });
    deep.place({}, rays, 2, settings_for());
    deep.solve_with(rays, settings_for());
    EXPECT_EQ(deep.size(), 0u);
    EXPECT_FALSE(deep.solved());
}

TEST(DeepField, NoMoreSitesThanAllowed)
{
    DeepField deep;
    const SphereRays rays(&deep, 0.5, [](const Point&) { return 1.0; });
    DeepSettings settings = settings_for();
    settings.most_sites = 7;
    deep.place(sphere_places(500), rays, 2, settings);
    EXPECT_EQ(deep.size(), 7u);
}

TEST(DeepField, TheNumberOfThreadsChangesNoBit)
{
    const auto build = [](int threads) {
        DeepField deep;
        const SphereRays rays(&deep, 0.9, [](const Point& p) { return 1 + 0.9 * p.z; });
        deep.place(sphere_places(700), rays, 2, settings_for(1, threads));
        deep.solve_with(rays, settings_for(1, threads));
        std::vector<Spectrum> all;
        for (std::uint32_t i = 0; i < deep.size(); ++i)
            for (int k = 0; k < replicates; ++k)
                all.push_back(deep.ambient(i, k));
        return all;
    };
    const std::vector<Spectrum> one = build(1);
    EXPECT_GT(one.size(), 100u);
    EXPECT_EQ(one, build(2));
    EXPECT_EQ(one, build(4));
}

TEST(DeepField, AnotherSeedGivesOtherNoise)
{
    DeepField a, b;
    const SphereRays from_a(&a, 0.9, [](const Point& p) { return 1 + 0.9 * p.z; });
    const SphereRays from_b(&b, 0.9, [](const Point& p) { return 1 + 0.9 * p.z; });
    a.place(sphere_places(200), from_a, 2, settings_for(1));
    a.solve_with(from_a, settings_for(1));
    b.place(sphere_places(200), from_b, 2, settings_for(2));
    b.solve_with(from_b, settings_for(2));
    EXPECT_NE(a.ambient(0, 0), b.ambient(0, 0));
    EXPECT_NE(a.ambient(0, 0), a.ambient(0, 1)) << "replicates have rays of their own";
}

/// A wall from 5 mm above the floor upwards: no site answers across that lies farther from it than four times the gap,
/// where light that passes under it is felt no more.
TEST(DeepField, DoesNotReachUnderADoor)
{
    CeilingRays rays;
    rays.radiance = [](const Point& p) { return p.x < 0 ? 100.0 : 0.0; };
    rays.wall_gap_m = 0.005;
    std::vector<SurfacePlace> places;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        PathRandom random(3, 4, i);
        const UnitSquare u = random.pair();
        places.push_back(CeilingRays::place_at(4 * u.u - 2, 4 * u.v));
    }
    DeepField deep;
    deep.place(places, rays, 10, settings_for());
    std::size_t answers = 0, across = 0;
    for (int i = 0; i < 800; ++i) {
        const Point at{(i % 2 == 0 ? 1 : -1) * (0.05 + 0.01 * (i % 20)), 0.5 + 3 * (i / 800.0), 0};
        DeepField::Weight found[DeepField::most_weights];
        const std::size_t count = deep.weights(at, {0, 0, 1}, found);
        for (std::size_t k = 0; k < count; ++k) {
            ++answers;
            const double x = deep.sites()[found[k].site].position.x;
            across += x * at.x < 0 && std::fabs(x) > 4 * rays.wall_gap_m ? 1 : 0;
        }
    }
    EXPECT_GT(answers, 400u);
    EXPECT_EQ(across, 0u);
}

} // namespace
} // namespace lightwell
