#include "engine/direct/direct_light.h"

#include "engine/sources/unoccluded.h"
#include "materials/emission.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A scene with what gathering needs.
struct Stage {
    Scene scene;
    RayQueries rays;
    SourceList sources;
    explicit Stage(Scene s) : scene(std::move(s)), rays(scene), sources(scene, rays) {}
};

const Material white = Plastic{Spectrum::grey(1), 0, 0};

Vertex vertex_at(const Point& at, const Direction& normal, const Material& material = white,
                 const Direction& to_viewer = {0, 0, 1})
{
    Hit hit;
    hit.position = at;
    hit.normal = hit.shading_normal = normal;
    return {hit, -to_viewer, material};
}

struct Mean {
    double value = 0, error = 0, shadow_rays = 0, tested = 0, doubt = 0;
};

/// Photopic irradiance over `count` gathers, with its standard error.
Mean mean_irradiance(const Stage& stage, const DirectSettings& settings, const Vertex& vertex, int count,
                     const VisibilityHistory* history = nullptr)
{
    const DirectLight direct(stage.sources, stage.rays, settings);
    double sum = 0, squares = 0;
    Mean mean;
    for (int i = 0; i < count; ++i) {
        PathRandom random(mix_bits(9, static_cast<std::uint64_t>(i)), 0, 0);
        SourceShares shares;
        const Gathered found = direct.gather_tested(vertex, {}, {history, nullptr}, random, shares);
        const double e = photopic(found.irradiance);
        sum += e;
        squares += e * e;
        mean.shadow_rays += static_cast<double>(found.shadow_rays) / count;
        mean.tested += static_cast<double>(found.tested) / count;
        mean.doubt += found.doubt / count;
    }
    mean.value = sum / count;
    mean.error = std::sqrt(std::fmax(0, squares / count - mean.value * mean.value) / count);
    return mean;
}

/// Standard errors within which means agree: a false alarm of about 1e-6 each.
constexpr double interval = 5;

void add_panel(Scene& scene, const Point& low, double size_x, double size_y, double radiance)
{
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(radiance)});
    scene.root.add_polygon({low, low + Vec3{0, size_y, 0}, low + Vec3{size_x, size_y, 0}, low + Vec3{size_x, 0, 0}},
                           lamp, "panel");
}

void add_wall(Scene& scene, const std::vector<Point>& corners,
              const Material& material = Plastic{Spectrum::grey(0.5), 0, 0})
{
    scene.root.add_polygon(corners, scene.add_material("wall", material), "wall");
}

double lambert(const std::vector<Point>& corners, const Point& at)
{
    std::vector<Vec3> seen;
    for (const Point& p : corners)
        seen.push_back(p - at);
    return polygon_irradiance(seen.data(), static_cast<int>(seen.size()), {0, 0, 1});
}

TEST(TestedLight, OfAnUnoccludedPanelIsExactInEverySingleGather)
{
    Scene scene;
    add_panel(scene, {-0.6, -0.15, 2.25}, 1.2, 0.3, 60);
    const Stage stage(std::move(scene));
    for (const Point& at : {Point{0, 0, 0}, Point{2, 1, 0}, Point{0.5, 0.1, 2.2}}) {
        const double expected =
            60 * lambert({{-0.6, -0.15, 2.25}, {-0.6, 0.15, 2.25}, {0.6, 0.15, 2.25}, {0.6, -0.15, 2.25}}, at);
        const Mean found = mean_irradiance(stage, {}, vertex_at(at, {0, 0, 1}), 16);
        EXPECT_NEAR(found.value, expected, 1e-9 * expected);
        EXPECT_LE(found.error, 1e-9 * expected);
        EXPECT_LE(found.shadow_rays, 8);
    }
}

