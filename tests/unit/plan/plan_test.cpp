#include "engine/base/errors.h"
#include "engine/plan/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace lightwell {
namespace {

void add_square(Scene& scene, Material material, double z)
{
    const ModifierId modifier = scene.add_material("material", material);
    scene.root.add_polygon({{0, 0, z}, {2, 0, z}, {2, 2, z}, {0, 2, z}}, modifier, "square");
}

Scene plain_room()
{
    Scene scene;
    add_square(scene, Plastic{Spectrum::grey(0.5)}, 0);
    add_square(scene, Light{Spectrum::grey(10)}, 1);
    return scene;
}

std::set<StageKind> stages_on(const Plan& plan)
{
    std::set<StageKind> on;
    for (const Stage& stage : plan.stages)
        if (stage.on)
            on.insert(stage.kind);
    return on;
}

TEST(Plan, ASceneWithoutMirrorsPatternsAndTranslucencyBuildsNoneOfTheirStages)
{
    const Plan plan = plan_for(needs_of(plain_room()), {0.01});
    EXPECT_EQ(stages_on(plan), (std::set{StageKind::lamps, StageKind::interreflection}));
    EXPECT_EQ(plan.bounces, 7);
    EXPECT_EQ(plan.channels, 1);
    EXPECT_TRUE(plan.omissions.empty());
}

TEST(Plan, EveryStageIsNamedOnceWithAReason)
{
    const Plan plan = plan_for(needs_of(Scene{}), {});
    std::set<std::string> names;
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(plan.stages[i].kind), i);
        EXPECT_FALSE(plan.stages[i].on);
        EXPECT_FALSE(plan.stages[i].reason.empty());
        names.insert(to_string(plan.stages[i].kind));
    }
    EXPECT_EQ(names.size(), 14u);
}

TEST(Plan, EachAdditionTurnsOnItsOwnStage)
{
    const std::set<StageKind> before = stages_on(plan_for(needs_of(plain_room()), {}));
    const auto added_by = [&](const std::function<void(Scene&)>& change) {
        Scene scene = plain_room();
        change(scene);
        std::set<StageKind> on = stages_on(plan_for(needs_of(scene), {}));
        for (const StageKind kind : before)
            EXPECT_EQ(on.erase(kind), 1u);
        return on;
    };
    using enum StageKind;
    EXPECT_EQ(added_by([](Scene& s) { add_square(s, Mirror{Spectrum::grey(0.9)}, 3); }),
              (std::set{virtual_sources, mirror_rays}));
    EXPECT_EQ(added_by([](Scene& s) {
                  add_square(s, Plastic{Spectrum::grey(0.5), 0.1, 0.1}, 3);
              }),
              (std::set{glossy_rays}));
    EXPECT_EQ(added_by([](Scene& s) {
                  add_square(s, Trans{Spectrum::grey(0.5), 0, 0, 0.5, 0}, 3);
              }),
              (std::set{diffuse_transmission}));
    EXPECT_EQ(added_by([](Scene& s) { add_square(s, Dielectric{Spectrum::grey(1)}, 3); }),
              (std::set{transparent_bodies}));
    EXPECT_EQ(added_by([](Scene& s) { add_square(s, Glass{Spectrum::grey(1)}, 3); }), (std::set{mirror_rays}));
    EXPECT_EQ(added_by([](Scene& s) {
                  add_square(s, Illum{Spectrum::grey(1), ""}, 3);
              }),
              (std::set{secondary_sources}));
    EXPECT_EQ(added_by([](Scene& s) {
                  add_square(s, Spotlight{Spectrum::grey(1), 30}, 3);
              }),
              (std::set{spotlight_cones}));
    EXPECT_EQ(added_by([](Scene& s) {
                  for (int i = 0; i < 3; ++i)
                      add_square(s, Light{Spectrum::grey(1)}, 3 + i);
              }),
              (std::set{adaptive_testing}));
}

TEST(Plan, PanesGuideRaysOnlyWhereThereIsASky)
{
    Scene scene = plain_room();
    add_square(scene, Glass{Spectrum::grey(0.9)}, 3);
    EXPECT_FALSE(plan_for(needs_of(scene), {}).uses(StageKind::openings));
    scene.root.add_source({{0, 0, 1}, 180}, scene.add_material("sky", Glow{Spectrum::grey(1)}), "dome");
    const Plan plan = plan_for(needs_of(scene), {});
    EXPECT_TRUE(plan.uses(StageKind::openings));
    EXPECT_TRUE(plan.uses(StageKind::sky));
    EXPECT_FALSE(plan.uses(StageKind::patterns));
}

TEST(Plan, NamesCurvedMirrorsWithTheirAreaAndWhatComesByWayOfThem)
{
    Scene scene = plain_room(); // 8 m2
    const ModifierId mirror = scene.add_material("chrome", Mirror{Spectrum::grey(0.5)});
    scene.root.add_sphere({{9, 9, 0}, std::sqrt(2 / pi)}, Shape::sphere, mirror, "ball"); // 8 m2
    const Plan plan = plan_for(needs_of(scene), {});
    EXPECT_FALSE(plan.uses(StageKind::virtual_sources));
    ASSERT_EQ(plan.omissions.size(), 1u);
    EXPECT_NE(plan.omissions[0].what.find("1 surface, 8 m2"), std::string::npos) << plan.omissions[0].what;
    EXPECT_NE(plan.omissions[0].effect.find("25 %"), std::string::npos) << plan.omissions[0].effect; // 0.5 * 8 / 16
}

TEST(Plan, MirrorsMakeNoVirtualSourcesWithoutLampsOrWhenSwitchedOff)
{
    Scene scene = plain_room();
    add_square(scene, Mirror{Spectrum::grey(0.9)}, 3);
    PlanWish off;
    off.virtual_depth = 0;
    EXPECT_FALSE(plan_for(needs_of(scene), off).uses(StageKind::virtual_sources));
    EXPECT_TRUE(plan_for(needs_of(scene), {}).uses(StageKind::virtual_sources));
}

TEST(Plan, WhatSurroundsThePlacesDecidesHowManyBouncesMatter)
{
    const Surroundings bright{0, 0.9, 3};
    EXPECT_EQ(plan_for(needs_of(plain_room()), {0.01}, bright).bounces, 44);
    EXPECT_EQ(plan_for(needs_of(plain_room()), {0.01}).bounces, 7);
}

TEST(Plan, RefusesAnAccuracyThatIsNone)
{
    for (const double accuracy : {0.0, -1.0, 1.0, std::nan(""), HUGE_VAL})
        EXPECT_THROW(plan_for(SceneNeeds{}, {accuracy}), InputError) << accuracy;
}

} // namespace
} // namespace lightwell
