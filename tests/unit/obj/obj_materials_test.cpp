#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/png.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

/// A folder of its own with one triangle that wears material "M", its library, and pictures; removed afterwards.
class LibraryFolder {
public:
    LibraryFolder()
        : path_(std::filesystem::temp_directory_path() /
                (std::string("lightwell_") + testing::UnitTest::GetInstance()->current_test_info()->name()))
    {
        std::filesystem::create_directories(path_);
    }
    ~LibraryFolder() { std::filesystem::remove_all(path_); }
    LibraryFolder(const LibraryFolder&) = delete;
    LibraryFolder& operator=(const LibraryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

    Imported import(const std::string& library, const std::string& statement = "mtllib m.mtl")
    {
        write_text_atomically(path_ / "m.mtl", "newmtl M\n" + library + "\n");
        write_text_atomically(path_ / "m.obj", statement + "\nusemtl M\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        return import_obj(path_ / "m.obj", {});
    }
    Material material(const std::string& library) { return import(library).file_materials.at(0).second; }

private:
    std::filesystem::path path_;
};

/// Two pixels: sRGB 255 and 0 in red, 188 twice in green (linear 0.502886, IEC 61966-2-1), 0 in blue.
void write_picture(const std::filesystem::path& file)
{
    write_png({2, 1, {255, 188, 0, 0, 188, 0}}, file);
}
constexpr double green = 0.502886;
/// Without blue, the colour lies a little outside the engine's primaries and is brought to their edge.
constexpr double gamut = 1e-2;

TEST(ObjMaterials, APictureCountsWithItsMeanInLinearLightTimesThePlainColour)
{
    LibraryFolder folder;
    write_picture(folder.path() / "wall paper.png");
    const Imported found =
        folder.import("Kd 0.8 0.8 0.8\nillum 1\nmap_Kd -s 2 3 1 -o 0.5 0.25 -clamp on wall paper.png");
    const Spectrum colour = to_rec709(std::get<Plastic>(found.file_materials.at(0).second).colour);
    EXPECT_NEAR(colour.r, 0.4, gamut);
    EXPECT_NEAR(colour.g, 0.8 * green, gamut);
    EXPECT_NEAR(colour.b, 0, gamut);
    EXPECT_EQ(noted(found.report, "wall paper.png: its mean, 0.5 0.503 0, is the average"), 1u);
    ASSERT_EQ(found.file_textures.size(), 1u);
    const FileTexture& texture = found.file_textures[0];
    EXPECT_EQ(texture.material, "M");
    EXPECT_EQ(texture.use, FileTexture::Use::colour);
    EXPECT_EQ(texture.file.filename(), "wall paper.png");
    EXPECT_FALSE(texture.placement.repeats);
    EXPECT_EQ(texture.placement.to_picture, (std::array<double, 6>{2, 0, 0.5, 0, 3, 0.25}));
    EXPECT_NEAR(found.keys.at(0).colour->g, 0.8 * green, 1e-6);
}

TEST(ObjMaterials, PicturesOfOtherValuesCountToo)
{
    LibraryFolder folder;
    write_picture(folder.path() / "a.png");
    const auto rough =
        std::get<Plastic>(folder.material("Kd 0.5 0.5 0.5\nKs 0.1 0.1 0.1\nPr 0.5\nmap_Pr -imfchan g A.PNG"));
    EXPECT_NEAR(rough.roughness, std::pow(0.5 * 188 / 255, 2), 1e-9);
    const auto lamp = std::get<Light>(folder.material("Ke 10 10 10\nmap_Ke textures\\a.png"));
    EXPECT_NEAR(to_rec709(lamp.radiance).g, 10 * green, 10 * gamut);
    const auto alone = std::get<Plastic>(folder.material("Kd 0 0 0\nillum 1\nmap_Kd a.png"));
    EXPECT_NEAR(to_rec709(alone.colour).g, green, gamut);
    const auto half = std::get<Plastic>(folder.material("Kd 1 1 1\nillum 1\nmap_Kd -mm 0.1 0.5 a.png"));
    EXPECT_NEAR(to_rec709(half.colour).g, 0.1 + 0.5 * green, gamut);
}

TEST(ObjMaterials, BumpsAndMissingOrBrokenPicturesAreSaidAndHarmNothing)
{
    LibraryFolder folder;
    write_picture(folder.path() / "a.png");
    write_text_atomically(folder.path() / "b.png", "\x89PNG but no more");
    const Imported found =
        folder.import("Kd 0.5 0.5 0.5\nillum 1\nbump -bm 0.3 a.png\nmap_Kd b.png\nmap_Ks c.png\nrefl "
                      "-type sphere a.png\nmap_d\nmap_Kd -frob a.png\nfrobnicate 1");
    EXPECT_NEAR(to_rec709(std::get<Plastic>(found.file_materials.at(0).second).colour).r, 0.25, gamut); // of a.png
    EXPECT_EQ(noted(found.report, "heights without a unit bend no normals"), 1u);
    EXPECT_EQ(noted(found.report, "cannot be read as PNG"), 1u);
    EXPECT_EQ(noted(found.report, "names \"c.png\", which is not there"), 1u);
    EXPECT_EQ(noted(found.report, "has no meaning for this material"), 1u);
    EXPECT_EQ(noted(found.report, "`map_d` names no file"), 1u);
    EXPECT_EQ(noted(found.report, "texture option `-frob` is not known"), 1u);
    EXPECT_EQ(noted(found.report, "unknown statement `frobnicate`"), 1u);
}

TEST(ObjMaterials, PartialDissolveCoversItsShareAndPassesTheRest)
{
    LibraryFolder folder;
    const auto veil = std::get<Trans>(folder.material("Kd 0.5 0.5 0.5\nd 0.75\nillum 1"));
    EXPECT_NEAR(photopic(veil.colour) * (1 - veil.transmission), 0.75 * 0.5, 1e-9);
    EXPECT_NEAR(photopic(veil.colour) * veil.transmission * veil.transmitted_specular, 0.25, 1e-9);
    EXPECT_TRUE(std::holds_alternative<Glass>(folder.material("Kd 0.5 0.5 0.5\nd 0.25")));
    EXPECT_TRUE(std::holds_alternative<Plastic>(folder.material("Kd 0.5 0.5 0.5\nTr 0\nillum 1")));
}

TEST(ObjMaterials, TheStatementsOfThePhysicallyBasedSetAreTaken)
{
    LibraryFolder folder;
    const auto cloth = std::get<Plastic>(folder.material("Kd 0 0 0\nillum 1\nPr 0.6\nPs 1 1 1"));
    EXPECT_NEAR(cloth.colour.g, 0.192, 1e-6); // the table's value at roughness 0.6
    const auto coated = std::get<Plastic>(folder.material("Kd 0.5 0.5 0.5\nillum 1\nPc 1\nPcr 0.5"));
    EXPECT_NEAR(coated.specularity, 0.04, 1e-9);
    EXPECT_NEAR(coated.roughness, 0.25, 1e-9);
    const Imported brushed =
        folder.import("Kd 0.5 0.5 0.5\nPm 1\nPr 0.3\naniso 0.8\nanisor 0.1\nKa 1 1 1\nsharpness 60");
    EXPECT_TRUE(std::holds_alternative<Metal>(brushed.file_materials.at(0).second));
    EXPECT_EQ(noted(brushed.report, "taken as round"), 1u);
    EXPECT_EQ(noted(brushed.report, "unknown statement"), 0u);
}

TEST(ObjMaterials, ColoursMayBeXyzAndSpectralOnesAreSaid)
{
    LibraryFolder folder;
    // x y z of the white of Rec.709 (D65) times a half
    const auto grey = std::get<Plastic>(folder.material("Kd xyz 0.475235 0.5 0.544415\nillum 1"));
    EXPECT_NEAR(to_rec709(grey.colour).r, 0.5, 2e-4);
    EXPECT_NEAR(to_rec709(grey.colour).b, 0.5, 2e-4);
    const Imported curve = folder.import("Kd spectral wood.rfl 1\nillum 1");
    EXPECT_EQ(noted(curve.report, "names a spectral curve"), 1u);
}

TEST(ObjMaterials, ALibraryIsFoundInOtherCapitalsAndByTheNameOfTheModel)
{
    LibraryFolder folder;
    EXPECT_EQ(folder.import("Kd 1 0 0", "mtllib M.MTL").file_materials.size(), 1u);
    EXPECT_EQ(folder.import("Kd 1 0 0", "mtllib C:\\models\\m.mtl").file_materials.size(), 1u);
    const Imported renamed = folder.import("Kd 1 0 0", "mtllib before.mtl");
    EXPECT_EQ(renamed.file_materials.size(), 1u);
    EXPECT_EQ(noted(renamed.report, "stands in for the material library"), 1u);
    EXPECT_TRUE(folder.import("Kd 1 0 0", "# no library named").file_materials.empty());
}

TEST(ObjMaterials, ThousandsOfMaterialsAreReadInReasonableTime)
{
    LibraryFolder folder;
    std::string library;
    for (int i = 0; i < 50000; ++i)
        library += "newmtl m" + std::to_string(i) + "\nKd 0.5 0.5 0.5\nillum 1\n";
    EXPECT_EQ(folder.import("Kd 1 0 0\n" + library).file_materials.size(), 50001u);
}

} // namespace
} // namespace lightwell
