#include "materials/bsdf.h"

#include "materials/measured/measured_table.h"
#include "tests/unit/materials/bsdf_measures.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace lightwell;

namespace {

struct Named {
    std::string name;
    Material material;
};

/// One of each kind that scatters, with the limits of roughness.
std::vector<Named> rough_materials()
{
    const Spectrum brown{0.6, 0.4, 0.2}, white = Spectrum::grey(1);
    return {{"matte", Plastic{brown, 0, 0}},
            {"smooth plastic", Plastic{white, 0.05, 0}},
            {"nearly smooth plastic", Plastic{white, 0.05, 1e-4}},
            {"glossy plastic", Plastic{brown, 0.08, 0.1}},
            {"rough plastic", Plastic{white, 0.5, 1}},
            {"glossy metal", Metal{brown, 0.9, 0.15}},
            {"white rough metal", Metal{white, 1, 0.5}},
            {"smooth metal", Metal{brown, 0.8, 0}},
            {"diffusing trans", Trans{white, 0, 0, 0.6, 0}},
            {"glossy trans", Trans{white, 0.06, 0.15, 0.5, 0.6}},
            {"rough trans", Trans{white, 0.06, 1, 0.9, 0.9}},
            {"smooth trans", Trans{brown, 0.06, 0, 0.5, 0.6}},
            {"brushed plastic", Brushed{Brushed::Kind::plastic, brown, 0.1, 0.3, 0.15, 0, 0, {}}},
            {"white brushed metal", Brushed{Brushed::Kind::metal, white, 1, 0.12, 0.5, 0, 0, {}}},
            {"brushed trans", Brushed{Brushed::Kind::trans, white, 0.1, 0.2, 0.4, 0.8, 0.7, {}}},
            {"varnish", Ashikhmin{brown, Spectrum::grey(0.05), 20, 60, {}}},
            {"white varnish", Ashikhmin{white, Spectrum::grey(0.4), 5, 5, {}}},
            {"Ward's model of both sides",
             Wgmd{{}, white * 0.3, {}, white * 0.1, {white, white, brown}, 0.25, 0.2, 0.3, 0.3, 0.25, 0.15, {}}}};
}

std::vector<Named> all_materials()
{
    std::vector<Named> all = rough_materials();
    const Spectrum white = Spectrum::grey(1);
    all.push_back({"glass", Glass{white, 1.52}});
    all.push_back({"tinted glass", Glass{{0.9, 0.5, 0}, 1.52}});
    all.push_back({"dense glass", Glass{white, 2.4}});
    all.push_back({"glass of index 1", Glass{white, 1}});
    all.push_back({"dielectric", Dielectric{white, 1.5, 0}});
    all.push_back({"dielectric of index 1", Dielectric{white, 1, 0}});
    all.push_back({"mirror", Mirror{{0.9, 0.8, 0.7}}});
    all.push_back({"light", Light{white}});
    return all;
}

} // namespace

TEST(Bsdf, SamplesFollowTheDensityOfEveryMaterialAndAngle)
{
    for (const Named& m : rough_materials())
        for (double angle : {0.0, 45.0, 80.0, 88.0}) {
            SCOPED_TRACE(m.name + " at " + std::to_string(angle));
            const Bsdf bsdf(m.material, true);
            // Azimuth 7 degrees: the plane of incidence is not the border of a cell.
            const Direction to_viewer = at(angle, 7);
            const Histogram found = histogram_of(bsdf, to_viewer);
            EXPECT_GT(probability(found, shares_of(bsdf, to_viewer)), 1e-7);
        }
}

TEST(Bsdf, ADensityWrongByTwoPercentIsRejected)
{
    for (const Material& m :
         {Material{Plastic{Spectrum::grey(0.5), 0, 0}}, Material{Metal{Spectrum::grey(1), 1, 0.3}}}) {
        const Bsdf bsdf(m, true);
        const Histogram found = histogram_of(bsdf, at(30, 7), 20 * draws);
        const std::vector<double> shares = shares_of(bsdf, at(30, 7));
        EXPECT_GT(probability(found, shares), 1e-6);
        EXPECT_LT(probability(found, shares, 0.02), 1e-6);
    }
}

