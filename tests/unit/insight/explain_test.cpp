#include "plugins/insight/explain.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A sphere of radius 1, grey inside, with a ball of a lamp of 1000 lm in its middle that hides a millionth of it.
Scene grey_sphere(double reflectance)
{
    constexpr double radius = 1e-3, flux_lm = 1000;
    Scene scene;
    scene.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble,
                          scene.add_material("wall", Plastic{Spectrum::grey(reflectance), 0, 0}), "wall");
    const double luminance = flux_lm / (4 * pi * pi * radius * radius);
    scene.root.add_sphere({{0, 0, 0}, radius}, Shape::sphere,
                          scene.add_material("lamp", Light{Spectrum::grey(luminance / lumens_per_watt)}), "lamp");
    return scene;
}

const Share& named(const std::vector<Share>& shares, const std::string& name)
{
    for (const Share& share : shares)
        if (share.name == name)
            return share;
    ADD_FAILURE() << name << " is not among the shares";
    return shares.front();
}

double sum_of(const std::vector<Share>& shares)
{
    double sum = 0;
    for (const Share& share : shares)
        sum += share.lux;
    return sum;
}

TEST(Explain, TheReflectionsOfASphereAreTheTermsOfItsSeries)
{
    constexpr double reflectance = 0.6, direct = 1000 / (4 * pi);
    const Explanation found = explain(grey_sphere(reflectance), {{0, 0, -1}, {0, 0, 1}}, {0.002, 1, 0, {}});
    EXPECT_NEAR(found.lux, direct / (1 - reflectance), 6 * found.standard_error);
    EXPECT_LE(found.standard_error, 0.002 * found.lux);
    for (std::size_t i = 0; i < 6; ++i) {
        const Share& share = found.bounces[i];
        EXPECT_EQ(share.name, std::to_string(i));
        EXPECT_NEAR(share.lux, direct * std::pow(reflectance, static_cast<double>(i)),
                    6 * share.standard_error + 1e-3 * direct);
    }
    EXPECT_NEAR(named(found.layers, "(straight from the sources)").lux, direct, 1e-3 * direct);
    EXPECT_NEAR(named(found.layers, "wall").lux, direct * reflectance / (1 - reflectance), 0.02 * direct);
}

TEST(Explain, TheDerivativeIsThatOfTheClosedForm)
{
    constexpr double reflectance = 0.6, direct = 1000 / (4 * pi);
    const Explanation found = explain(grey_sphere(reflectance), {{0, 0, -1}, {0, 0, 1}}, {0.002, 2, 0, {}});
    ASSERT_EQ(found.effects.size(), 1u);
    const LayerEffect& wall = found.effects[0];
    EXPECT_EQ(wall.name, "wall");
    const double exact = direct / ((1 - reflectance) * (1 - reflectance));
    EXPECT_NEAR(wall.lux_per_reflectance, exact, 6 * wall.standard_error);
    EXPECT_LT(wall.standard_error, 0.02 * exact);
}

/// Two lamps over a floor that sees only one wall; a third layer hides from everything.
Scene two_lamps()
{
    Scene scene;
    const auto lamp = [&](const char* name, double luminance, double x) {
        scene.root.add_polygon({{x, 0, 3}, {x, 1, 3}, {x + 1, 1, 3}, {x + 1, 0, 3}},
                               scene.add_material(name, Light{Spectrum::grey(luminance / lumens_per_watt)}), name);
    };
    lamp("bright", 3000, 0);
    lamp("dim", 1000, 0);
    // The dim lamp is moved beside the bright one's mirror image, so that both give the sensor the same solid angle.
    for (Point& p : scene.root.points)
        if (&p >= &scene.root.points[4])
            p.x -= 1;
    scene.root.add_polygon({{-2, 2, 0}, {2, 2, 0}, {2, 2, 3}, {-2, 2, 3}},
                           scene.add_material("wall", Plastic{{0.5, 0.5, 0.5}, 0, 0}), "wall");
    scene.root.add_polygon({{-2, 9, 0}, {2, 9, 0}, {2, 9, 1}, {-2, 9, 1}},
                           scene.add_material("far", Plastic{{0.5, 0.5, 0.5}, 0, 0}), "far");
    return scene;
}

TEST(Explain, LampsShareByTheirLuminanceAndEverythingSumsToTheWhole)
{
    const Explanation found = explain(two_lamps(), {{0, 0.5, 0}, {0, 0, 1}}, {0.002, 3, 0, {}});
    ASSERT_EQ(found.sources.size(), 2u);
    EXPECT_EQ(found.sources[0].name, "bright");
    const double bright = named(found.sources, "bright").lux, dim = named(found.sources, "dim").lux;
    EXPECT_NEAR(bright / dim, 3, 0.03);
    for (const std::vector<Share>* shares : {&found.sources, &found.layers, &found.bounces}) {
        EXPECT_NEAR(sum_of(*shares), found.lux, 1e-9 * found.lux);
        double percent = 0;
        for (const double part : whole_percentages(*shares))
            percent += part;
        EXPECT_NEAR(percent, 100, 1e-9);
    }
}

TEST(Explain, TheDerivativeOfARoomIsTheDifferenceOfTwoRooms)
{
    const auto room = [](double wall) {
        Scene scene = two_lamps();
        scene.modifiers[static_cast<std::size_t>(scene.find_modifier("wall"))].what =
            Material(Plastic{Spectrum::grey(wall), 0, 0});
        return scene;
    };
    const Sensor sensor{{0, 0.5, 0}, {0, 0, 1}};
    const ExplainSettings settings{0.001, 4, 0, {}};
    const Explanation middle = explain(room(0.5), sensor, settings), less = explain(room(0.2), sensor, settings),
                      more = explain(room(0.8), sensor, settings);
    // One reflection at most between wall and sensor: the illuminance is linear in the wall's reflectance.
    const double slope = (more.lux - less.lux) / 0.6;
    const double error = std::hypot(more.standard_error, less.standard_error) / 0.6;
    ASSERT_FALSE(middle.effects.empty());
    EXPECT_EQ(middle.effects[0].name, "wall");
    EXPECT_NEAR(middle.effects[0].lux_per_reflectance, slope, 6 * (error + middle.effects[0].standard_error));
}

TEST(Explain, PercentagesSumToAHundredWhateverTheShares)
{
    for (const auto& lux : {std::vector<double>{1, 1, 1}, {1, 1, 1, 1, 1, 1, 1}, {1e-9, 5, 7}, {2, 0, 0}}) {
        std::vector<Share> shares;
        for (const double value : lux)
            shares.push_back({"", value, 0});
        double tenths = 0;
        for (const double part : whole_percentages(shares))
            tenths += std::round(10 * part);
        EXPECT_EQ(tenths, 1000);
    }
}

TEST(Explain, SensorsThatAreNoneAndScenesWithoutLightAreRefused)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(explain(grey_sphere(0.5), {{nan, 0, 0}, {0, 0, 1}}, {}), InputError);
    EXPECT_THROW(explain(grey_sphere(0.5), {{0, 0, 0}, {0, 0, 0}}, {}), InputError);
    Scene dark;
    dark.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble, dark.add_material("wall", Plastic{}), "wall");
    EXPECT_THROW(explain(dark, {{0, 0, 0}, {0, 0, 1}}, {}), InputError);
}

TEST(Explain, StopsWhenAsked)
{
    Progress progress;
    progress.cancelled = [] { return true; };
    EXPECT_THROW(explain(grey_sphere(0.5), {{0, 0, -1}, {0, 0, 1}}, {}, progress), Cancelled);
}

} // namespace
} // namespace lightwell
