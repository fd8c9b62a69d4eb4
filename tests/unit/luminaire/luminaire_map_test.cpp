#include "engine/base/errors.h"
#include "engine/scene/expansion.h"
#include "engine/simulate/simulate.h"
#include "importers/layers.h"
#include "importers/touching.h"
#include "tests/unit/luminaire/photometric_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// A folder with drawings, luminaires and maps.
class LuminaireRules : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("luminaires_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        write("spot.ies", ies_text([](double t) { return 1000 * std::pow(std::cos(t), 8); }, "-0.1 -0.1 0", 90));
        write("panel.ies", ies_text(lambertian, "0.3 1.2 0", 90)); // 1.2 m along plane 0
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text)
    {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    Imported mapped(Imported imported, const std::string& map)
    {
        hits_ = apply_layer_map(imported, read_layer_map(write("map.toml", map)));
        validate(imported.scene);
        return imported;
    }
    Imported dxf(const std::string& drawing, const std::string& map)
    {
        return mapped(import_dxf(write("plan.dxf", drawing), {}), map);
    }
    std::string complaint(const std::string& map)
    {
        try {
            read_layer_map(write("map.toml", map));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
    fs::path folder_;
    std::vector<RuleHits> hits_;
};

/// `0 SECTION|2 HEADER` as lines of codes and values.
std::string tags(const std::string& pairs)
{
    std::stringstream words(pairs);
    std::string text;
    for (std::string pair; std::getline(words, pair, '|');) {
        const std::size_t blank = pair.find(' ');
        text.append(pair, 0, blank).append("\n").append(pair, blank + 1).append("\n");
    }
    return text;
}

/// A drawing in millimetres: PANEL draws a plate of 1.2 x 0.3 m a metre from its insertion point, SPOT only a line.
std::string drawing(const std::string& entities)
{
    return tags("0 SECTION|2 HEADER|9 $INSUNITS|70 4|0 ENDSEC|0 SECTION|2 BLOCKS|"
                "0 BLOCK|8 0|2 PANEL|70 0|10 0|20 0|30 0|"
                "0 3DFACE|8 0|10 400|20 -150|30 0|11 1600|21 -150|31 0|12 1600|22 150|32 0|13 400|23 150|33 0|"
                "0 ENDBLK|8 0|"
                "0 BLOCK|8 0|2 SPOT|70 0|10 0|20 0|30 0|0 LINE|8 0|10 0|20 0|30 0|11 50|21 0|31 0|0 ENDBLK|8 0|"
                "0 ENDSEC|0 SECTION|2 ENTITIES|" +
                entities + "|0 ENDSEC|0 EOF");
}

/// The instances that luminaires are, in the order of the root.
std::vector<Affine> luminaires(const Scene& scene)
{
    std::vector<Affine> frames;
    for (const Surface& surface : scene.root.surfaces)
        if (surface.name.ends_with("/luminaire"))
            frames.push_back(scene.root.instances[surface.index].to_parent);
    return frames;
}

void expect_near(const Vec3& found, const Vec3& wanted)
{
    EXPECT_NEAR(length(found - wanted), 0, 2e-6) << found.x << ' ' << found.y << ' ' << found.z;
}

double on_floor(Scene scene, const Point& at)
{
    SensorGrid grid;
    grid.sensors = {{at, {0, 0, 1}}};
    GridSettings settings;
    settings.samples = 256;
    return Simulation(std::move(scene)).illuminance(grid, settings).values[0].value;
}

TEST_F(LuminaireRules, ASymbolThatDrawsNothingStandsWhereItIsInserted)
{
    const Imported imported = dxf(drawing("0 INSERT|8 E-LITE|2 SPOT|10 2000|20 3000|30 2800|41 5|42 5|43 5|50 90"),
                                  "[[rule]]\nblock = \"SPOT\"\nluminaire = \"spot.ies\"\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 1U);
    expect_near(frames[0].translation, {2, 3, 2.8});
    expect_near(frames[0].x, {0, 1, 0}); // a quarter turn; the scale of the symbol is none of the light
    expect_near(frames[0].z, {0, 0, 1});
    ASSERT_EQ(hits_.size(), 1U);
    EXPECT_EQ(hits_[0].surfaces, 1U);
    const double wanted = 1000 / (2.8 * 2.8);
    EXPECT_NEAR(on_floor(imported.scene, {2, 3, 0}), wanted, 0.01 * wanted);
}

TEST_F(LuminaireRules, ArraysAndNestedInsertsEachGetTheirs)
{
    const std::string array = "0 INSERT|8 0|2 SPOT|10 0|20 0|30 3000|70 3|71 2|44 1500|45 2000";
    std::string text = drawing(array);
    EXPECT_EQ(
        luminaires(dxf(text, "[[rule]]\nlayer = \"*\"\nblock = \"SP*\"\nluminaire = \"spot.ies\"\n").scene).size(), 6U);
}

TEST_F(LuminaireRules, ABodyOffTheInsertionPointHasTheOpeningBeforeIt)
{
    const Imported imported =
        dxf(drawing("0 INSERT|8 E-LITE|2 PANEL|10 0|20 0|30 3000|50 90"),
            "default = \"white_paint\"\n[[rule]]\nblock = \"PANEL\"\nluminaire = \"panel.ies\"\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 1U);
    expect_near(frames[0].translation, {0, 1, 3});
    const Part& opening = imported.scene.prototypes.back();
    ASSERT_EQ(opening.polygons.size(), 1U);
    for (const Point& corner : opening.points) {
        EXPECT_LT(corner.z, 0);
        EXPECT_GT(corner.z, -0.002);
    }
    // Plane 0 along the block's x, which points to +y: 1.2 m of light there.
    double reach = 0;
    for (const Point& corner : opening.points)
        reach = std::max(reach, std::fabs(corner.x));
    EXPECT_NEAR(reach, 0.6, 1e-9);
}

TEST_F(LuminaireRules, AnEmittingBodyKeepsItsLookAndGivesItsLightOnce)
{
    const std::string rule = "default = \"white_paint\"\n[[rule]]\nlayer = \"E-LITE\"\nuse = \"luminaire_panel\"\n"
                             "[[rule]]\nblock = \"PANEL\"\nluminaire = \"panel.ies\"\n";
    const Imported imported = dxf(drawing("0 INSERT|8 E-LITE|2 PANEL|10 0|20 0|30 3000"), rule);
    bool illum = false, look = false;
    for (const Modifier& modifier : imported.scene.modifiers)
        if (const auto* material = std::get_if<Material>(&modifier.what)) {
            illum = illum || (std::holds_alternative<Illum>(*material) && emitted_radiance(*material).is_black());
            look = look || modifier.name.ends_with(".look");
        }
    EXPECT_TRUE(illum);
    EXPECT_TRUE(look);
    // 1000 cd cos theta from 3 m, spread over 1.2 x 0.3 m: the sum over its pieces.
    double wanted = 0;
    for (int i = 0; i < 60; ++i)
        for (int k = 0; k < 15; ++k) {
            const double x = (i + 0.5) * 0.02 - 0.6, y = (k + 0.5) * 0.02 - 0.15, squared = x * x + y * y + 9;
            wanted += 1000 * 9 / (squared * squared) / 900;
        }
    EXPECT_NEAR(on_floor(imported.scene, {1, 0, 0}), wanted, 0.01 * wanted);
}

TEST_F(LuminaireRules, AimAndTurnAreInTheFrameOfTheInsert)
{
    const Imported imported =
        dxf(drawing("0 INSERT|8 E-LITE|2 SPOT|10 0|20 0|30 2500|50 90"),
            "[[rule]]\nblock = \"SPOT\"\nluminaire = \"spot.ies\"\naim = [1, 0, -1]\nturn = 90\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 1U);
    const double half = std::sqrt(0.5);
    expect_near(-frames[0].z, {0, half, -half}); // the block's x points to +y
    // Plane 0 would look along the block's x, tilted with the light; a quarter turn about the upward axis follows.
    expect_near(frames[0].x, cross(frames[0].z, Vec3{0, half, half}));
}

TEST_F(LuminaireRules, AMirroredInsertMirrorsTheDistribution)
{
    const Imported imported = dxf(drawing("0 INSERT|8 E-LITE|2 SPOT|10 0|20 0|30 2500|41 -1"),
                                  "[[rule]]\nblock = \"SPOT\"\nluminaire = \"spot.ies\"\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_NEAR(frames[0].determinant(), -1, 1e-12);
    const double wanted = 1000 / (2.5 * 2.5);
    EXPECT_NEAR(on_floor(imported.scene, {0, 0, 0}), wanted, 0.01 * wanted);
}

TEST_F(LuminaireRules, GroupsOfTouchingSurfacesInAnObjAreOneLuminaireEach)
{
    // A flat box of 0.3 x 1.2 m and, apart from it, one tilted quad.
    std::string text = "o lamps\n";
    for (const double z : {2.9, 3.0})
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.0}, {0.3, 1.2}, {0.0, 1.2}})
            text += "v " + std::to_string(x) + ' ' + std::to_string(z) + ' ' + std::to_string(-y) + '\n';
    text += "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    text += "v 5 2 0\nv 5 2 -1\nv 6 3 -1\nv 6 3 0\nf 9 10 11 12\n";
    ImportOptions options;
    options.metres_per_unit = 1;
    const Imported imported = mapped(import_obj(write("lamps.obj", text), options),
                                     "default = \"white_paint\"\n[[rule]]\nlayer = \"*\"\nluminaire = \"panel.ies\"\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 2U);
    expect_near(frames[0].translation, {0.15, 0.6, 2.95});
    EXPECT_NEAR(std::fabs(frames[0].x.y), 1, 1e-9) << "the longer side along the longer side";
    expect_near(frames[1].translation, {5.5, 0.5, 2.5});
    const double half = std::sqrt(0.5);
    expect_near(-frames[1].z, {half, 0, -half});
}

TEST_F(LuminaireRules, ANodeOfAGltfIsAimedByItsOwnAxes)
{
    // A quad in the x-z plane of a mesh (y up), turned a quarter about x: its light goes along -y of the node.
    const auto add_floats = [](std::string& bytes, std::initializer_list<float> values) {
        for (const float value : values)
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    std::string bytes;
    add_floats(bytes, {-.5f, 0, -.5f, .5f, 0, -.5f, .5f, 0, .5f, -.5f, 0, -.5f, .5f, 0, .5f, -.5f, 0, .5f});
    write("lamp.bin", bytes);
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"lamp","mesh":0,"translation":[1,2,0],"rotation":[0.7071067811865476,0,0,0.7071067811865476]}],
"meshes":[{"name":"LAMP","primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-0.5,0,-0.5],"max":[0.5,0,0.5]}],
"bufferViews":[{"buffer":0,"byteLength":72}],"buffers":[{"uri":"lamp.bin","byteLength":72}]})";
    const Imported imported =
        mapped(import_gltf(write("lamp.gltf", text), {}),
               "default = \"white_paint\"\n[[rule]]\nblock = \"LAMP\"\nluminaire = \"spot.ies\"\n");
    const std::vector<Affine> frames = luminaires(imported.scene);
    ASSERT_EQ(frames.size(), 1U);
    expect_near(frames[0].translation, {1, 0, 2});
    // -y of the node, turned a quarter about x, is -z of the file, which is +y of the scene.
    expect_near(-frames[0].z, {0, 1, 0});
}

TEST_F(LuminaireRules, WhatIsWrongWithARuleIsNamedWithItsLine)
{
    EXPECT_NE(complaint("[[rule]]\nlayer = \"x\"\naim = [0, 0, -1]\nuse = \"grey_50\"\n").find("map.toml:3"),
              std::string::npos);
    EXPECT_NE(complaint("[[rule]]\nlayer = \"x\"\nluminaire = \"none.ies\"\n").find("map.toml:3"), std::string::npos);
    EXPECT_NE(
        complaint("[[rule]]\nlayer = \"x\"\nluminaire = \"spot.ies\"\naim = [0, 0]\n").find("aim is no direction"),
        std::string::npos);
    EXPECT_NE(complaint("[[rule]]\nlayer = \"x\"\nluminaire = \"spot.ies\"\naim = [0, 0, 0]\n").find("map.toml:4"),
              std::string::npos);
    EXPECT_NE(complaint("[[rule]]\nlayer = \"x\"\nluminaire = \"spot.ies\"\nturn = 999\n").find("-360 to 360"),
              std::string::npos);
    write("broken.ies", "TILT=NONE\n1 1 1 2 1 1 2");
    EXPECT_NE(complaint("[[rule]]\nlayer = \"x\"\nluminaire = \"broken.ies\"\n").find("the file ends before"),
              std::string::npos);
    EXPECT_THROW(dxf(drawing("0 INSERT|8 E-LITE|2 SPOT|10 0|20 0|30 2500"),
                     "[[rule]]\nblock = \"SPOOT\"\nluminaire = \"spot.ies\"\n"),
                 InputError);
}

TEST(TouchingBoxes, MakeGroupsThroughOthers)
{
    const auto box = [](double low, double high) { return Box{{low, 0, 0}, {high, 1, 1}}; };
    const auto groups = touching_groups({box(0, 1), box(5, 6), box(1, 2), box(2.001, 3), box(4, 4.5)});
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0], (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(groups[1], (std::vector<std::size_t>{1}));
    EXPECT_TRUE(touching_groups({}).empty());
}

} // namespace
} // namespace lightwell