/// A wall hides the half of the panel at x > edge: the other half is a rectangle, whose irradiance Lambert gives.
TEST(TestedLight, OfAHalfHiddenPanelIsRightOnAverageWithAndWithoutEachTechnique)
{
    for (const double edge : {-0.45, 0.0, 0.3}) {
        Scene scene;
        add_panel(scene, {-0.5, -0.5, 2}, 1, 1, 1);
        add_wall(scene, {{0.5 * edge, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0.5 * edge, 9, 1}});
        const Stage stage(std::move(scene));
        const double expected = lambert({{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {edge, 0.5, 2}, {edge, -0.5, 2}}, {0, 0, 0});
        DirectSettings plain, no_closed_form, one_ray;
        no_closed_form.analytic = false;
        one_ray.subdivide = one_ray.analytic = false;
        const Vertex vertex = vertex_at({0, 0, 0}, {0, 0, 1});
        // The ratio of sums may be off by a little; the others by nothing.
        const Mean ratio = mean_irradiance(stage, plain, vertex, 20000);
        EXPECT_NEAR(ratio.value, expected, interval * ratio.error + 0.002 * expected) << edge;
        for (const DirectSettings& settings : {no_closed_form, one_ray}) {
            const Mean found = mean_irradiance(stage, settings, vertex, 40000);
            EXPECT_NEAR(found.value, expected, interval * found.error) << edge;
            EXPECT_LE(found.error, 0.03 * expected);
        }
        const Mean crude = mean_irradiance(stage, one_ray, vertex, 20000);
        EXPECT_LT(2 * ratio.error, crude.error) << "subdivision lowers the noise";
        EXPECT_NEAR(crude.shadow_rays, 1, 1e-9);
    }
}

TEST(TestedLight, BehindAWallIsNothingAndBehindGlassIsWhatTheGlassLeaves)
{
    const std::vector<Point> pane{{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}};
    Scene dark, glazed, open;
    for (Scene* scene : {&dark, &glazed, &open})
        add_panel(*scene, {-0.01, -0.01, 2}, 0.02, 0.02, 1);
    add_wall(dark, pane);
    const Glass glass{Spectrum::grey(0.96), 1.52};
    add_wall(glazed, pane, glass);
    const Vertex vertex = vertex_at({0, 0, 0}, {0, 0, 1});
    const double whole = mean_irradiance(Stage(std::move(open)), {}, vertex, 4).value;
    EXPECT_EQ(mean_irradiance(Stage(std::move(dark)), {}, vertex, 100).value, 0);
    const double kept = photopic(Bsdf(glass, true).straight_transmittance({0, 0, 1}));
    EXPECT_NEAR(mean_irradiance(Stage(std::move(glazed)), {}, vertex, 4).value, kept * whole, 1e-4 * whole);
    EXPECT_LT(kept, 0.95);
}

Scene many_panels(int rows, int columns)
{
    Scene scene;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k)
            add_panel(scene, {2.0 * k - columns, 2.0 * i - rows, 3}, 0.1, 0.1, 100 + i);
    // Fins between the rows hide some lamps.
    for (int i = 1; i < rows; ++i)
        add_wall(scene, {{-30, 2.0 * i - rows - 0.9, 2},
                         {30, 2.0 * i - rows - 0.9, 2},
                         {30, 2.0 * i - rows - 0.9, 2.9},
                         {-30, 2.0 * i - rows - 0.9, 2.9}});
    return scene;
}

TEST(TestedLight, AdaptiveTestingLeavesMostSourcesUntestedWithinItsDoubt)
{
    const Stage stage(many_panels(12, 12));
    DirectSettings all, adaptive;
    all.threshold = 0;
    adaptive.threshold = 0.1;
    for (const double x : {0.3, 2.0, 9.0}) {
        const Vertex vertex = vertex_at({x, 0.2, 0}, {0, 0, 1});
        const Mean truth = mean_irradiance(stage, all, vertex, 400),
                   found = mean_irradiance(stage, adaptive, vertex, 400);
        EXPECT_LE(found.tested, 0.5 * truth.tested);
        EXPECT_LE(found.shadow_rays, 0.6 * truth.shadow_rays) << "the strongest get several each";
        // doubt is of the radiance of a white surface, irradiance / pi
        EXPECT_LE(std::fabs(found.value - truth.value),
                  pi * found.doubt + interval * std::hypot(found.error, truth.error));
        EXPECT_GT(found.doubt, 0);
        EXPECT_EQ(truth.doubt, 0);
    }
}

