#include "engine/ambient/ambient_cache.h"
#include "tests/unit/ambient/fake_rays.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

constexpr double room_m = 10;

std::vector<AmbientCandidate> floor_candidates(std::uint32_t count, double low_x, double high_x)
{
    std::vector<AmbientCandidate> candidates;
    for (std::uint32_t i = 0; i < count; ++i) {
        PathRandom random(3, 5, i);
        const UnitSquare u = random.pair();
        candidates.push_back({CeilingRays::place_at(low_x + (high_x - low_x) * u.u, 4 * u.v), 0});
    }
    return candidates;
}

CacheSettings settings_for(double accuracy, int rays, int threads = 1)
{
    CacheSettings settings;
    settings.accuracy = accuracy;
    settings.rays = rays;
    settings.threads = threads;
    return settings;
}

/// Generations at more and more places, as a picture grows them.
void grow_all(AmbientCache& cache, const std::vector<AmbientCandidate>& candidates, const HemisphereRays& rays,
              const CacheSettings& settings)
{
    for (std::size_t step = 64; step >= 1; step /= 4) {
        std::vector<AmbientCandidate> some;
        for (std::size_t i = 0; i < candidates.size(); i += step)
            some.push_back(candidates[i]);
        cache.grow(some, rays, room_m, settings);
    }
}

struct Deviation {
    double root_mean_square = 0, worst = 0;
    int missing = 0, asked = 0;
};
/// Of interpolated irradiance from the expected one, relative, along the floor.
Deviation deviation_of(const AmbientCache& cache, const std::function<double(double x, double y)>& expected)
{
    Deviation d;
    for (int i = 0; i < 2000; ++i) {
        const double x = -1.5 + 3 * (i % 50) / 50.0, y = 0.5 + 3 * (i / 50) / 40.0;
        CachedAmbient found;
        ++d.asked;
        if (!cache.irradiance({x, y, 0}, {0, 0, 1}, found)) {
            ++d.missing;
            continue;
        }
        const double off = std::fabs(photopic(found.irradiance) / expected(x, y) - 1);
        d.root_mean_square += off * off;
        d.worst = std::max(d.worst, off);
    }
    d.root_mean_square = std::sqrt(d.root_mean_square / std::max(1, d.asked - d.missing));
    return d;
}

/// Under the strip |x| < a of a ceiling at height h: E = pi / 2 (sin of the angles to both edges).
double strip_irradiance(double x, double half_m, double height_m)
{
    const auto sine = [&](double way) { return way / std::hypot(way, height_m); };
    return 0.5 * pi * (sine(half_m - x) + sine(half_m + x));
}

TEST(AmbientCache, AUniformCeilingIsExactEverywhere)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point&) { return 7.0; };
    AmbientCache cache(deep);
    grow_all(cache, floor_candidates(2000, -2, 2), rays, settings_for(0.2, 64));
    const Deviation d = deviation_of(cache, [](double, double) { return 7 * pi; });
    EXPECT_LT(d.worst, 1e-9);
    EXPECT_EQ(d.missing, 0);
    EXPECT_LT(cache.records().size(), 200u);
}

/// A wall of the enclosure's ambient light r / (1 - r): from the deep field through the records, still exact.
TEST(AmbientCache, AUniformEnclosureIsExactThroughTheDeepField)
{
    for (const double r : {0.5, 0.999}) {
        DeepField deep;
        const SphereRays rays(&deep, r, [](const Point&) { return 1.0; });
        std::vector<SurfacePlace> places;
        std::vector<AmbientCandidate> candidates;
        for (std::uint32_t i = 0; i < 1000; ++i) {
            PathRandom random(3, 6, i);
            const double z = 2 * random.one() - 1, turn = 2 * pi * random.one(), s = std::sqrt(1 - z * z);
            places.push_back(SphereRays::place_at({s * std::cos(turn), s * std::sin(turn), z}));
            candidates.push_back({places.back(), 0});
        }
        DeepSettings settings;
        settings.threads = 1;
        deep.place(places, rays, 2, settings);
        deep.solve_with(rays, settings);
        AmbientCache cache(deep);
        grow_all(cache, candidates, rays, settings_for(0.3, 64));
        int found_at = 0;
        for (const SurfacePlace& place : places) {
            CachedAmbient found;
            if (!cache.irradiance(place.position, place.normal, found))
                continue;
            ++found_at;
            EXPECT_NEAR(found.irradiance.g * (1 - r) / r, 1, 1e-5);
        }
        EXPECT_EQ(found_at, 1000);
    }
}

