#include "engine/base/errors.h"
#include "importers/layers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

/// A square on a layer, of a material of the file.
void square(Imported& imported, const std::string& layer, const std::string& material = {}, double y = 0)
{
    SurfaceKey key;
    key.layer = layer;
    key.material = material;
    key.entity = "face";
    KeyTable keys{imported};
    imported.scene.root.add_polygon({{0, y, 0}, {1, y, 0}, {1, y, 1}, {0, y, 1}}, keys.modifier_for(key), layer);
    imported.ledger.made("face", layer);
}

LayerMap read(const std::string& text)
{
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("extended-" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << text;
    const LayerMap map = read_layer_map(file);
    std::filesystem::remove(file);
    return map;
}

std::string extended(const Imported& imported, const std::string& text)
{
    return extend_layer_map(imported, read(text), text);
}

Imported house()
{
    Imported imported;
    square(imported, "A-WALL");
    square(imported, "A-FLOR");
    square(imported, "A-FURN", "Oak");
    square(imported, "A-FURN", "Chrome");
    return imported;
}

TEST(ExtendMap, AProposalIsNotTouchedByASecondOne)
{
    const std::string text = propose_layer_map(house());
    EXPECT_EQ(extended(house(), text), text);
}

TEST(ExtendMap, HandEditsCommentsAndOrderSurviveAndOnlyWhatIsMissingIsAdded)
{
    const std::string text = "# my map, do not touch\n\n[[rule]]   # floors first\nlayer   = 'A-FLOR'\n"
                             "use = \"carpet\" # chosen by hand\n[[rule]]\nlayer = \"A-WALL\"\nuse=\"concrete\"";
    const std::string more = extended(house(), text);
    EXPECT_TRUE(more.starts_with(text + "\n\n# --- proposed for what had no rule\n[[rule]]")) << more;
    EXPECT_EQ(more.find("A-WALL", text.size()), std::string::npos) << more;
    EXPECT_NE(more.find("layer = \"A-FURN\"", text.size()), std::string::npos) << more;
    EXPECT_EQ(extended(house(), more), more) << "a third time changes nothing";
    Imported imported = house();
    apply_layer_map(imported, read(more));
    EXPECT_FALSE(imported.report.has(Finding::unmapped));
}

TEST(ExtendMap, WhereARuleIsForSomeMaterialsOfALayerTheOthersAreNamedOneByOne)
{
    const std::string text = "[[rule]]\nlayer = \"A-[WF][AL]*\"\nuse = \"concrete\"\n"
                             "[[rule]]\nmaterial = \"Oak\"\nuse = \"walnut\"\n";
    const std::string more = extended(house(), text);
    EXPECT_NE(more.find("layer = \"A-FURN\"\nmaterial = \"Chrome\"\nuse = \"chrome\""), std::string::npos) << more;
    Imported imported = house();
    apply_layer_map(imported, read(more));
    EXPECT_EQ(summarize_layers(imported)[1].material, "walnut, chrome") << "the hand's rule for oak still decides";
}

TEST(ExtendMap, ADefaultIsNoRule)
{
    const std::string text = "default = \"grey_50\"\n";
    EXPECT_NE(extended(house(), text), text);
}

TEST(ProposeMap, ShowsTheFilesOwnMaterialBesideTheProposedOne)
{
    Imported imported = house();
    imported.file_materials = {{"Oak", Plastic{Spectrum::grey(0.25), 0, 0}}};
    EXPECT_NE(propose_layer_map(imported).find("file:Oak is plastic, 25 %"), std::string::npos)
        << propose_layer_map(imported);
    EXPECT_EQ(summarize_layers(imported)[1].file_material, "Oak (plastic, 25 %)");
}

TEST(ProposeMap, ParallelSheetsOfPlainGlassAreProposedAsDoublePanes)
{
    Imported one, two;
    square(one, "Glass");
    square(two, "Glass");
    square(two, "Glass", {}, 0.02);
    EXPECT_NE(propose_layer_map(one).find("use = \"glass_single_clear\""), std::string::npos);
    EXPECT_NE(propose_layer_map(two).find("use = \"glass_double_clear\"  # 1 pairs"), std::string::npos)
        << propose_layer_map(two);
}

} // namespace
} // namespace lightwell
