#include "engine/scene/scene_hash.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Scene one_triangle(double x, double reflectance)
{
    Scene scene;
    const ModifierId grey = scene.add_material("grey", Plastic{Spectrum::grey(reflectance)});
    scene.root.add_polygon({{x, 0, 0}, {1, 0, 0}, {0, 1, 0}}, grey, "t");
    return scene;
}

TEST(SceneHash, ChangesWithGeometryAndMaterialsAndNotWithViews)
{
    const std::uint64_t hash = scene_hash(one_triangle(0, 0.5));
    EXPECT_EQ(hash, scene_hash(one_triangle(0, 0.5)));
    EXPECT_NE(hash, scene_hash(one_triangle(1e-12, 0.5)));
    EXPECT_NE(hash, scene_hash(one_triangle(0, 0.5000001)));
    Scene seen = one_triangle(0, 0.5);
    seen.views.emplace_back();
    EXPECT_EQ(hash, scene_hash(seen));
    Scene moved = one_triangle(0, 0.5);
    moved.prototypes.emplace_back();
    moved.root.add_instance({0, Affine::translate({0, 0, 1}), {}}, "i");
    Scene elsewhere = one_triangle(0, 0.5);
    elsewhere.prototypes.emplace_back();
    elsewhere.root.add_instance({0, Affine::translate({0, 0, 2}), {}}, "i");
    EXPECT_NE(scene_hash(moved), scene_hash(elsewhere));
}

/// A wall named through a layer, and a lamp.
Scene room(double reflectance, double radiance, bool swapped = false)
{
    Scene scene;
    const ModifierId paint = scene.add_material("paint", Plastic{Spectrum::grey(reflectance)});
    const ModifierId layer = scene.add_modifier({"A-WALL", Alias{paint}});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(radiance)});
    scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, swapped ? lamp : layer, "wall");
    scene.root.add_polygon({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, swapped ? layer : lamp, "lamp");
    return scene;
}

TEST(SceneFingerprint, NamesThePartThatChanged)
{
    const SceneFingerprint before = scene_fingerprint(room(0.5, 100));
    ASSERT_EQ(before.modifiers.size(), 3u);
    EXPECT_EQ(before.modifiers[0].first, "name \"A-WALL\"");
    EXPECT_EQ(before.modifiers[1].first, "material \"paint\"");
    EXPECT_EQ(before.modifiers[2].first, "source \"lamp\"");
    const SceneFingerprint repainted = scene_fingerprint(room(0.6, 100));
    EXPECT_EQ(before.geometry, repainted.geometry);
    EXPECT_EQ(before.assignment, repainted.assignment);
    EXPECT_EQ(before.modifiers[0], repainted.modifiers[0]);
    EXPECT_NE(before.modifiers[1], repainted.modifiers[1]);
    EXPECT_EQ(before.modifiers[2], repainted.modifiers[2]);
    EXPECT_NE(before.modifiers[2], scene_fingerprint(room(0.5, 101)).modifiers[2]);
}

TEST(SceneFingerprint, SeesWhichSurfaceHasWhichMaterial)
{
    EXPECT_NE(scene_hash(room(0.5, 100)), scene_hash(room(0.5, 100, true)));
    Scene turned = room(0.5, 100);
    std::swap(turned.root.surfaces[0].modifier, turned.root.surfaces[1].modifier);
    EXPECT_EQ(scene_fingerprint(turned).geometry, scene_fingerprint(room(0.5, 100)).geometry);
    EXPECT_NE(scene_hash(turned), scene_hash(room(0.5, 100)));
}

TEST(SceneFingerprint, DoesNotSeeUnusedMaterialsNorNames)
{
    Scene scene = room(0.5, 100);
    scene.add_material("spare", Plastic{Spectrum::grey(0.1)});
    EXPECT_EQ(scene_hash(scene), scene_hash(room(0.5, 100)));
    scene.modifiers[0].name = "white paint";
    EXPECT_EQ(scene_hash(scene), scene_hash(room(0.5, 100)));
}

TEST(SceneFingerprint, SeesWhatAnIllumLooksLikeAndWhatAnInstanceBinds)
{
    const auto window = [](double transmissivity, bool bound_to_first) {
        Scene scene;
        scene.add_material("pane", Glass{Spectrum::grey(transmissivity)});
        const ModifierId illum = scene.add_material("window", Illum{Spectrum::grey(1), "pane"});
        const ModifierId inherited = scene.add_modifier({"0", Inherited{}});
        const ModifierId first = scene.add_material("a", Plastic{Spectrum::grey(0.1)});
        const ModifierId second = scene.add_material("b", Plastic{Spectrum::grey(0.9)});
        Part part;
        part.add_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, inherited, "p");
        scene.prototypes.push_back(part);
        scene.root.add_polygon({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, illum, "w");
        scene.root.add_instance({0, Affine{}, {{inherited, bound_to_first ? first : second}}}, "i");
        return scene_hash(scene);
    };
    EXPECT_EQ(window(0.8, true), window(0.8, true));
    EXPECT_NE(window(0.8, true), window(0.7, true));
    EXPECT_NE(window(0.8, true), window(0.8, false));
}

} // namespace
} // namespace lightwell
