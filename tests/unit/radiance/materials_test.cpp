/// \file Materials with functions, measured scattering and volumes in scene text: read, moved, written, damaged.
#include "engine/scene/varied_materials.h"
#include "materials/placed.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

constexpr const char* ball = " sphere ball 0 0 4 0 0 0 1\n";

const Material& material_in(const Scene& scene)
{
    return *resolve(scene, scene.root.surfaces.back().modifier).material;
}

/// A file of scattering: Klems' quarter basis, the same in all directions.
std::string even_scattering(double value)
{
    std::string data;
    for (int i = 0; i < 41 * 41; ++i)
        data += std::to_string(value) + ' ';
    return "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure>"
           "</DataDefinition><WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock>"
           "<WavelengthDataDirection>Transmission Back</WavelengthDataDirection>"
           "<ColumnAngleBasis>LBNL/Klems Quarter</ColumnAngleBasis><RowAngleBasis>LBNL/Klems Quarter</RowAngleBasis>"
           "<ScatteringData>" +
           data + "</ScatteringData></WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>";
}

void write_files(const SceneFolder& folder)
{
    folder.write("lobe.cal", "lobe(x, y, z) = if(z, .2, .1); angle(x, y, z) = z;");
    folder.write("one.dat", "1\n-1 1 2\n.1 .2\n");
    folder.write("even.xml", even_scattering(0.2));
}

const std::vector<std::string>& all_materials()
{
    static const std::vector<std::string> texts = {
        "void plastic2 m 4 0 1 0 . 0 6 .7 .2 .8 .08 .2 .08\nm",
        "void metal2 m 6 1 0 Px . -rz 30 0 6 .7 .2 .8 .9 .2 .08\nm",
        "void trans2 m 4 0 1 0 . 0 8 .7 .2 .8 .08 .2 .08 .5 .3\nm",
        "void ashik2 m 4 1 0 0 . 0 8 .3 .1 .05 .05 .05 .08 5 30\nm",
        "void plasfunc m 2 lobe lobe.cal 0 4 .7 .2 .8 .5\nm",
        "void metfunc m 4 lobe lobe.cal -s 2 0 5 .7 .2 .8 .5 9\nm",
        "void transfunc m 2 lobe lobe.cal 0 6 .7 .2 .8 .1 .5 .5\nm",
        "void plasdata m 4 noop one.dat lobe.cal angle 0 4 .7 .2 .8 .5\nm",
        "void metdata m 4 noop one.dat lobe.cal angle 0 4 .7 .2 .8 .5\nm",
        "void transdata m 4 noop one.dat lobe.cal angle 0 6 .7 .2 .8 .1 .5 .5\nm",
        "void BRTDfunc m 10 .1 .1 .1 if(Rdot-.8,0,.7) .2 .3 lobe lobe lobe lobe.cal 0 9 .1 .1 .1 .2 .2 .2 .1 .1 .1\nm",
        "void BSDF m 6 0 even.xml 0 0 1 . 0 0\nm",
        "void BSDF m 6 .02 even.xml 0 0 1 . 0 9 .1 .1 .1 .2 .2 .2 .3 .3 .3\nm",
        "void aBSDF m 5 even.xml 0 0 1 . 0 3 .1 .2 .3\nm",
        "void brightfunc half 2 .5 . 0 0\nvoid WGMDfunc m 13 half .3 .1 .2 void .2 .1 .1 void 0 1 0 . 0 9 .1 .1 .1 .2 "
        ".2 "
        ".2 .05 .05 .05\nm",
        "void prism1 m 5 .9 Dx Dy+.1 Dz . 0 0\nm",
        "void prism2 m 9 .4 Dx Dy Dz .5 Dx Dy+.1 Dz . 0 2 1.5 2\nm",
        "void interface m 0 0 8 .9 .8 .7 1.5 .6 .5 .4 1.33\nm",
        "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid antimatter m 1 wall 0 0\nm",
        "void mist m 1 lamp 0 7 .1 .2 .3 .9 .8 .7 .3\nm",
        "void plastic shown 0 0 5 .5 .5 .5 0 0\nvoid mirror m 1 shown 0 3 .9 .8 .7\nm",
    };
    return texts;
}

