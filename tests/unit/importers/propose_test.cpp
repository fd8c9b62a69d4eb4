#include "importers/layer_words.h"
#include "importers/layers.h"
#include "materials/library.h"

#include <gtest/gtest.h>

#include <set>

namespace lightwell {
namespace {

std::string proposed(const std::string& layer, const std::string& material = {}, const std::string& block = {})
{
    SurfaceKey key;
    key.layer = layer;
    key.material = material;
    key.block = block;
    return propose_material(key);
}

struct Expected {
    const char* layer;
    const char* material;
};

class Proposals : public testing::TestWithParam<Expected> {};

TEST_P(Proposals, NameGetsTheMaterialThatAPersonWouldChoose)
{
    EXPECT_EQ(proposed(GetParam().layer), GetParam().material) << GetParam().layer;
}

constexpr Expected aia[] = {{"A-WALL", "generic_wall"},
                            {"A-WALL-FULL", "generic_wall"},
                            {"A-WALL-PRHT", "generic_wall"},
                            {"AI-WALL-MOVE-N", "generic_wall"},
                            {"a-wall-full-e", "generic_wall"},
                            {"A-WALL-PATT", ""},
                            {"A-WALL-IDEN", ""},
                            {"A-ANNO-DIMS", ""},
                            {"A-FLOR", "generic_floor"},
                            {"A-FLOR-CARP", "carpet"},
                            {"A-FLOR-TILE", "floor_tile"},
                            {"A-FLOR-WOOD", "wood_floor"},
                            {"A-FLOR-STRS", "concrete"},
                            {"A-FLOR-HRAL", "stainless_steel"},
                            {"A-FLOR-EVTR", "stainless_steel"},
                            {"A-FLOR-TPTN", "generic_wall"},
                            {"A-FLOR-WDWK", "generic_furniture"},
                            {"A-CLNG", "generic_ceiling"},
                            {"A-CLNG-SUSP", "generic_ceiling"},
                            {"A-CLNG-TILE", "acoustic_ceiling_tile"},
                            {"A-GLAZ", "glass_double_clear"},
                            {"A-GLAZ-CURT", "glass_double_clear"},
                            {"A-GLAZ-SILL", "white_gloss_paint"},
                            {"A-GLAZ-FRAM", "anodised_aluminium"},
                            {"A-DOOR", "light_wood"},
                            {"A-DOOR-GLAZ", "glass_double_clear"},
                            {"A-DOOR-FRAM", "white_gloss_paint"},
                            {"A-ROOF", "light_roof"},
                            {"A-COLS", "concrete"},
                            {"S-COLS", "concrete"},
                            {"S-BEAM-STEL", "steel"},
                            {"S-SLAB-CONC", "concrete"},
                            {"S-FNDN", "concrete"},
                            {"I-FURN-SEAT", "generic_furniture"},
                            {"Q-CASE", "generic_furniture"},
                            {"P-FIXT", "sanitary_porcelain"},
                            {"M-HVAC-DUCT", "grey_plastic"},
                            {"A-EQPM", "grey_plastic"},
                            {"E-LITE", "luminaire_panel"},
                            {"E-LITE-CLNG", "luminaire_panel"},
                            {"E-LITE-EXIT", "exit_sign"},
                            {"L-PLNT-TREE", "foliage"},
                            {"L-PLNT-TURF", "grass"},
                            {"L-SITE-FENC", "painted_steel"},
                            {"C-ROAD", "asphalt"},
                            {"C-PKNG", "asphalt"},
                            {"C-TOPO", "ground"},
                            {"C-BLDG", "outside_facade"}};
constexpr Expected codes[] = {{"A-G25-M", "generic_wall"},
                              {"A-G25-M_Walls", "generic_wall"},
                              {"A-G251-M_ExternalWalls", "generic_wall"},
                              {"A-G22-M", "concrete"},
                              {"A-G24-M", "light_roof"},
                              {"A-G32-M_Doors", "light_wood"},
                              {"A-G32-M", "glass_double_clear"},
                              {"A-G54-M", "luminaire_panel"},
                              {"A-G25---E-", "generic_wall"},
                              {"A-210---E-", "generic_wall"},
                              {"A-27----E-N0104", "light_roof"},
                              {"A-31----E-", "glass_double_clear"},
                              {"A-35----E-", "generic_ceiling"},
                              {"A-43----E-", "generic_floor"},
                              {"E-63----E-", "luminaire_panel"},
                              {"A-74----E-", "sanitary_porcelain"},
                              {"A210G7", "generic_wall"},
                              {"A315G501", "light_wood"},
                              {"A210G701_WALL_L1", "generic_wall"},
                              {"A-(22)-G", "generic_wall"},
                              {"A-EF_25_10-M", "generic_wall"},
                              {"A-EF_25_30-M", "glass_double_clear"},
                              {"A-EF_30_10-M_Roof", "light_roof"},
                              {"A-EF_35_10-M", "concrete"},
                              {"A-EF_70_80-M", "luminaire_panel"}};
constexpr Expected english[] = {{"Walls", "generic_wall"},
                                {"ExternalWalls", "generic_wall"},
                                {"Concrete Wall", "concrete"},
                                {"concrete_light", "light_concrete"},
                                {"Brick", "red_brick"},
                                {"Yellow brick", "buff_brick"},
                                {"Curtain Wall", "glass_double_clear"},
                                {"Curtain Wall Mullions", "anodised_aluminium"},
                                {"Curtains", "curtain_light"},
                                {"Window Frame", "white_gloss_paint"},
                                {"Windows", "glass_double_clear"},
                                {"Frosted Glass", "glass_frosted"},
                                {"Glass - triple low-e", "glass_triple_low_e"},
                                {"Skylights", "glass_double_clear"},
                                {"Ceiling Lights", "luminaire_panel"},
                                {"Light wood", "light_wood"},
                                {"Light", "luminaire_panel"},
                                {"Lamp post", "painted_steel"},
                                {"Floor lamp", "luminaire_panel"},
                                {"Downlights", "spot_lens"},
                                {"LED panel", "luminaire_panel"},
                                {"TV Screen", "screen"},
                                {"Oak floor", "oak"},
                                {"hardwood", "wood_floor"},
                                {"Handrails", "stainless_steel"},
                                {"Lawn", "grass"},
                                {"Tree trunks", "bark"},
                                {"Car park", "asphalt"},
                                {"Carport", ""},
                                {"Neighbouring buildings", "outside_facade"},
                                {"Mirror", "mirror"},
                                {"Venetian blinds", "blind_white"},
                                {"Kitchen cabinets", "white_laminate"},
                                {"Plasterboard", "gypsum_board"},
                                {"Textured plaster", "white_plaster"},
                                {"White paint", "white_paint"},
                                {"Dark grey carpet", "dark_carpet"},
                                {"Dark Grey", "dark_grey_paint"},
                                {"Stainless Steel", "stainless_steel"},
                                {"Green roof", "grass"},
                                {"Roof tiles", "terracotta"},
                                {"0", ""},
                                {"Layer 1", ""},
                                {"Defpoints", ""},
                                {"xyzzy", ""},
                                {"", ""}};
constexpr Expected german[] = {{"Außenwände", "generic_wall"},
                               {"AUSSENWAENDE", "generic_wall"},
                               {"Innenwand", "generic_wall"},
                               {"Stahlbetonwand", "concrete"},
                               {"Sichtbeton", "concrete"},
                               {"Ziegelmauerwerk", "red_brick"},
                               {"Fenster", "glass_double_clear"},
                               {"Fensterrahmen", "white_gloss_paint"},
                               {"Isolierverglasung", "glass_double_clear"},
                               {"Glastür", "glass_single_clear"},
                               {"Türen", "light_wood"},
                               {"Decke", "generic_ceiling"},
                               {"Deckenleuchten", "luminaire_panel"},
                               {"Akustikdecke", "acoustic_ceiling_tile"},
                               {"Fußboden", "generic_floor"},
                               {"Holzboden", "wood_floor"},
                               {"Bodenplatte", "concrete"},
                               {"Teppichfliesen", "carpet"},
                               {"Dachziegel", "terracotta"},
                               {"Dachfenster", "glass_double_clear"},
                               {"Treppengeländer", "stainless_steel"},
                               {"Stützen", "concrete"},
                               {"Möbel", "generic_furniture"},
                               {"Schränke", "generic_furniture"},
                               {"Edelstahl", "stainless_steel"},
                               {"Spiegel", "mirror"},
                               {"Rasen", "grass"},
                               {"Bäume", "foliage"},
                               {"Gelände", "ground"},
                               {"Straße", "asphalt"},
                               {"Putz", "white_plaster"},
                               {"Gipskartonplatten", "gypsum_board"},
                               {"dunkelgrau", "dark_grey_paint"},
                               {"Nachbargebäude", "outside_facade"},
                               {"Vorhangfassade", "glass_double_clear"},
                               {"Bemaßung", ""}};
constexpr Expected french[] = {{"Murs extérieurs", "generic_wall"},
                               {"Cloisons", "generic_wall"},
                               {"Faux plafond", "generic_ceiling"},
                               {"Plancher", "generic_floor"},
                               {"Dalle béton", "concrete"},
                               {"Toiture", "light_roof"},
                               {"Fenêtres", "glass_double_clear"},
                               {"Vitrage", "glass_double_clear"},
                               {"Menuiseries fenêtre", "white_gloss_paint"},
                               {"Mur-rideau", "glass_double_clear"},
                               {"Portes", "light_wood"},
                               {"Escalier", "concrete"},
                               {"Mobilier", "generic_furniture"},
                               {"Luminaires", "luminaire_panel"},
                               {"Éclairage", "luminaire_panel"},
                               {"Parquet chêne", "oak"},
                               {"Carrelage sol", "floor_tile"},
                               {"Moquette", "carpet"},
                               {"Briques", "red_brick"},
                               {"Poteaux", "concrete"},
                               {"Pelouse", "grass"},
                               {"Arbres", "foliage"},
                               {"Cotes", ""}};
constexpr Expected spanish[] = {{"Muros", "generic_wall"},
                                {"Paredes", "generic_wall"},
                                {"Tabiques", "generic_wall"},
                                {"Techo", "generic_ceiling"},
                                {"Piso", "generic_floor"},
                                {"Losa de hormigón", "concrete"},
                                {"Ventanas", "glass_double_clear"},
                                {"Vidrio", "glass_single_clear"},
                                {"Puertas", "light_wood"},
                                {"Escaleras", "concrete"},
                                {"Columnas", "concrete"},
                                {"Muebles", "generic_furniture"},
                                {"Luminarias", "luminaire_panel"},
                                {"Iluminación", "luminaire_panel"},
                                {"Madera", "medium_wood"},
                                {"Ladrillo", "red_brick"},
                                {"Alfombra", "carpet"},
                                {"Césped", "grass"},
                                {"Árboles", "foliage"},
                                {"Muro cortina", "glass_double_clear"},
                                {"Espejo", "mirror"},
                                {"Barandilla", "stainless_steel"}};
constexpr Expected italian[] = {{"Muri", "generic_wall"},
                                {"Pareti", "generic_wall"},
                                {"Tramezzi", "generic_wall"},
                                {"Soffitto", "generic_ceiling"},
                                {"Controsoffitto", "generic_ceiling"},
                                {"Pavimento", "generic_floor"},
                                {"Solaio", "concrete"},
                                {"Tetto", "light_roof"},
                                {"Finestre", "glass_double_clear"},
                                {"Vetro", "glass_single_clear"},
                                {"Porta", "light_wood"},
                                {"Scala", "concrete"},
                                {"Pilastri", "concrete"},
                                {"Arredi", "generic_furniture"},
                                {"Illuminazione", "luminaire_panel"},
                                {"Lampade", "luminaire_panel"},
                                {"Legno", "medium_wood"},
                                {"Mattoni", "red_brick"},
                                {"Calcestruzzo", "concrete"},
                                {"Specchio", "mirror"},
                                {"Prato", "grass"},
                                {"Lucernari", "glass_double_clear"}};
constexpr Expected chinese[] = {{"墙", "generic_wall"},
                                {"外墙", "generic_wall"},
                                {"内隔墙", "generic_wall"},
                                {"幕墙", "glass_double_clear"},
                                {"吊顶", "generic_ceiling"},
                                {"地面", "generic_floor"},
                                {"木地板", "wood_floor"},
                                {"楼板", "concrete"},
                                {"屋顶", "light_roof"},
                                {"门", "light_wood"},
                                {"窗户", "glass_double_clear"},
                                {"窗帘", "curtain_light"},
                                {"玻璃", "glass_single_clear"},
                                {"混凝土墙", "concrete"},
                                {"柱子", "concrete"},
                                {"楼梯栏杆", "stainless_steel"},
                                {"家具", "generic_furniture"},
                                {"灯具", "luminaire_panel"},
                                {"不锈钢", "stainless_steel"},
                                {"草坪", "grass"},
                                {"道路", "asphalt"},
                                {"尺寸标注", ""}};

INSTANTIATE_TEST_SUITE_P(Aia, Proposals, testing::ValuesIn(aia));
INSTANTIATE_TEST_SUITE_P(IsoBsUniclass, Proposals, testing::ValuesIn(codes));
INSTANTIATE_TEST_SUITE_P(English, Proposals, testing::ValuesIn(english));
INSTANTIATE_TEST_SUITE_P(German, Proposals, testing::ValuesIn(german));
INSTANTIATE_TEST_SUITE_P(French, Proposals, testing::ValuesIn(french));
INSTANTIATE_TEST_SUITE_P(Spanish, Proposals, testing::ValuesIn(spanish));
INSTANTIATE_TEST_SUITE_P(Italian, Proposals, testing::ValuesIn(italian));
INSTANTIATE_TEST_SUITE_P(Chinese, Proposals, testing::ValuesIn(chinese));

TEST(Propose, FoldsAccentsComposedOrNot)
{
    EXPECT_EQ(folded("Außenwände ÇÉÑØ Łódź"), "aussenwande ceno lodz");
    EXPECT_EQ(folded("Decke\xCC\x88n"), "decken"); // combining diaeresis, as macOS writes file names
    EXPECT_EQ(proposed("Tu\xCC\x88ren"), "light_wood");
}

TEST(Propose, TheFilesMaterialNameSaysMoreThanTheLayerAndTheBlockIsTheLastResort)
{
    EXPECT_EQ(proposed("A-WALL", "Brick.001"), "red_brick");
    EXPECT_EQ(proposed("A-WALL", "Material.001"), "generic_wall");
    EXPECT_EQ(proposed("0", "", "DESK_160x80"), "generic_furniture");
}

TEST(Propose, NamesOfTheLibraryProposeThemselves)
{
    for (const LibraryMaterial& entry : material_library())
        EXPECT_EQ(proposed(entry.name), entry.name == "black" ? "black_paint" : entry.name);
    EXPECT_EQ(proposed("LED-Panel 4000cd"), "led_panel_4000cd");
}

TEST(Propose, EveryProposalIsInTheLibrary)
{
    // Joined with a letter the names are no longer those of the library, but their words are still read.
    std::size_t found = 0;
    for (const LibraryMaterial& entry : material_library()) {
        const std::string material = proposed("x " + entry.name);
        found += material.empty() ? 0 : 1;
        EXPECT_TRUE(material.empty() || find_in_library(material)) << material;
    }
    EXPECT_GE(found, 100u);
}

TEST(Propose, HostileNamesAreSurvived)
{
    const std::vector<std::string> names{std::string(1000000, 'A'),
                                         std::string(100000, '-'),
                                         "\xFF\xFE\x80\xC3",
                                         "\xE5\xA2",
                                         std::string(3, '\0'),
                                         "A-G" + std::string(100000, '9'),
                                         std::string(5000, '('),
                                         "EF_25",
                                         "A-EF_",
                                         "A-EF_2",
                                         "A-EF_25_",
                                         "A-(",
                                         "A-(2",
                                         "A-G",
                                         "A-",
                                         "G25",
                                         "A210",
                                         "A21"};
    for (const std::string& name : names)
        EXPECT_NO_THROW(proposed(name)) << name.substr(0, 20);
}

} // namespace
} // namespace lightwell