TEST(Bsdf, WeightIsValueTimesCosineOverDensity)
{
    for (const Named& m : rough_materials())
        for (double angle : angles_deg) {
            SCOPED_TRACE(m.name + " at " + std::to_string(angle));
            const Bsdf bsdf(m.material, true);
            RandomStream random(4);
            for (int i = 0; i < 300; ++i) {
                const double choice = random.next();
                const auto s = bsdf.sample(at(angle), choice, random.square());
                if (!s || s->delta)
                    continue;
                ASSERT_NEAR(length(s->to_light), 1, 1e-12);
                ASSERT_GT(s->density_per_sr, 0);
                const double density = bsdf.density_per_sr(at(angle), s->to_light);
                EXPECT_NEAR(s->density_per_sr / density, 1, 1e-12);
                const Spectrum value = bsdf.value_per_sr(at(angle), s->to_light);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(s->weight[c] * density, value[c] * std::fabs(s->to_light.z), 1e-12 * (1 + value[c]));
            }
        }
}

TEST(Bsdf, NothingGivesBackMoreLightThanItGets)
{
    for (const Named& m : all_materials())
        for (double angle : angles_deg) {
            SCOPED_TRACE(m.name + " at " + std::to_string(angle));
            const Bsdf bsdf(m.material, true);
            RunningStatistics channels[3];
            RandomStream random(3);
            for (int i = 0; i < 20000; ++i) {
                const double choice = random.next();
                const auto s = bsdf.sample(at(angle), choice, random.square());
                for (int c = 0; c < 3; ++c)
                    channels[c].add(s ? s->weight[c] : 0);
            }
            for (const RunningStatistics& channel : channels) {
                // One-sided: six standard errors are a false alarm of 1e-9; the rest is rounding of equal weights.
                EXPECT_LE(channel.mean(), 1 + 6 * channel.standard_error() + 1e-9);
                EXPECT_LT(channel.standard_error(), 0.02);
            }
        }
}

TEST(Bsdf, WhiteMatteAndClearGlassLoseNothing)
{
    for (double angle : angles_deg) {
        EXPECT_NEAR(albedo(Bsdf(Plastic{Spectrum::grey(1), 0, 0}, true), at(angle)).g, 1, 1e-12);
        EXPECT_NEAR(albedo(Bsdf(Glass{Spectrum::grey(1), 1.52}, true), at(angle)).g, 1, 1e-9);
        EXPECT_NEAR(albedo(Bsdf(Trans{Spectrum::grey(1), 0, 0, 0.4, 0.5}, true), at(angle)).g, 1, 1e-9);
    }
}

TEST(Bsdf, ValueIsReciprocal)
{
    RandomStream random(8);
    for (const Named& m : rough_materials()) {
        SCOPED_TRACE(m.name);
        const Bsdf bsdf(m.material, true);
        for (int i = 0; i < 300; ++i) {
            Direction a = cosine_hemisphere(random.square()), b = uniform_sphere(random.square());
            const Spectrum there = bsdf.value_per_sr(a, b);
            // Through the sheet, the viewer stands on the other side: its frame is turned over.
            const Direction mirror_a{a.x, a.y, -a.z}, mirror_b{b.x, b.y, -b.z};
            const Spectrum back = b.z > 0 ? bsdf.value_per_sr(b, a) : bsdf.value_per_sr(mirror_b, mirror_a);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(there[c], back[c], 1e-12 * (1 + there[c]));
        }
    }
}