TEST(TestedLight, ASampledRemainderAndGroupsOfLampsKeepTheMean)
{
    const Stage stage(many_panels(12, 12));
    DirectSettings all, sampled, grouped, untreed;
    all.threshold = 0;
    sampled.threshold = 0.3;
    sampled.sampled_remainder = true;
    grouped.threshold = 0;
    grouped.most_lamps = 0;
    grouped.lamp_groups = 20;
    untreed.threshold = 0;
    untreed.tree = false;
    const Vertex vertex = vertex_at({1, 0.2, 0}, {0, 0, 1});
    const Mean truth = mean_irradiance(stage, all, vertex, 2000);
    EXPECT_LE(truth.error, 0.001 * truth.value);
    for (const DirectSettings& settings : {sampled, grouped, untreed}) {
        const Mean found = mean_irradiance(stage, settings, vertex, 8000);
        EXPECT_NEAR(found.value, truth.value, interval * std::hypot(found.error, truth.error) + 1e-9 * truth.value);
        EXPECT_LE(found.error, 0.008 * truth.value);
    }
    EXPECT_LT(mean_irradiance(stage, grouped, vertex, 100).shadow_rays, 0.5 * truth.shadow_rays);
}

TEST(TestedLight, HistoriesMakeTheEstimateOfWhatIsLeftUntestedBetter)
{
    const Stage stage(many_panels(12, 12));
    DirectSettings all, adaptive;
    all.threshold = 0;
    adaptive.threshold = 0.3;
    const DirectLight direct(stage.sources, stage.rays, all);
    VisibilityCounts counts(direct.sources());
    const Vertex vertex = vertex_at({1, 0.2, 0}, {0, 0, 1});
    for (std::uint32_t i = 0; i < 200; ++i) {
        PathRandom random(1, 0, i);
        SourceShares shares;
        direct.gather_tested(vertex, {}, {nullptr, &counts}, random, shares);
    }
    const VisibilityHistory history(counts);
    const double truth = mean_irradiance(stage, all, vertex, 500).value;
    const double without = mean_irradiance(stage, adaptive, vertex, 500).value - truth;
    const double with = mean_irradiance(stage, adaptive, vertex, 500, &history).value - truth;
    EXPECT_LT(std::fabs(with), 0.5 * std::fabs(without));
}

/// Mean over directions of the sun's disc of what a wall with a level top leaves.
TEST(TestedLight, TheSunBehindAnEdgeGivesThePartOfItsDiscThatIsVisible)
{
    const double altitude = 40 * radians_per_degree, half = 0.25 * radians_per_degree;
    const Direction to_sun{std::cos(altitude), 0, std::sin(altitude)};
    for (const double share : {-0.8, 0.0, 0.5}) {
        Scene scene;
        const double top = 10 * std::tan(altitude + share * half);
        scene.root.add_source({to_sun, 0.5}, scene.add_material("solar", Light{Spectrum::grey(1e6)}), "sun");
        add_wall(scene, {{10, -90, 0}, {10, 90, 0}, {10, 90, top}, {10, -90, top}});
        const Stage stage(std::move(scene));
        // The part of a disc above a chord at `share` radii: acos(s) - s sqrt(1 - s^2), of pi.
        const double visible = (std::acos(share) - share * std::sqrt(1 - share * share)) / pi;
        const double expected = 1e6 * pi * std::pow(std::sin(half), 2) * std::sin(altitude) * visible;
        const Mean found = mean_irradiance(stage, {}, vertex_at({0, 0, 0}, {0, 0, 1}), 20000);
        EXPECT_NEAR(found.value, expected, interval * found.error + 0.004 * expected) << share;
        EXPECT_LE(found.error, 0.005 * expected);
    }
}

