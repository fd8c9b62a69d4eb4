#include "engine/base/files.h"
#include "engine/pictures/png.h"
#include "engine/scene/scene_hash.h"
#include "engine/scene/varied_materials.h"
#include "engine/simulate/simulate.h"
#include "importers/laid_pictures.h"
#include "importers/layers.h"
#include "materials/patterns/place_function.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

#include <cmath>

/// \file Pictures that the materials of a file lay on its surfaces: what is seen there, and what the average is.
namespace lightwell {
namespace {

/// IEC 61966-2-1: sRGB 188 and 128 in linear light.
constexpr double linear_188 = 0.502886, linear_128 = 0.215861;
constexpr const char* gltf_fixtures = LIGHTWELL_ROOT "/tests/fixtures/gltf/";

/// A square of 2 m at the origin with (0, 0) to (1, 1) across it, dressed by the library's lines for material M.
Scene dressed_square(const SceneFolder& folder, const std::string& library, Report* report = nullptr,
                     const std::string& face = "f 1/1 2/2 3/3 4/4")
{
    folder.write("m.mtl", "newmtl M\nillum 1\n" + library + "\n");
    const std::filesystem::path file =
        folder.write("m.obj", "mtllib m.mtl\nusemtl M\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 "
                              "1\nvt 0 1\n" +
                                  face + "\n");
    ImportOptions options;
    options.up = "z";
    Imported imported = import_obj(file, options);
    apply_layer_map(imported, {});
    if (report != nullptr)
        report->add(imported.report);
    return std::move(imported.scene);
}

/// What is seen from straight above, with an even sky of radiance 1 or a sun, green channel.
double seen(Scene scene, const Point& at, const DistantSource& source, double radiance)
{
    const ModifierId light = source.full_angle_deg > 90 ? scene.add_material("sky", Glow{Spectrum::grey(radiance), 0})
                                                        : scene.add_material("sun", Light{Spectrum::grey(radiance)});
    scene.root.add_source(source, light, "light");
    validate(scene);
    const Simulation simulation(scene);
    View view;
    view.kind = View::Kind::parallel;
    view.position = at + Vec3{0, 0, 1};
    view.direction = {0, 0, -1};
    view.up = {0, 1, 0};
    view.horizontal = view.vertical = 1e-3;
    PictureSettings settings;
    settings.width = settings.height = 8;
    settings.samples = 256;
    settings.unbiased = true;
    const Picture picture = simulation.render(view, settings).picture;
    double sum = 0;
    for (const float value : picture.channels.at("G"))
        sum += value;
    return sum / 64;
}

/// A convex surface under an even sky of radiance 1 shows its reflectance.
double reflectance_at(const Scene& scene, const Point& at)
{
    return seen(scene, at, {{0, 0, 1}, 360}, 1);
}

constexpr double sun_radiance = 1e5, sun_angle_deg = 0.5;

/// Cosine between the sun and the normal that a matt square of reflectance 0.5 seems to have.
double cosine_under_sun(const Scene& scene, const Direction& to_sun)
{
    const double solid_angle = pi * std::pow(std::sin(sun_angle_deg / 2 * radians_per_degree), 2);
    return seen(scene, {0.3, 0.2, 0}, {normalized(to_sun), sun_angle_deg}, sun_radiance) /
           (sun_radiance * solid_angle * 0.5 / pi);
}

/// Four columns: sRGB 188, 188, 128, 128 in grey; eight rows alike.
void write_halves(const std::filesystem::path& file)
{
    DisplayPicture picture{4, 8, {}};
    for (int i = 0; i < 32; ++i)
        picture.rgb.insert(picture.rgb.end(), 3, i % 4 < 2 ? 188 : 128);
    write_png(picture, file);
}

TEST(LaidPictures, ASurfaceShowsThePictureOfItsMaterialAndTheMaterialItsMean)
{
    const SceneFolder folder;
    write_halves(folder.path("halves.png"));
    const Scene scene = dressed_square(folder, "Kd 0.8 0.8 0.8\nmap_Kd halves.png");
    EXPECT_NEAR(reflectance_at(scene, {-0.7, 0.3, 0}), 0.8 * linear_188, 2e-3);
    EXPECT_NEAR(reflectance_at(scene, {0.7, -0.3, 0}), 0.8 * linear_128, 2e-3);
    const auto* material = resolve(scene, scene.root.surfaces.at(0).modifier).material;
    EXPECT_NEAR(std::get<Plastic>(*material).colour.g, 0.8 * (linear_188 + linear_128) / 2, 1e-5);
}

TEST(LaidPictures, ScaleAndOffsetAreKeptAndThePictureBeginsAnewOrItsRimGoesOn)
{
    const SceneFolder folder;
    write_halves(folder.path("halves.png"));
    const Scene repeated = dressed_square(folder, "Kd 1 1 1\nmap_Kd -s 2 1 -o 0.5 0 halves.png");
    // u in the picture is 2 u + 0.5: at x = -0.7, u = 0.15, 0.8; at x = -0.2, u = 0.4, 1.3 and again 0.3
    EXPECT_NEAR(reflectance_at(repeated, {-0.7, 0, 0}), linear_128, 2e-3);
    EXPECT_NEAR(reflectance_at(repeated, {-0.2, 0, 0}), linear_188, 2e-3);
    const Scene clamped = dressed_square(folder, "Kd 1 1 1\nmap_Kd -s 2 1 -o 0.5 0 -clamp on halves.png");
    EXPECT_NEAR(reflectance_at(clamped, {-0.2, 0, 0}), linear_128, 2e-3);
}

TEST(LaidPictures, WithoutCoordinatesOrWithAnotherMaterialOfTheMapNothingIsLaid)
{
    const SceneFolder folder;
    write_halves(folder.path("halves.png"));
    const Scene plain = dressed_square(folder, "Kd 1 1 1\nmap_Kd halves.png", nullptr, "f 1 2 3 4");
    EXPECT_EQ(plain.root.polygons.size(), 1u);
    EXPECT_NEAR(reflectance_at(plain, {-0.7, 0.3, 0}), (linear_188 + linear_128) / 2, 2e-3);
    EXPECT_FALSE(VariedMaterials(plain).any());

    Imported imported = import_obj(folder.path("m.obj"), {});
    LayerMap map;
    map.default_material = "grey_50";
    apply_layer_map(imported, map);
    EXPECT_FALSE(VariedMaterials(imported.scene).any());
}

TEST(LaidPictures, APictureOfNormalsTurnsWithTheCoordinatesOfTheSurface)
{
    const SceneFolder folder;
    // 204, 128, 204 of 255: 0.6 to the right, 0.004 up, 0.6 outwards
    DisplayPicture slope{2, 2, {}};
    for (int i = 0; i < 4; ++i)
        slope.rgb.insert(slope.rgb.end(), {204, 128, 204});
    write_png(slope, folder.path("slope.png"));
    const std::string library = "Kd 0.5 0.5 0.5\nnorm slope.png";
    const double up = 1.0 / 255 / 0.6;
    const auto expected = [&](const Vec3& normal, const Vec3& to_sun) {
        return dot(normalized(normal), normalized(to_sun));
    };
    const Vec3 sun{0.2, 0, 1};
    EXPECT_NEAR(cosine_under_sun(dressed_square(folder, library), sun), expected({1, up, 1}, sun), 2e-3);
    // The picture's right is the world's y, its upper side the world's -x.
    const Scene turned = dressed_square(folder, library, nullptr, "f 1/4 2/1 3/2 4/3");
    EXPECT_NEAR(cosine_under_sun(turned, sun), expected({-up, 1, 1}, sun), 2e-3);
    EXPECT_NEAR(cosine_under_sun(turned, {0, 0.2, 1}), expected({-up, 1, 1}, {0, 0.2, 1}), 2e-3);
    const Scene weaker = dressed_square(folder, "Kd 0.5 0.5 0.5\nnorm -bm 0.5 slope.png");
    EXPECT_NEAR(cosine_under_sun(weaker, sun), expected({0.5, up / 2, 1}, sun), 2e-3);
}

TEST(LaidPictures, ATextureTurnsWithItsTransformAndWithInstances)
{
    // rtrace of Radiance 6.1a: 0.95193 where the normal is bent by 1 towards a sun at 45 degrees in y, else 0.47596
    const SceneFolder folder;
    const std::string sun = "void light l 0 0 3 1e5 1e5 1e5\nl source sun 0 0 4 0 1 1 .5\n";
    const auto plate = [](const std::string& slope) {
        return "void texfunc slope " + slope +
               " 0 0\nslope plastic p 0 0 5 .5 .5 .5 0 0\np ring r 0 0 8 0 0 0 0 0 1 "
               "0 2\n";
    };
    folder.write("plate.rad", plate("4 1 0 0 ."));
    const auto radiance = [&](const std::string& text) {
        Scene scene = folder.read(text);
        const DistantSource below{{0, 0, -1}, 0.1}; // lights nothing that is seen
        return seen(scene, {0.3, 0.2, 0}, below, 1);
    };
    EXPECT_NEAR(radiance(sun + plate("4 1 0 0 .")), 0.475964, 2e-3);
    EXPECT_NEAR(radiance(sun + plate("6 1 0 0 . -rz 90")), 0.951928, 2e-3);
    EXPECT_NEAR(radiance(sun + "void instance i 3 plate.rad -rz 90 0 0\n"), 0.951928, 2e-3);
    EXPECT_NEAR(radiance(sun + "void instance i 5 plate.rad -s 3 -rz 90 0 0\n"), 0.951928, 2e-3);
}

TEST(LaidPictures, SceneTextSaysTheSame)
{
    const SceneFolder folder;
    write_halves(folder.path("halves.png"));
    write_png({1, 1, {204, 128, 204}}, folder.path("slope.png"));
    const Scene scene = dressed_square(folder, "Kd 1 1 1\nmap_Kd halves.png\nnorm slope.png");
    Report report;
    write_radiance(scene, folder.path("out.rad"), {}, report);
    const Scene again = read_radiance(folder.path("out.rad"), report);
    const Vec3 sun{0.2, 0, 1};
    for (const double x : {-0.7, 0.7}) {
        const double here = seen(scene, {x, 0, 0}, {normalized(sun), 0.5}, 1e5);
        EXPECT_GT(here, 0.1);
        EXPECT_NEAR(seen(again, {x, 0, 0}, {normalized(sun), 0.5}, 1e5), here, 1e-3 * here);
    }
}

TEST(LaidPictures, PicturesInsideAGlbAreLaidAndWrittenBesideTheText)
{
    const SceneFolder folder;
    Imported imported = import_gltf(std::string(gltf_fixtures) + "looks.glb", {});
    EXPECT_TRUE(pictured_materials(imported.file_textures).contains("Pictured"));
    apply_layer_map(imported, {});
    const ModifierId material = imported.scene.find_modifier("Pictured.material");
    ASSERT_NE(material, void_modifier); // the layer has the shorter name
    const ModifierId picture = imported.scene.modifiers[static_cast<std::size_t>(material)].parent;
    ASSERT_NE(picture, void_modifier) << "no mesh of the material has coordinates";
    const auto& pattern = std::get<Varying>(imported.scene.modifiers[static_cast<std::size_t>(picture)].what);
    PatternPlace place;
    place.texture = {0.2, 0.9};
    const Spectrum found = pattern.function->at(place); // all pixels are alike: each is the mean
    EXPECT_NEAR(found.r, 1, 1e-6);
    EXPECT_NEAR(found.g, 1, 1e-6);
    const ModifierId normals = imported.scene.modifiers[static_cast<std::size_t>(picture)].parent;
    ASSERT_NE(normals, void_modifier);
    place.along_u = {0, 2, 0};
    place.along_v = {-1, 0, 0};
    // 0, 128, 255: -1 to the right, which is y; 1/255 up, which is -x; 1 outwards; half of it
    const Vec3 bend =
        std::get<Varying>(imported.scene.modifiers[static_cast<std::size_t>(normals)].what).function->bend_at(place);
    EXPECT_NEAR(length(bend - Vec3{-0.5 / 255, -0.5, 0}), 0, 1e-6);

    Report report;
    write_radiance(imported.scene, folder.path("looks.rad"), {}, report);
    const Scene again = read_radiance(folder.path("looks.rad"), report);
    EXPECT_TRUE(VariedMaterials(again).any());
}

TEST(LaidPictures, APictureThatIsGoneWhenItIsLaidLeavesTheMean)
{
    const SceneFolder folder;
    write_halves(folder.path("halves.png"));
    folder.write("m.mtl", "newmtl M\nillum 1\nKd 1 1 1\nmap_Kd halves.png\n");
    const auto file = folder.write("m.obj", "mtllib m.mtl\nusemtl M\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 "
                                            "1\nf 1/1 2/2 3/3\n");
    Imported imported = import_obj(file, {});
    write_text_atomically(folder.path("halves.png"), "\x89PNG cut");
    apply_layer_map(imported, {});
    EXPECT_FALSE(VariedMaterials(imported.scene).any());
    const auto left_out = [](const Note& note) { return note.text.find("picture left out") != std::string::npos; };
    EXPECT_EQ(std::count_if(imported.report.notes().begin(), imported.report.notes().end(), left_out), 1);
}

TEST(LaidPictures, AnotherPictureOfTheSameMeanIsAnotherSceneForCaches)
{
    const SceneFolder folder;
    const std::string text = "void colorpict p 7 red green blue p.png . Px Py 0 0\np plastic m 0 0 5 1 1 1 0 0\n"
                             "m sphere s 0 0 4 0 0 0 1\n";
    std::vector<std::uint64_t> laid, written;
    for (const std::uint8_t left : {188, 128, 188}) {
        const std::uint8_t right = left == 188 ? 128 : 188;
        write_png({2, 1, {left, left, left, right, right, right}}, folder.path("p.png"));
        laid.push_back(scene_hash(dressed_square(folder, "Kd 1 1 1\nmap_Kd p.png")));
        written.push_back(scene_hash(folder.read(text)));
    }
    EXPECT_NE(laid[0], laid[1]);
    EXPECT_EQ(laid[0], laid[2]);
    EXPECT_NE(written[0], written[1]);
    EXPECT_EQ(written[0], written[2]);
}

TEST(LaidPictures, NumbersThatAreNoneAndMaterialsWithoutColourLeaveTheMean)
{
    std::vector<FileTexture> textures(5);
    for (FileTexture& texture : textures)
        texture.use = FileTexture::Use::colour;
    textures[0].placement.to_picture[2] = std::numeric_limits<double>::quiet_NaN();
    textures[2].use = textures[3].use = textures[4].use = FileTexture::Use::normal;
    textures[2].strength[0] = std::numeric_limits<double>::infinity();
    Report report;
    settle_pictures(textures, 0, Plastic{}, false, "here", report);
    EXPECT_TRUE(pictured_materials(textures).empty()); // the first of each kind counts
    for (const bool passes : {false, true}) {
        std::vector<FileTexture> one(1, textures[1]);
        settle_pictures(one, 0, Glass{}, passes, "here", report);
        EXPECT_EQ(one[0].laid, passes);
        settle_pictures(one, 0, Light{}, passes, "here", report);
        EXPECT_FALSE(one[0].laid);
    }
}

TEST(LaidPictures, AHugePictureIsMadeSmallerWithoutChangingItsMean)
{
    ImageFile image;
    image.width = 2048;
    image.height = 1024;
    image.rgba.resize(std::size_t{4} * 2048 * 1024, 255);
    for (std::size_t i = 0; i < image.rgba.size(); i += 8)
        image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = 0;
    const PictureTable table = PictureTable::of_image(image, true);
    EXPECT_LE(static_cast<std::size_t>(table.width()) * static_cast<std::size_t>(table.height()),
              PictureTable::most_laid_pixels);
    EXPECT_NEAR(table.at(0.7, 0.4).g, 0.5, 1e-6);
}

} // namespace
} // namespace lightwell
