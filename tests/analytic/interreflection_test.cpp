#include "tests/analytic/expect.h"

namespace lightwell {
namespace {

/// In a closed sphere every point sees the rest uniformly: E = E_own / (1 - reflectance), for a small lamp anywhere
/// the mean, for a uniformly glowing wall exactly M / (1 - reflectance).
Simulation sphere_with_lamp(double reflectance, double lamp_radius)
{
    Scene scene;
    const ModifierId wall = scene.add_material("wall", Plastic{Spectrum::grey(reflectance), 0, 0});
    const ModifierId lamp = scene.add_material("lamp", Light{Spectrum::grey(1000 / lumens_per_watt)});
    scene.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble, wall, "room");
    scene.root.add_sphere({{0, 0, 0}, lamp_radius}, Shape::sphere, lamp, "lamp");
    return Simulation(std::move(scene));
}

/// A lamp of radius a in the middle: direct E = pi L a^2. It hides a share of the wall, s = a^2 of each point's
/// cosine-weighted view, so that E = pi L a^2 / (1 - reflectance (1 - a^2)).
TEST(ClosedSphere, InterreflectionSumsToTheGeometricSeries)
{
    for (const double reflectance : {0.2, 0.8, 0.95, 0.99}) {
        SCOPED_TRACE(reflectance);
        const double a = 0.1, direct = pi * 1000 * a * a;
        const double expected = direct / (1 - reflectance * (1 - a * a));
        const Simulation sphere = sphere_with_lamp(reflectance, a);
        expect_agrees(pooled_illuminance_at(sphere, {{0, 0, -1 + 1e-9}, {0, 0, 1}}, 1 << 15), expected, 0.02, 1e-8,
                      pooled_interval); // the sensor lies 1e-9 off the wall, nearer to the lamp
    }
}

/// White furnace: in a uniform environment a surface that absorbs nothing cannot be told from it.
TEST(Furnace, MaterialsReflectNoMoreThanTheyReceiveAndWhiteReflectsItAll)
{
    struct Case {
        const char* name;
        Material material;
        double expected; ///< luminance of a sphere's middle for an environment of 1000; negative: at most
    };
    const Spectrum white = Spectrum::grey(1);
    for (const Case& c :
         {Case{"white diffuse", Plastic{white, 0, 0}, 1000}, Case{"grey", Plastic{white * 0.5, 0, 0}, 500},
          Case{"glossy", Plastic{white, 0.1, 0.2}, -1000}, Case{"metal", Metal{white, 1, 0.3}, -1000},
          Case{"polished metal", Metal{white, 1, 0}, -1000}, Case{"rough plastic", Plastic{white, 0.05, 0.3}, -1000},
          Case{"smooth plastic", Plastic{white, 0.05, 0}, -1000}, Case{"mirror", Mirror{white * 0.9}, 900},
          Case{"glass ball", Dielectric{white, 1.5, 0}, 1000}, Case{"thin glass", Glass{white, 1.52}, 1000},
          Case{"trans", Trans{white, 0.05, 0.1, 0.5, 0.3}, -1000},
          Case{"trans without loss", Trans{white, 0, 0, 0.6, 0}, 1000}}) {
        SCOPED_TRACE(c.name);
        Scene scene;
        const ModifierId sky = scene.add_material("sky", Glow{Spectrum::grey(1000 / lumens_per_watt), 0});
        scene.root.add_source({{0, 0, 1}, 360}, sky, "all_around");
        scene.root.add_sphere({{0, 0, 0}, 1}, Shape::sphere, scene.add_material("m", c.material), "ball");
        const Simulation simulation(std::move(scene));
        PictureSettings settings;
        settings.width = settings.height = 1;
        settings.samples = 1 << 15;
        View view;
        view.position = {0.3, -4, 0.2};
        view.horizontal = view.vertical = 0.01;
        const Picture picture = simulation.render(view, settings).picture;
        const double found = lumens_per_watt * picture.at("G", 0, 0),
                     error = lumens_per_watt * picture.at("error.G", 0, 0);
        if (c.expected > 0)
            expect_agrees({found, error}, c.expected, 0.02, 1e-6);
        else
            EXPECT_LE(found, -c.expected + interval * error + 1e-3);
    }
}

} // namespace
} // namespace lightwell