TEST(Bsdf, TheIntegralOfTheValueIsTheMeanWeight)
{
    // Uniform directions against sample(): the two share no formula.
    for (const Named& m : rough_materials()) {
        SCOPED_TRACE(m.name);
        const Bsdf bsdf(m.material, true);
        const Direction to_viewer = at(50);
        RunningStatistics uniform, drawn;
        RandomStream random(9);
        for (int i = 0; i < 400000; ++i) {
            const Direction d = uniform_sphere(random.square());
            uniform.add(4 * pi * bsdf.value_per_sr(to_viewer, d).g * std::fabs(d.z));
            const double choice = random.next();
            const auto s = bsdf.sample(to_viewer, choice, random.square());
            drawn.add(s && !s->delta ? s->weight.g : 0);
        }
        const double error = std::hypot(uniform.standard_error(), drawn.standard_error());
        EXPECT_TRUE(agrees({uniform.mean(), error}, drawn.mean())) << uniform.mean() << " " << drawn.mean();
    }
}

TEST(Bsdf, DiffuseAndSpecularLobesAskedApartAddUpToTheWhole)
{
    for (const Named& m : rough_materials()) {
        SCOPED_TRACE(m.name);
        const Bsdf bsdf(m.material, true);
        for (const double light_deg : {10.0, 60.0, 130.0, 175.0}) {
            const Direction from = at(40), to = at(light_deg, 160);
            const Spectrum all = bsdf.value_per_sr(from, to), diffuse = bsdf.value_per_sr(from, to, LobeSet::diffuse),
                           specular = bsdf.value_per_sr(from, to, LobeSet::specular);
            EXPECT_NEAR(all.g, diffuse.g + specular.g, 1e-14 * (1 + all.g));
        }
        Spectrum whole = albedo(bsdf, at(40), 200000), parts;
        for (const LobeSet set : {LobeSet::diffuse, LobeSet::specular}) {
            Spectrum sum;
            RandomStream random(4);
            for (int i = 0; i < 200000; ++i) {
                const double choice = random.next();
                if (const auto s = bsdf.sample(at(40), choice, random.square(), set))
                    sum += s->weight;
            }
            parts += sum / 200000;
        }
        EXPECT_NEAR(whole.g, parts.g, 0.01);
    }
}

TEST(Bsdf, DiffuseReflectanceFollowsTheManual)
{
    // Colour times (1 - specularity); of Trans the share that does not pass, and of what passes the scattered share.
    const Spectrum colour{0.6, 0.4, 0.2};
    const Lobes plastic = Bsdf(Plastic{colour, 0.1, 0.2}, true).lobes();
    EXPECT_NEAR(plastic.diffuse_reflectance.r, 0.54, 1e-15);
    EXPECT_TRUE(plastic.glossy);
    EXPECT_FALSE(plastic.delta);
    EXPECT_EQ(plastic.glossy_width_rad, 0.2);
    const Lobes trans = Bsdf(Trans{colour, 0.1, 0, 0.5, 0.25}, true).lobes();
    // Specularity 0.1 without roughness: the coating takes 5.5 % of the diffuse light on its way in, and 0.085 % of
    // what leaves along the normal.
    EXPECT_NEAR(trans.diffuse_reflectance.g, 0.4 * 0.9 * 0.5 * (1 - 0.000850) * (1 - 0.0552588), 1e-6);
    EXPECT_NEAR(trans.diffuse_transmittance.g, 0.4 * 0.9 * 0.5 * 0.75 * (1 - 0.000850) * (1 - 0.0552588), 1e-6);
    EXPECT_TRUE(trans.delta);
    EXPECT_TRUE(trans.transparent_to_shadows);
    EXPECT_NEAR(Bsdf(Trans{colour, 0.1, 0, 0.5, 0.25}, true).straight_transmittance(at(0)).g,
                0.4 * 0.9 * 0.5 * 0.25 * (1 - 0.000850), 1e-6);
}