/// Interpolation stays within about the accuracy that was asked for, and finer is better.
TEST(AmbientCache, InterpolationBetweenRecordsStaysWithinItsAccuracy)
{
    CeilingRays rays;
    rays.radiance = [](const Point& p) { return std::fabs(p.x) < 0.5 ? 1.0 : 0.0; };
    const auto expected = [&](double x, double) { return strip_irradiance(x, 0.5, rays.height_m); };
    double before = 1;
    std::size_t records = 0;
    int rays_a_record = 512; // more of them for more accuracy: the noise must fall with the distance between records
    for (const double accuracy : {0.3, 0.1, 0.03}) {
        DeepField deep;
        AmbientCache cache(deep);
        grow_all(cache, floor_candidates(6000, -2, 2), rays, settings_for(accuracy, rays_a_record));
        const Deviation d = deviation_of(cache, expected);
        EXPECT_LT(d.root_mean_square, accuracy / 2) << accuracy;
        EXPECT_LT(d.worst, 1.5 * accuracy) << accuracy;
        EXPECT_EQ(d.missing, 0) << accuracy;
        EXPECT_LT(d.root_mean_square, before) << accuracy;
        EXPECT_GT(cache.records().size(), records) << accuracy;
        before = d.root_mean_square;
        records = cache.records().size();
        rays_a_record *= 4;
    }
}

/// Paper, Section 3.2: with gradients the same records serve better.
TEST(AmbientCache, GradientsLowerTheErrorAtTheSameRecords)
{
    CeilingRays rays;
    rays.radiance = [](const Point& p) { return std::fabs(p.x) < 0.5 ? 1.0 : 0.0; };
    const auto expected = [&](double x, double) { return strip_irradiance(x, 0.5, rays.height_m); };
    DeepField deep;
    AmbientCache with(deep), without(deep);
    CacheSettings settings = settings_for(0.15, 8192);
    settings.hessian = false;
    grow_all(with, floor_candidates(4000, -2, 2), rays, settings);
    std::vector<AmbientRecord> records = with.records();
    for (AmbientRecord& record : records)
        record.gradient = {};
    without.add(records);
    const double better = deviation_of(with, expected).root_mean_square;
    const double worse = deviation_of(without, expected).root_mean_square;
    EXPECT_LT(better, 0.7 * worse);
}

/// Lengths times a power of two: the same bits of irradiance.
TEST(AmbientCache, DoesNotNoticeTheScale)
{
    const auto at_scale = [](double k) {
        CeilingRays rays;
        rays.height_m = 2 * k;
        rays.radiance = [k](const Point& p) { return std::fabs(p.x) < 0.5 * k ? 1.0 : 0.0; };
        std::vector<AmbientCandidate> candidates = floor_candidates(500, -2, 2);
        for (AmbientCandidate& c : candidates)
            c.place.position = c.place.position * k;
        DeepField deep;
        AmbientCache cache(deep);
        cache.grow(candidates, rays, room_m * k, settings_for(0.2, 512));
        std::vector<double> all;
        for (const AmbientRecord& record : cache.records()) {
            all.push_back(record.irradiance.g);
            all.push_back(record.site.reach_m[0] / k);
            all.push_back(record.gradient.translation[1].x * k);
        }
        return all;
    };
    const std::vector<double> one = at_scale(1);
    EXPECT_GT(one.size(), 60u);
    for (const int power : {-30, 30})
        EXPECT_EQ(at_scale(std::ldexp(1.0, power)), one) << power;
}

TEST(AmbientCache, GenerationsDoNotDependOnTheNumberOfThreads)
{
    CeilingRays rays;
    rays.radiance = [](const Point& p) { return 1 + std::sin(3 * p.x) * std::cos(2 * p.y); };
    const auto build = [&](int threads) {
        DeepField deep;
        AmbientCache cache(deep);
        grow_all(cache, floor_candidates(2000, -2, 2), rays, settings_for(0.1, 128, threads));
        std::vector<double> bits;
        for (const AmbientRecord& r : cache.records()) {
            bits.push_back(r.site.position.x);
            bits.push_back(r.irradiance.g);
            bits.push_back(r.gradient.translation[1].x);
            bits.push_back(r.site.reach_m[0]);
            bits.push_back(static_cast<double>(r.deviation[3]));
        }
        return bits;
    };
    const std::vector<double> one = build(1);
    EXPECT_GT(one.size(), 100u);
    EXPECT_EQ(one, build(2));
    EXPECT_EQ(one, build(4));
}