/// What a vertex sends to its viewer when scattered rays of a set of lobes are added to its gathers.
Mean mean_radiance(const Stage& stage, const Vertex& vertex, bool tested, int count)
{
    const DirectLight direct(stage.sources, stage.rays, {});
    const LobeSet set = tested ? LobeSet::specular : LobeSet::all;
    Mean mean;
    double squares = 0;
    for (int i = 0; i < count; ++i) {
        PathRandom random(mix_bits(17, static_cast<std::uint64_t>(i)), 0, 0);
        SourceShares shares;
        const Gathered found =
            tested ? direct.gather_tested(vertex, {}, {}, random, shares) : direct.gather(vertex, {4}, random, shares);
        double value = photopic(found.radiance);
        const double choice = random.one();
        const auto scattered = vertex.bsdf.sample(vertex.to_viewer, choice, random.pair(), set);
        Hit hit;
        if (scattered && scattered->density_per_sr > 0) {
            const Direction world = vertex.frame.to_world(scattered->to_light);
            if (stage.rays.closest({vertex.hit.leave(world), world, infinity}, hit)) {
                const Material& met = *resolve(stage.scene, hit.modifier).material;
                const Spectrum radiance = emitted_towards(met, -dot(hit.normal, world), -world);
                const int lamp = stage.sources.lamp_at(hit);
                if (lamp >= 0)
                    value += photopic(radiance * scattered->weight) *
                             (1 - shadow_ray_weight(direct.lamp_density(shares, lamp, world, hit),
                                                    scattered->density_per_sr));
            }
        }
        mean.value += value / count;
        squares += value * value / count;
    }
    mean.error = std::sqrt(std::fmax(0, squares - mean.value * mean.value) / count);
    return mean;
}

TEST(TestedLight, WithScatteredGlossyRaysEqualsRandomGathersWithAllScatteredRays)
{
    Scene scene;
    add_panel(scene, {-0.5, 0.5, 2}, 1, 1, 3);
    add_panel(scene, {2, 2, 2}, 0.05, 0.05, 300);
    scene.root.add_sphere({{-1.5, 1, 1.5}, 0.1}, Shape::sphere, scene.add_material("ball", Light{Spectrum::grey(100)}),
                          "ball");
    const Stage stage(std::move(scene));
    const Direction to_viewer = normalized(Vec3{0, -1, 1});
    const Material materials[] = {Plastic{Spectrum::grey(0.5), 0.3, 0.02}, Plastic{Spectrum::grey(0.3), 0.5, 0.2},
                                  Metal{Spectrum::grey(0.9), 1, 0.1}, Plastic{Spectrum::grey(0.5), 0.05, 0}};
    for (const Material& material : materials) {
        const Vertex vertex = vertex_at({0, 0, 0}, {0, 0, 1}, material, to_viewer);
        const Mean random = mean_radiance(stage, vertex, false, 200000),
                   tested = mean_radiance(stage, vertex, true, 50000);
        EXPECT_NEAR(tested.value, random.value, interval * std::hypot(random.error, tested.error) + 1e-3 * random.value)
            << type_name(material);
        EXPECT_LE(interval * random.error, 0.03 * random.value);
        EXPECT_LT(tested.error, 4 * random.error) << "with a quarter of the gathers";
    }
}

TEST(TestedLight, ATranslucentSheetGathersOnBothSides)
{
    Scene scene;
    add_panel(scene, {-0.5, -0.5, 2}, 1, 1, 1);
    const Stage stage(std::move(scene));
    const Material sheet = Trans{Spectrum::grey(1), 0, 0, 0.4, 0.25};
    const DirectLight direct(stage.sources, stage.rays);
    PathRandom random(1, 0, 0);
    SourceShares shares;
    // Seen from below, lit from above: 0.4 * 0.75 passes diffusely.
    const Vertex below = vertex_at({0, 0, 0}, {0, 0, 1}, sheet, {0, 0, -1});
    const double arriving = lambert({{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}}, {0, 0, 0});
    const Gathered found = direct.gather_tested(below, {}, {}, random, shares);
    EXPECT_NEAR(photopic(found.radiance), 0.3 * arriving / pi, 1e-9);
    EXPECT_EQ(photopic(found.irradiance), 0) << "nothing falls on the viewer's side";
}

} // namespace
} // namespace lightwell
