#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace lightwell {
namespace {

double number()
{
    return *rc::gen::map(rc::gen::inRange(-1'000'000, 1'000'000), [](int i) { return i / 7919.0; });
}
double positive()
{
    return *rc::gen::map(rc::gen::inRange(1, 1'000'000), [](int i) { return i / 3571.0; });
}
double share()
{
    return *rc::gen::map(rc::gen::inRange(0, 1000), [](int i) { return i / 1009.0; });
}
Vec3 vector()
{
    return {number(), number(), number()};
}
Spectrum colour()
{
    return {share(), share(), share()};
}
std::string name()
{
    return *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127));
}
Direction direction()
{
    Vec3 v = vector();
    v.z += v == Vec3{} ? 1 : 0;
    return normalized(v);
}

Material material()
{
    switch (*rc::gen::inRange(0, 8)) {
    case 0:
        return Plastic{colour(), share(), share()};
    case 1:
        return Metal{colour(), share(), share()};
    case 2:
        return Trans{colour(), share(), share(), share(), share()};
    case 3:
        return Dielectric{colour() * 0.5 + Spectrum::grey(0.1), 1 + share(), number()};
    case 4:
        return Glass{colour(), 1 + share()};
    case 5:
        return Mirror{colour()};
    case 6:
        return Glow{colour() * 100, number()};
    default:
        return Light{colour() * 1e6};
    }
}

/// A surface of any kind but mesh and instance, away from degenerate cases.
void add_surface(Part& part, ModifierId modifier)
{
    const std::string id = name();
    switch (*rc::gen::inRange(0, 5)) {
    case 0: {
        const Point p = vector();
        const double a = positive(), b = positive();
        part.add_polygon({p, p + Vec3{a, 0, 0}, p + Vec3{a, b, 0}, p + Vec3{0, b, 0}}, modifier, id);
        break;
    }
    case 1:
        part.add_sphere({vector(), positive()}, *rc::gen::element(Shape::sphere, Shape::bubble), modifier, id);
        break;
    case 2: {
        const Point p = vector();
        part.add_cone({{p, p + Vec3{0, 1, positive()}}, {positive(), positive()}},
                      *rc::gen::element(Shape::cone, Shape::cup), modifier, id);
        break;
    }
    case 3: {
        const Point p = vector();
        const double r = positive();
        part.add_cone({{p, p + Vec3{positive(), 0, 1}}, {r, r}}, *rc::gen::element(Shape::cylinder, Shape::tube),
                      modifier, id);
        break;
    }
    default: {
        const double r = positive();
        part.add_ring({vector(), direction(), r, r + positive()}, modifier, id);
    }
    }
}

Affine map_of_any_kind()
{
    Affine map =
        compose(Affine::rotate(2, number()), compose(Affine::rotate(1, number()), Affine::rotate(0, number())));
    const double scale = positive();
    map = compose(map, Affine::scale({*rc::gen::element(-scale, scale), scale, scale}));
    map.translation = vector();
    return map;
}

Scene arbitrary_scene()
{
    Scene scene;
    scene.root.name = name();
    const int modifiers = *rc::gen::inRange(1, 6);
    for (int i = 0; i < modifiers; ++i) {
        if (i > 0 && *rc::gen::arbitrary<bool>())
            scene.add_modifier({name(), Alias{*rc::gen::inRange(0, i)}, void_modifier});
        else
            scene.add_material(name(), material());
    }
    const auto any_modifier = [&] { return static_cast<ModifierId>(*rc::gen::inRange(0, modifiers)); };
    const int prototypes = *rc::gen::inRange(0, 4);
    for (int k = 0; k <= prototypes; ++k) {
        Part part;
        part.name = name();
        const int surfaces = *rc::gen::inRange(1, 5);
        for (int i = 0; i < surfaces; ++i) {
            if (k > 0 && *rc::gen::inRange(0, 3) == 0)
                part.add_instance({static_cast<std::uint32_t>(*rc::gen::inRange(0, k)), map_of_any_kind(), {}}, name());
            else
                add_surface(part, any_modifier());
        }
        if (k < prototypes)
            scene.prototypes.push_back(std::move(part));
        else
            scene.root = std::move(part);
    }
    return scene;
}

void assert_same_world(const Scene& a, const Scene& b)
{
    const std::vector<WorldSurface> x = world_surfaces(a), y = world_surfaces(b);
    RC_ASSERT(x.size() == y.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        RC_ASSERT(x[i].type == y[i].type);
        RC_ASSERT(x[i].modifier == y[i].modifier);
        RC_ASSERT(x[i].material == y[i].material);
        RC_ASSERT(x[i].numbers.size() == y[i].numbers.size());
        double size = 1;
        for (const double value : x[i].numbers)
            size = std::fmax(size, std::fabs(value));
        for (std::size_t k = 0; k < x[i].numbers.size(); ++k)
            RC_ASSERT(std::fabs(x[i].numbers[k] - y[i].numbers[k]) <= 1e-10 * size);
    }
}

TEST(SceneRoundTrip, AnySceneComesBackAsItWas)
{
    const SceneFolder folder;
    EXPECT_TRUE(rc::check("scene -> text -> scene", [&] {
        const Scene scene = arbitrary_scene();
        Report report;
        write_radiance(scene, folder.path("out.rad"), {}, report);
        const Scene again = read_radiance(folder.path("out.rad"), report);
        validate(again);
        assert_same_world(scene, again);
    }));
}

TEST(SceneRoundTrip, WithoutInstancesEveryBitComesBackAndTheSecondTextIsTheFirst)
{
    const SceneFolder folder;
    EXPECT_TRUE(rc::check("text -> scene -> text", [&] {
        Scene scene;
        scene.root.name = name();
        const ModifierId paint = scene.add_material(name(), material());
        for (int i = *rc::gen::inRange(1, 8); i > 0; --i)
            add_surface(scene.root, paint);
        Report report;
        write_radiance(scene, folder.path("out.rad"), {}, report);
        const std::string first = folder.text("out.rad");
        const Scene again = read_radiance(folder.path("out.rad"), report);
        write_radiance(again, folder.path("out.rad"), {}, report);
        RC_ASSERT(folder.text("out.rad") == first);
        RC_ASSERT(again.root.points == scene.root.points);
    }));
}

TEST(SceneRoundTrip, FlatTextHoldsTheSameSurfaces)
{
    const SceneFolder folder;
    EXPECT_TRUE(rc::check("scene -> flat text -> scene", [&] {
        const Scene scene = arbitrary_scene();
        Report report;
        write_radiance(scene, folder.path("out.rad"), {true, 1e-3}, report);
        const Scene again = read_radiance(folder.path("out.rad"), report);
        RC_ASSERT(again.prototypes.empty());
        assert_same_world(scene, again);
    }));
}

} // namespace
} // namespace lightwell