/// A wall of no thickness: bright on one side, dark on the other. What is asked near it comes from its own side.
TEST(AmbientCache, NothingPassesAThinWallOrUnderADoor)
{
    for (const double gap_m : {0.0, 0.005}) {
        CeilingRays rays;
        rays.radiance = [](const Point& p) { return p.x < 0 ? 100.0 : 0.0; };
        rays.wall_gap_m = gap_m;
        DeepField deep;
        AmbientCache cache(deep);
        grow_all(cache, floor_candidates(4000, -2, 2), rays, settings_for(0.3, 512));
        int asked = 0;
        double most_dark = 0, least_bright = infinity;
        for (int i = 0; i < 2000; ++i) {
            const double x = 0.02 + 0.01 * (i % 40), y = 0.5 + 3 * (i / 2000.0);
            CachedAmbient dark, bright;
            if (!cache.irradiance({x, y, 0}, {0, 0, 1}, dark) || !cache.irradiance({-x, y, 0}, {0, 0, 1}, bright))
                continue;
            ++asked;
            most_dark = std::max(most_dark, photopic(dark.irradiance));
            least_bright = std::min(least_bright, photopic(bright.irradiance));
        }
        EXPECT_GT(asked, 1500) << gap_m;
        // Close to the wall half the ceiling is seen, 50 pi; under a door of 5 mm, at 20 mm from it, almost nothing
        // passes.
        EXPECT_LT(most_dark, gap_m > 0 ? 0.02 * 100 * pi : 1e-12) << gap_m;
        EXPECT_GT(least_bright, 0.4 * 100 * pi) << gap_m;
    }
}

TEST(AmbientCache, WhereNoRecordReachesNothingAnswers)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point&) { return 1.0; };
    AmbientCache cache(deep);
    CachedAmbient found;
    EXPECT_FALSE(cache.irradiance({0, 0, 0}, {0, 0, 1}, found));
    EXPECT_EQ(cache.grow({}, rays, room_m, settings_for(0.1, 64)), 0u);
    grow_all(cache, floor_candidates(500, -2, 2), rays, settings_for(0.1, 64));
    EXPECT_FALSE(cache.irradiance({0, 2, 1}, {0, 0, 1}, found));
    EXPECT_FALSE(cache.irradiance({0, 2, 0}, {0, 0, -1}, found)) << "the other side of the floor";
    EXPECT_FALSE(cache.irradiance({50, 2, 0}, {0, 0, 1}, found));
}

TEST(AmbientCache, NoMoreRecordsThanAllowedAndNoneWhereOneAnswers)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point&) { return 1.0; };
    AmbientCache cache(deep);
    CacheSettings settings = settings_for(0.1, 64);
    settings.most_records = 5;
    EXPECT_EQ(cache.grow(floor_candidates(500, -2, 2), rays, room_m, settings), 5u);
    EXPECT_EQ(cache.grow(floor_candidates(500, -2, 2), rays, room_m, settings), 0u);
    settings.most_records = 10000;
    std::vector<AmbientCandidate> same;
    for (const AmbientRecord& record : cache.records())
        same.push_back({{record.site.position, record.site.normal, 1e-15}, 0});
    EXPECT_EQ(cache.grow(same, rays, room_m, settings), 0u) << "each lies on a record";
}

/// Dark places have records too: zero is an answer, and its reach is finite.
TEST(AmbientCache, DarknessIsAnAnswer)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point&) { return 0.0; };
    AmbientCache cache(deep);
    grow_all(cache, floor_candidates(1000, -2, 2), rays, settings_for(0.3, 64));
    const Deviation d = deviation_of(cache, [](double, double) { return 1.0; });
    EXPECT_EQ(d.missing, 0);
    EXPECT_NEAR(d.root_mean_square, 1, 1e-12) << "all are 0";
    for (const AmbientRecord& record : cache.records())
        EXPECT_TRUE(std::isfinite(record.site.reach_m[0]) && record.site.reach_m[0] > 0);
}

/// The spread of the replicates tells the noise: about that of the records' mean over seeds.
TEST(AmbientCache, DeviationsSumToZeroAndTellTheNoise)
{
    DeepField deep;
    CeilingRays rays;
    rays.radiance = [](const Point& p) { return std::sin(50 * p.x) > 0.9 ? 10.0 : 0.0; };
    double squares = 0, stated = 0, level = 0;
    std::vector<double> values;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        AmbientCache cache(deep);
        CacheSettings settings = settings_for(0.1, 128);
        settings.seed = seed;
        cache.grow({{CeilingRays::place_at(0.3, 0.2), 0}}, rays, room_m, settings);
        const AmbientRecord& record = cache.records().front();
        double sum = 0, square = 0;
        for (const float d : record.deviation) {
            sum += static_cast<double>(d);
            square += static_cast<double>(d) * static_cast<double>(d);
        }
        EXPECT_NEAR(sum, 0, 1e-4);
        stated += square / (replicates * (replicates - 1)) / 200;
        values.push_back(photopic(record.irradiance));
        level += values.back() / 200;
    }
    for (const double v : values)
        squares += (v - level) * (v - level) / 199;
    EXPECT_NEAR(std::sqrt(stated / squares), 1, 0.25);
}

} // namespace
} // namespace lightwell