TEST(Bsdf, ASmoothCoatingReflectsNearlyAllAtGrazingAngles)
{
    const Bsdf plastic(Plastic{Spectrum::grey(0.5), 0.04, 0}, true);
    const auto grazing = plastic.sample(at(89.99), 0, {0.5, 0.5});
    ASSERT_TRUE(grazing && grazing->delta);
    const auto normal = plastic.sample(at(0), 0, {0.5, 0.5});
    // Share of choice is reflectance over albedo; the product gives the reflectance back.
    const double specular_at_normal = 0.04 + 0.96 * 0.000850;
    EXPECT_NEAR(normal->weight.g, specular_at_normal + (1 - specular_at_normal) * 0.5, 1e-6);
    // exp(-5.85 * 1.745e-4) - 0.00203 = 0.99695; reflectance 0.04 + 0.96 * 0.99695 = 0.99707, albedo 0.99854.
    EXPECT_NEAR(grazing->weight.g, 0.99854, 1e-4);
}

TEST(Bsdf, DeltaLobesCarryTheSharesOfTheManual)
{
    // weight * probability of the mirror lobe, by counting choices on a fine grid.
    const auto carried = [](const Material& m, double angle, bool straight) {
        const Bsdf bsdf(m, true);
        Spectrum sum;
        constexpr int steps = 100000;
        for (int i = 0; i < steps; ++i)
            if (const auto s = bsdf.sample(at(angle), (i + 0.5) / steps, {0.3, 0.6}); s && s->delta)
                if (s->straight == straight)
                    sum += s->weight / steps;
        return sum;
    };
    const double gain = std::exp(-5.85 * 0.5) - 0.00202943064; // at 60 degrees
    const Spectrum colour{0.6, 0.4, 0.2};
    const Spectrum metal = carried(Metal{colour, 0.8, 0}, 60, false);
    const Spectrum plastic = carried(Plastic{colour, 0.05, 0}, 60, false);
    const Spectrum uncoated = carried(Plastic{colour, 0.01, 0}, 60, false);
    const Spectrum through = carried(Trans{colour, 0.05, 0, 0.5, 0.4}, 60, true);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(metal[c], gain + colour[c] * 0.8 * (1 - gain), 1e-4);
        EXPECT_NEAR(plastic[c], 0.05 + gain * 0.95, 1e-4);
        EXPECT_NEAR(uncoated[c], 0.01, 1e-4);
        EXPECT_NEAR(through[c], colour[c] * 0.5 * 0.4 * 0.95 * (1 - gain), 1e-4);
    }
    const Spectrum glass = carried(Glass{Spectrum::grey(0.96), 1.52}, 60, true);
    EXPECT_NEAR(glass.g, Bsdf(Glass{Spectrum::grey(0.96), 1.52}, true).straight_transmittance(at(60)).g, 1e-4);
}

TEST(Bsdf, LightThatRefractsInAndOutOfABodyKeepsItsRadiance)
{
    const Bsdf in(Dielectric{Spectrum::grey(1), 1.5, 0}, true), out(Dielectric{Spectrum::grey(1), 1.5, 0}, false);
    for (double angle : {0.0, 40.0, 80.0, 89.9}) {
        const auto first = in.sample(at(angle), 0.9999999, {0.5, 0.5});
        ASSERT_TRUE(first && first->delta && !first->straight);
        EXPECT_NEAR(std::hypot(first->to_light.x, first->to_light.y) * 1.5, std::sin(angle * radians_per_degree),
                    1e-12);
        // The viewer is inside now, and looks back along the ray.
        const Direction inside{-first->to_light.x, -first->to_light.y, -first->to_light.z};
        const auto second = out.sample(inside, 0.9999999, {0.5, 0.5});
        ASSERT_TRUE(second);
        EXPECT_NEAR(std::hypot(second->to_light.x, second->to_light.y), std::sin(angle * radians_per_degree), 1e-9);
        EXPECT_NEAR(first->weight.g, 1 / 2.25, 1e-12);
        EXPECT_NEAR(first->weight.g * second->weight.g, 1, 1e-9);
    }
}