TEST(SceneMaterials, EveryKindIsReadAndWrittenAndReadsBackTheSame)
{
    for (const std::string& text : all_materials()) {
        SCOPED_TRACE(text);
        const SceneFolder folder;
        write_files(folder);
        Report report;
        const Scene scene = folder.read(text + ball, report);
        const std::string type = type_name(material_in(scene));
        EXPECT_NE(text.find(" " + type + " m "), std::string::npos) << type;
        write_radiance(scene, folder.path("once.rad"), {}, report);
        const Scene again = read_radiance(folder.path("once.rad"), report);
        EXPECT_EQ(type_name(material_in(again)), type);
        write_radiance(again, folder.path("twice.rad"), {}, report);
        EXPECT_EQ(folder.text("once.rad"), folder.text("twice.rad"));
        EXPECT_TRUE(report.notes().empty()) << report.notes()[0].text;
    }
}

TEST(SceneMaterials, FunctionsMoveWithTheFileThatIsPlaced)
{
    const SceneFolder folder;
    folder.write("part.rad", std::string("void metal2 m 4 1 0 0 . 0 6 .5 .5 .5 .9 .2 .08\nm") + ball);
    const Scene scene = folder.read("!xform -rz 90 part.rad");
    Material placed = material_in(scene);
    put_in_place(placed, {});
    const Vec3 grain = std::get<Brushed>(placed).grain.direction;
    EXPECT_NEAR(grain.x, 0, 1e-12);
    EXPECT_NEAR(grain.y, 1, 1e-12);
}

TEST(SceneMaterials, APatternTintsWhatHasAColour)
{
    const SceneFolder folder;
    const Scene scene = folder.read("void brightfunc half 2 .5 . 0 0\n"
                                    "half metal2 m 4 1 0 0 . 0 6 .8 .6 .4 .9 .2 .08\nm" +
                                    std::string(ball));
    SeenMaterial seen;
    VariedMaterials(scene).look(scene.root.surfaces[0].modifier, {}, seen);
    EXPECT_DOUBLE_EQ(std::get<Brushed>(*seen.material).colour.r, 0.4);
}

TEST(SceneMaterials, DamageIsNotedWhereItIsDefinedAndRefusedWhereItIsUsed)
{
    const std::pair<const char*, const char*> cases[] = {
        {"void BSDF m 6 0 missing.xml 0 0 1 . 0 0\nm", "\"missing.xml\" is not found"},
        {"void BSDF m 6 0 broken.xml 0 0 1 . 0 0\nm", "no XML"},
        {"void BSDF m 6 0 even.xml 0 0 1 . 0 2 1 1\nm", "2 numbers, expected 0, 3, 6 or 9"},
        {"void metal2 m 4 1 0 nothing . 0 6 .8 .6 .4 .9 .2 .08\nm", "nothing"},
        {"void metal2 m 4 1 0 0 . 0 5 .8 .6 .4 .9 .2\nm", "5 numbers, expected at least 6"},
        {"void metal2 m 4 1 0 0 . 0 6 .8 .6 .4 1.9 .2 .1\nm", "specularity is 1.9"},
        {"void plasdata m 4 noop missing.dat . angle 0 4 1 1 1 1\nm", "missing.dat"},
        {"void prism1 m 2 .9 Dx 0 0\nm", "the words end before"},
        {"void ashik2 m 4 1 0 0 . 0 8 .3 .1 .05 .05 .05 .08 -5 30\nm", "power of the highlight is -5"},
        {"void WGMDfunc m 13 void 1 1 1 void 1 1 1 void 0 0 1 . 0 9 .9 .9 .9 0 0 0 .2 .2 .2\nm",
         "front and transmittance together is 1.1"},
    };
    for (const auto& [text, expected] : cases) {
        SCOPED_TRACE(text);
        const SceneFolder folder;
        write_files(folder);
        folder.write("broken.xml", "<a");
        const std::string defined = std::string(text).substr(0, std::string(text).rfind('\n'));
        Report report;
        folder.read(defined, report);
        EXPECT_TRUE(report.has(Finding::unsupported));
        const std::string message = folder.error(text + std::string(ball));
        EXPECT_TRUE(message.starts_with("scene.rad:2: sphere \"ball\": uses ")) << message;
        EXPECT_NE(message.find(expected), std::string::npos) << message;
    }
}