TEST(Bsdf, BeyondTheCriticalAngleEverythingIsReflected)
{
    const Bsdf inside(Dielectric{Spectrum::grey(1), 1.5, 0}, false);
    for (double angle : {41.82, 60.0, 89.99}) {
        const auto s = inside.sample(at(angle), 0.9999999, {0.5, 0.5});
        ASSERT_TRUE(s);
        EXPECT_GT(s->to_light.z, 0);
        EXPECT_NEAR(s->weight.g, 1, 1e-12);
    }
}

TEST(Bsdf, ABodyOfIndexOneIsNotThere)
{
    const Bsdf bsdf(Dielectric{Spectrum::grey(1), 1, 0}, true);
    EXPECT_TRUE(bsdf.lobes().transparent_to_shadows);
    for (double angle : angles_deg) {
        const auto s = bsdf.sample(at(angle), 0, {0.5, 0.5});
        ASSERT_TRUE(s);
        EXPECT_TRUE(s->straight);
        EXPECT_NEAR(length(s->to_light + at(angle)), 0, 1e-15);
        EXPECT_NEAR(s->weight.g, 1, 1e-12);
        EXPECT_NEAR(bsdf.straight_transmittance(at(angle)).g, 1, 1e-12);
    }
}

TEST(Bsdf, HartmannsConstantMovesTheIndexToThatOfFiveHundredNanometres)
{
    const Bsdf plain(Dielectric{Spectrum::grey(1), 1.6, 0}, true),
        hartmann(Dielectric{Spectrum::grey(1), 1.5, 50}, true);
    EXPECT_NEAR(plain.sample(at(50), 0.999, {})->to_light.x, hartmann.sample(at(50), 0.999, {})->to_light.x, 1e-14);
}

TEST(Bsdf, EmittersAndBlackSurfacesReflectNothing)
{
    const Spectrum white = Spectrum::grey(1);
    for (const Material& m :
         {Material{Light{white}}, Material{Glow{white, 0}}, Material{Illum{white, "a"}},
          Material{Spotlight{white, 30, {0, 0, -1}}}, Material{Plastic{{}, 0, 0}}, Material{Mirror{{}}}}) {
        const Bsdf bsdf(m, true);
        EXPECT_FALSE(bsdf.sample(at(20), 0.3, {0.5, 0.5}));
        EXPECT_TRUE(bsdf.value_per_sr(at(20), at(30)).is_black());
        EXPECT_TRUE(bsdf.straight_transmittance(at(20)).is_black());
        EXPECT_TRUE(bsdf.lobes().diffuse_reflectance.is_black());
    }
}

TEST(Bsdf, AViewerBelowTheSurfaceGetsNothing)
{
    for (const Named& m : all_materials()) {
        const Bsdf bsdf(m.material, true);
        for (const Direction& below : {Direction{1, 0, 0}, Direction{0, 0, -1}}) {
            EXPECT_TRUE(bsdf.value_per_sr(below, at(10)).is_black()) << m.name;
            EXPECT_EQ(bsdf.density_per_sr(below, at(10)), 0) << m.name;
            EXPECT_FALSE(bsdf.sample(below, 0.5, {0.5, 0.5})) << m.name;
        }
    }
}

TEST(Bsdf, ExtremeDirectionsAndChoicesGiveFiniteNumbers)
{
    const double last = std::nextafter(1.0, 0.0);
    for (const Named& m : all_materials())
        for (double z : {1.0, 1e-8, 1e-100, 1e-300})
            for (double choice : {0.0, 0.5, last})
                for (const UnitSquare& u : {UnitSquare{0, 0}, UnitSquare{last, last}, UnitSquare{0.5, 0}}) {
                    SCOPED_TRACE(m.name);
                    const Bsdf bsdf(m.material, true);
                    const Direction to_viewer{std::sqrt(1 - z * z), 0, z};
                    const auto s = bsdf.sample(to_viewer, choice, u);
                    if (!s)
                        continue;
                    EXPECT_TRUE(s->weight.is_finite());
                    EXPECT_TRUE(is_finite(s->to_light));
                    EXPECT_TRUE(std::isfinite(s->density_per_sr));
                    EXPECT_GE(s->weight.g, 0);
                }
}