TEST(SceneMaterials, VolumesWithWrongNumbersAreRefused)
{
    const SceneFolder folder;
    EXPECT_NE(folder.error("void mist m 0 0 2 1 1").find("2 numbers, expected 0, 3, 6 or 7"), std::string::npos);
    EXPECT_NE(folder.error("void mist m 0 0 7 1 1 1 .5 .5 .5 1").find("eccentricity is 1"), std::string::npos);
    EXPECT_NE(folder.error("void mist m 0 0 3 -1 1 1").find("extinction per metre is -1"), std::string::npos);
    EXPECT_NE(folder.error("void interface m 0 0 5 1 1 1 1.5 0").find("5 numbers, expected 8"), std::string::npos);
    EXPECT_NE(folder.error("void antimatter m 0 0 0").find("number of modifiers is 0"), std::string::npos);
    EXPECT_NE(folder.error("void antimatter m 1 nothing 0 0").find("\"nothing\" is not defined"), std::string::npos);
}

/// Radiance takes any colour; a saturated paint may be above 1 in one channel, and a pattern may darken what is
/// brighter.
TEST(SceneMaterials, ColoursAboveOneAreHeldAtOneOrLeftToThePatternOrRefused)
{
    const SceneFolder folder;
    Report report;
    const Scene held =
        folder.read(std::string("void plastic m 0 0 5 1.677905 .34403 .600828 .02 .05\nm") + ball, report);
    EXPECT_EQ(std::get<Plastic>(material_in(held)).colour, (Spectrum{1, .34403, .600828}));
    ASSERT_EQ(report.notes().size(), 1u);
    EXPECT_NE(report.notes()[0].text.find("a channel of 1.678"), std::string::npos) << report.notes()[0].text;
    EXPECT_NE(folder.error("void plastic m 0 0 5 1.5 1.2 1 0 0").find("red reflectance is 1.5"), std::string::npos);

    const std::string patterned = "void brightfunc half 2 if(Px,.25,.9) . 0 0\nhalf metal m 0 0 5 2 2 2 0 0\nm";
    Report none;
    const Scene scene = folder.read(patterned + ball, none);
    EXPECT_TRUE(none.notes().empty());
    EXPECT_NO_THROW(validate(scene));
    const VariedMaterials varied(scene);
    for (const double x : {1., -1.}) {
        PatternPlace place;
        place.position = {x, 0, 0};
        SeenMaterial seen;
        varied.look(scene.root.surfaces.back().modifier, place, seen);
        EXPECT_DOUBLE_EQ(std::get<Metal>(*seen.material).colour.g, x > 0 ? 0.5 : 1); // 1.8 is held
    }
    EXPECT_NE(folder.error("void brightfunc half 2 .5 . 0 0\nhalf metal m 0 0 5 nan 2 2 0 0"), "");
    EXPECT_NE(folder.error("void brightfunc half 2 .5 . 0 0\nhalf metal m 0 0 5 -2 2 2 0 0").find("-2, expected >= 0"),
              std::string::npos);
}

TEST(SceneMaterials, AMeshOfVoidTakesTheMaterialsOfItsFile)
{
    const SceneFolder folder;
    folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 2 4 3\nf 1 2 4\n");
    folder.write("two.mat", "void plastic a 0 0 5 .1 .1 .1 0 0\nvoid plastic b 0 0 5 .2 .2 .2 0 0\n");
    const Scene scene = folder.read("void mesh m 3 two.rtm -s 2 0 0\nvoid mesh again 1 two.obj 0 0\n");
    ASSERT_EQ(scene.prototypes.size(), 1u);
    const Part& part = scene.prototypes[0];
    ASSERT_EQ(part.meshes.size(), 2u);
    EXPECT_EQ(part.meshes[0]->triangles.size(), 3u);
    EXPECT_EQ(part.meshes[1]->triangles.size(), 6u);
    EXPECT_DOUBLE_EQ(std::get<Plastic>(*resolve(scene, part.surfaces[1].modifier).material).colour.g, 0.2);
    folder.write("two.mat", "void plastic a 0 0 5 .1 .1 .1 0 0\n");
    EXPECT_NE(folder.error("void mesh m 1 two.rtm 0 0").find("material \"b\" is not defined"), std::string::npos);
    std::filesystem::remove(folder.path("two.mat"));
    EXPECT_NE(folder.error("void mesh m 1 two.rtm 0 0").find("two.mat\", which is not there"), std::string::npos);
}

} // namespace
} // namespace lightwell
