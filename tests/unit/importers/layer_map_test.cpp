#include "materials/library.h"
#include "tests/unit/importers/layer_maps.h"

namespace lightwell {
namespace {

TEST_F(LayerMaps, TheLastMatchingRuleWins)
{
    face(on("A-WALL"));
    face(on("A-WALL-GLAZ"));
    face(on("A-FLOR"));
    apply(R"(
default = "grey_20"
[[rule]]
layer = "A-*"
use = "white_paint"
[[rule]]
layer = "*GLAZ"
use = "glass_double_clear"
)");
    EXPECT_EQ(material_of("A-WALL"), "white_paint");
    EXPECT_EQ(material_of("A-WALL-GLAZ"), "glass_double_clear");
    EXPECT_EQ(material_of("A-FLOR"), "white_paint");
    EXPECT_FALSE(imported_.report.has(Finding::unmapped));
}

TEST_F(LayerMaps, EveryWordOfARuleMustFit)
{
    SurfaceKey key = on("L", "CIRCLE");
    key.block = "LAMP";
    key.group = "g1";
    key.material = "m1";
    key.colour = Spectrum{1, 0, 0};
    face(key);
    face(on("L"));
    apply(R"(
default = "grey_20"
[[rule]]
layer = "l"
group = "g?"
block = "L*"
material = "m[0-9]"
entity = "CIRCLE..LINE"
colour = "#ff0000"
use = "oak"
)");
    EXPECT_EQ(material_of("L/oak"), "oak");
    EXPECT_EQ(material_of("L/grey_20"), "grey_20");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"L/oak", 1}, {"L/grey_20", 1}}));
}

TEST_F(LayerMaps, RangesTakeBothEnds)
{
    for (const char* layer : {"01", "05", "10", "11"})
        face(on(layer));
    apply("default = \"grey_20\"\n[[rule]]\nlayer = \"05..10\"\nuse = \"oak\"\n");
    EXPECT_EQ(material_of("01"), "grey_20");
    EXPECT_EQ(material_of("05"), "oak");
    EXPECT_EQ(material_of("10"), "oak");
    EXPECT_EQ(material_of("11"), "grey_20");
}

TEST_F(LayerMaps, KeysOfALayerWithTheSameMaterialBecomeOneModifier)
{
    for (const char* entity : {"LINE", "3DFACE", "SOLID"})
        face(on("A-WALL", entity));
    face(on("A-FLOR"));
    apply("default = \"white_paint\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"A-WALL", 3}, {"A-FLOR", 1}}));
    EXPECT_EQ(imported_.scene.modifiers.size(), 3u) << "one material, two layers";
}

TEST_F(LayerMaps, WithoutARuleTheFilesOwnMaterialCountsThenGreyWithANote)
{
    imported_.file_materials.emplace_back("Brick", Plastic{Spectrum::grey(0.25), 0, 0});
    SurfaceKey own = on("house");
    own.material = "Brick";
    face(own);
    face(on("A-GLAZ"));
    face(on("xyzzy"));
    apply("");
    EXPECT_EQ(material_of("house"), "Brick");
    EXPECT_EQ(material_of("A-GLAZ"), "grey_50");
    ASSERT_EQ(imported_.report.notes().size(), 2u);
    EXPECT_EQ(imported_.report.notes()[0].finding, Finding::unmapped);
    EXPECT_NE(imported_.report.notes()[0].text.find("it could be glass_double_clear"), std::string::npos);
    EXPECT_NE(imported_.report.notes()[1].text.find("layer \"xyzzy\" has no material: set to grey_50"),
              std::string::npos);
}

TEST_F(LayerMaps, AMaterialOfTheFileCanBeNamedAlsoBesideOneOfTheLibrary)
{
    imported_.file_materials.emplace_back("concrete", Plastic{Spectrum::grey(0.11), 0, 0});
    face(on("a"));
    face(on("b"));
    apply("default = \"concrete\"\n[[rule]]\nlayer = \"a\"\nuse = \"file:concrete\"\n");
    EXPECT_EQ(typical_reflectance(*resolve(imported_.scene, imported_.scene.find_modifier("a")).material).g, 0.11);
    EXPECT_NEAR(typical_reflectance(*resolve(imported_.scene, imported_.scene.find_modifier("b")).material).g, 0.3,
                1e-12);
}

TEST_F(LayerMaps, ALayerMayHaveTheNameOfAMaterial)
{
    face(on("oak"));
    face(on("floor"));
    apply("default = \"oak\"\n[[rule]]\nlayer = \"oak\"\nuse = \"glass_opal\"\n");
    EXPECT_EQ(type_name(*resolve(imported_.scene, imported_.scene.find_modifier("oak")).material), "trans");
    EXPECT_EQ(type_name(*resolve(imported_.scene, imported_.scene.find_modifier("floor")).material), "plastic");
    std::map<std::string, int> names;
    for (const Modifier& modifier : imported_.scene.modifiers)
        EXPECT_EQ(++names[modifier.name], 1) << modifier.name;
}

TEST_F(LayerMaps, VoidDropsSurfacesAndTheLedgerStaysBalanced)
{
    face(on("A-WALL"));
    face(on("A-ANNO", "SOLID"));
    face(on("A-ANNO", "SOLID"));
    const std::size_t read = imported_.ledger.read_count();
    apply("default = \"grey_50\"\n[[rule]]\nlayer = \"A-ANNO\"\nuse = \"void\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"A-WALL", 1}}));
    EXPECT_EQ(imported_.scene.root.polygons.size(), 1u);
    EXPECT_EQ(imported_.ledger.read_count(), read);
    EXPECT_EQ(imported_.ledger.made_count(), 1u);
    ASSERT_EQ(imported_.ledger.skipped_list().size(), 1u);
    EXPECT_EQ(imported_.ledger.skipped_list()[0].type, "SOLID");
    EXPECT_EQ(imported_.ledger.skipped_list()[0].layer, "A-ANNO");
    EXPECT_EQ(imported_.ledger.skipped_list()[0].count, 2u);
}

TEST_F(LayerMaps, AnEntityOfSeveralSurfacesIsDroppedOnce)
{
    const ModifierId modifier = keys_.modifier_for(on("X"));
    for (int i = 0; i < 3; ++i)
        square(imported_.scene.root, modifier, "2F", i);
    imported_.ledger.made();
    apply("default = \"void\"\n");
    EXPECT_EQ(imported_.ledger.made_count(), 0u);
    EXPECT_EQ(imported_.ledger.read_count(), 1u);
}

TEST_F(LayerMaps, EntitiesGatheredInAMeshAreDroppedByTheirNumber)
{
    auto mesh = std::make_shared<Mesh>();
    mesh->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->triangles = {0, 1, 2};
    imported_.scene.root.add_mesh(mesh, keys_.modifier_for(on("X", "face")), "f1");
    imported_.ledger.made(40);
    imported_.made_with_key = {40};
    apply("default = \"void\"\n");
    EXPECT_EQ(imported_.ledger.made_count(), 0u);
    EXPECT_EQ(imported_.ledger.read_count(), 40u);
}

/// A block with one face on layer 0, inserted on several layers.
class Blocks : public LayerMaps {
protected:
    void block()
    {
        SurfaceKey zero = on("0");
        zero.block = "B";
        inherited_ = keys_.inherited(zero);
        Part part;
        part.name = "B";
        square(part, inherited_, "b1");
        SurfaceKey fixed = on("STEEL");
        fixed.block = "B";
        square(part, keys_.modifier_for(fixed), "b2", 1);
        imported_.scene.prototypes.push_back(part);
        imported_.ledger.made(2);
    }
    void insert(const std::string& layer, double x)
    {
        SurfaceKey key = on(layer);
        key.block = "B";
        imported_.scene.root.add_instance({0, Affine::translate({x, 0, 0}), {{inherited_, keys_.modifier_for(key)}}},
                                          "i" + layer);
        imported_.ledger.made();
    }
    ModifierId inherited_ = 0;
};

TEST_F(Blocks, InstancesKeepTheirLayersAndShareThePrototype)
{
    block();
    insert("CHAIR", 0);
    insert("DESK", 2);
    apply("default = \"grey_50\"\n[[rule]]\nlayer = \"DESK\"\nuse = \"oak\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"CHAIR", 1}, {"DESK", 1}, {"STEEL", 2}}));
    EXPECT_EQ(imported_.scene.prototypes.size(), 1u);
}

TEST_F(Blocks, AVoidLayerDropsOnlyTheFacesOfItsInstances)
{
    block();
    insert("CHAIR", 0);
    insert("DESK", 2);
    insert("DESK", 4);
    apply("default = \"grey_50\"\n[[rule]]\nlayer = \"DESK\"\nuse = \"void\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"CHAIR", 1}, {"STEEL", 3}}));
    EXPECT_EQ(imported_.scene.prototypes.size(), 2u);
    EXPECT_EQ(imported_.ledger.made_count(), 5u) << "the face still stands on CHAIR";
}

TEST_F(Blocks, NestedInstancesPassTheLayerOn)
{
    block();
    SurfaceKey outer_key = on("0");
    outer_key.block = "OUTER";
    const ModifierId outer = keys_.inherited(outer_key);
    Part part;
    part.name = "OUTER";
    part.add_instance({0, Affine::translate({0, 0, 5}), {{inherited_, outer}}}, "n1");
    imported_.scene.prototypes.push_back(part);
    for (const char* layer : {"LAMP", "GONE", "WOOD"})
        imported_.scene.root.add_instance({1, {}, {{outer, keys_.modifier_for(on(layer))}}}, layer);
    apply(R"(
default = "grey_50"
[[rule]]
layer = "LAMP"
use = "led_panel_4000cd"
side = "back"
[[rule]]
layer = "GONE"
use = "void"
)");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"LAMP", 1}, {"WOOD", 1}, {"STEEL", 3}}));
    visit_expanded(imported_.scene, [&](const Part& p, const Surface& s, const Affine&, ModifierId m) {
        if (imported_.scene.modifiers[static_cast<std::size_t>(m)].name != "LAMP")
            return;
        const Polygon& polygon = p.polygons[s.index];
        EXPECT_LT(polygon_area_vector(&p.points[polygon.first], polygon.count).z, 0) << "turned over";
    });
}

TEST_F(Blocks, AnInstanceOfNothingGoesWithANote)
{
    block();
    insert("DESK", 2);
    face(on("A-WALL"));
    apply("default = \"void\"\n[[rule]]\nlayer = \"A-WALL\"\nuse = \"grey_50\"\n");
    EXPECT_EQ(by_modifier(), (std::map<std::string, int>{{"A-WALL", 1}}));
    EXPECT_TRUE(imported_.scene.prototypes.empty());
    EXPECT_TRUE(imported_.scene.root.instances.empty());
    EXPECT_TRUE(imported_.report.has(Finding::ignored));
}

TEST_F(LayerMaps, AnOpenEmitterSharesItsFluxBetweenTwoSides)
{
    face(on("LAMPS"));
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"led_panel_4000cd\"\n");
    ASSERT_EQ(imported_.scene.root.polygons.size(), 2u);
    double up = 0;
    for (const Polygon& polygon : imported_.scene.root.polygons)
        up += polygon_area_vector(&imported_.scene.root.points[polygon.first], polygon.count).z;
    EXPECT_EQ(up, 0) << "one looks up, one down";
    // 1 m2 x 2 sides x pi x L = the flux of one side at the stated luminance.
    EXPECT_NEAR(2 * radiance_of("LAMPS") * lumens_per_watt, 4000, 1e-9);
    EXPECT_TRUE(imported_.report.has(Finding::assumed));
    const std::vector<LayerSummary> layers = summarize_layers(imported_);
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].surfaces, 1u) << "as it was drawn";
    EXPECT_NEAR(layers[0].area_m2, 1, 1e-12);
    EXPECT_EQ(layers[0].material, "led_panel_4000cd");
}

TEST_F(LayerMaps, FrontAndBackGiveAllLightToOneSide)
{
    face(on("FRONT"));
    face(on("BACK"));
    apply(R"(
[[rule]]
layer = "FRONT"
use = "led_panel_4000cd"
side = "front"
[[rule]]
layer = "BACK"
use = "led_panel_4000cd"
side = "back"
)");
    const Part& root = imported_.scene.root;
    ASSERT_EQ(root.polygons.size(), 2u);
    EXPECT_EQ(polygon_area_vector(&root.points[root.polygons[0].first], 4).z, 1);
    EXPECT_EQ(polygon_area_vector(&root.points[root.polygons[1].first], 4).z, -1);
    EXPECT_NEAR(radiance_of("FRONT") * lumens_per_watt, 4000, 1e-9);
    EXPECT_NEAR(radiance_of("BACK") * lumens_per_watt, 4000, 1e-9);
}

TEST_F(LayerMaps, ClosedBodiesEmitOutwardsHoweverTheyWereDrawn)
{
    Part& root = imported_.scene.root;
    const ModifierId lamp = keys_.modifier_for(on("LAMPS"));
    cube(root, lamp, true);
    root.add_sphere({{5, 0, 0}, 1}, Shape::bubble, lamp, "s");
    root.add_cone({{{9, 0, 0}, {9, 0, 2}}, {0.5, 0.5}}, Shape::tube, lamp, "c");
    root.add_ring({{9, 0, 2}, {0, 0, -1}, 0, 0.5}, lamp, "lid");
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\nside = \"back\"\n");
    ASSERT_EQ(root.surfaces.size(), 9u);
    for (std::size_t i = 0; i < 6; ++i) {
        const Point* corners = &root.points[root.polygons[i].first];
        EXPECT_GT(dot(polygon_area_vector(corners, 4), (corners[0] + corners[2]) / 2 - Vec3{0.5, 0.5, 0.5}), 0) << i;
    }
    EXPECT_EQ(root.surfaces[6].shape, Shape::sphere);
    EXPECT_EQ(root.surfaces[7].shape, Shape::cylinder);
    EXPECT_EQ(root.rings[0].normal, (Direction{0, 0, 1}));
    EXPECT_NEAR(radiance_of("LAMPS") * lumens_per_watt, 10000, 1e-9);
}

/// Three quarters of a thick ring, its fronts inwards when `inside_out`: corners as drawn, arcs as worked out.
void bent_bar(Part& root, ModifierId lamp, bool inside_out, bool with_ends)
{
    const double sweep = 1.5 * pi, s = std::sqrt(0.5);
    const Point centre{3, 4, 1};
    const Sector sector{{s, s, 0}, sweep};
    const Direction up{0, 0, 1};
    const auto add_ring = [&](double z, const Direction& normal) {
        Ring ring{centre + up * z, up, 1, 2, sector};
        if (normal.z < 0)
            ring = {ring.centre, normal, 1, 2, turned_over(sector, up)};
        root.add_ring(ring, lamp, "bar");
    };
    add_ring(0.5, inside_out ? -up : up);
    add_ring(0, inside_out ? up : -up);
    root.add_cone({{centre, centre + up * 0.5}, {2, 2}, sector}, inside_out ? Shape::tube : Shape::cylinder, lamp,
                  "bar");
    root.add_cone({{centre, centre + up * 0.5}, {1, 1}, sector}, inside_out ? Shape::cylinder : Shape::tube, lamp,
                  "bar");
    if (!with_ends)
        return;
    for (const Vec3& out : {Vec3{s, s, 0}, Vec3{s, -s, 0}}) {
        std::vector<Point> end{centre + out, centre + out * 2, centre + out * 2 + up * 0.5, centre + out + up * 0.5};
        if ((out.y < 0) != inside_out)
            std::reverse(end.begin(), end.end());
        root.add_polygon(end, lamp, "bar");
    }
}

void expect_bar_looks_outwards(const Part& root)
{
    ASSERT_EQ(root.surfaces.size(), 6u);
    EXPECT_EQ(root.rings[0].normal.z, 1);
    EXPECT_EQ(root.rings[1].normal.z, -1);
    EXPECT_TRUE(root.rings[1].sector.holds(root.rings[1].normal, {-1, 0, 0})) << "still the part that was drawn";
    EXPECT_FALSE(root.rings[1].sector.holds(root.rings[1].normal, {1, 0, 0}));
    EXPECT_EQ(root.surfaces[2].shape, Shape::cylinder);
    EXPECT_EQ(root.surfaces[3].shape, Shape::tube);
}

TEST_F(LayerMaps, ABentBarOfPartsOfRoundShapesEmitsOutwards)
{
    bent_bar(imported_.scene.root, keys_.modifier_for(on("LAMPS")), false, true);
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\nside = \"back\"\n");
    expect_bar_looks_outwards(imported_.scene.root);
    EXPECT_NEAR(radiance_of("LAMPS") * lumens_per_watt, 10000, 1e-9);
}

TEST_F(LayerMaps, ABentBarDrawnInsideOutEmitsOutwardsToo)
{
    bent_bar(imported_.scene.root, keys_.modifier_for(on("LAMPS")), true, true);
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\nside = \"back\"\n");
    expect_bar_looks_outwards(imported_.scene.root);
}

TEST_F(LayerMaps, ABentBarWithoutItsEndsIsASheet)
{
    bent_bar(imported_.scene.root, keys_.modifier_for(on("LAMPS")), false, false);
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\n");
    EXPECT_EQ(imported_.scene.root.surfaces.size(), 8u);
    EXPECT_NEAR(radiance_of("LAMPS") * lumens_per_watt, 5000, 1e-9);
}

TEST_F(LayerMaps, ABodyWithAHoleIsASheet)
{
    cube(imported_.scene.root, keys_.modifier_for(on("LAMPS")));
    imported_.scene.root.surfaces.pop_back();
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\n");
    EXPECT_EQ(imported_.scene.root.surfaces.size(), 10u);
    EXPECT_NEAR(radiance_of("LAMPS") * lumens_per_watt, 5000, 1e-9);
}

TEST_F(LayerMaps, ReversedMeshesTurnTheirNormalsToo)
{
    auto mesh = std::make_shared<Mesh>();
    mesh->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->triangles = {0, 1, 2};
    mesh->normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    imported_.scene.root.add_mesh(mesh, keys_.modifier_for(on("LAMPS")), "m");
    apply("[[rule]]\nlayer = \"LAMPS\"\nuse = \"lamp\"\nside = \"back\"\n");
    const Mesh& turned = *imported_.scene.root.meshes.at(0);
    EXPECT_EQ(turned.triangles, (std::vector<std::uint32_t>{0, 2, 1}));
    EXPECT_EQ(turned.normals[0], (Direction{0, 0, -1}));
    EXPECT_EQ(mesh->normals[0], (Direction{0, 0, 1})) << "the file's mesh is shared and stays";
}

TEST_F(LayerMaps, EmittersOfTheFileKeepTheirSide)
{
    imported_.file_materials.emplace_back("Glow", Light{Spectrum::grey(10)});
    SurfaceKey key = on("panel");
    key.material = "Glow";
    face(key);
    apply("");
    EXPECT_EQ(imported_.scene.root.polygons.size(), 1u);
    EXPECT_NEAR(radiance_of("panel"), 10, 1e-12);
}

TEST_F(LayerMaps, BadMapsAreRefusedWithFileAndLine)
{
    face(on("A-WALL"));
    face(on("A-FLOR"));
    struct Bad {
        const char *text, *place, *words;
    };
    for (const Bad& bad : std::initializer_list<Bad>{
             {"default = 3\n", "map.toml:1", "default is 3"},
             {"[[rule]\n", "map.toml:1", "TOML"},
             {"defualt = \"oak\"\n", "map.toml:1", "nearest: default"},
             {"\n[[rule]]\nlayer = \"A-WALL\"\n", "map.toml:2", "which material"},
             {"[[rule]]\nuse = \"oak\"\n", "map.toml:1", "for no surface"},
             {"[[rule]]\nlayer = \"\"\nuse = \"oak\"\n", "map.toml:2", "empty"},
             {"[[rule]]\nlayers = \"A\"\nuse = \"oak\"\n", "map.toml:2", "nearest: layer"},
             {"[[rule]]\nlayer = \"A-WALL\"\nuse = \"oak\"\nside = \"left\"\n", "map.toml:4", "\"back\""},
             {"[[rule]]\ncolour = \"red\"\nuse = \"oak\"\n", "map.toml:2", "#rrggbb"},
             {"[[rule]]\nlayer = \"A-WALL\"\nuse = \"oka\"\n", "map.toml:1", "oak"},
             {"[[rule]]\nlayer = \"NOWHERE\"\nuse = \"oka\"\n", "map.toml:1", "unknown material"},
             {"[[rule]]\nlayer = \"A-WALL\"\nuse = \"file:oak\"\n", "map.toml:1", "unknown material \"file:oak\""},
             {"default = \"nothing_such\"\n", "map.toml", "nothing_such"},
             {"[[rule]]\nlayer = \"A-WALLS\"\nuse = \"oak\"\n", "map.toml:1", "A-WALL"},
             {"[[rule]]\nlayer = \"A-WALL\"\nblock = \"B\"\nuse = \"oak\"\n", "map.toml:1", "no surface a block"},
             {"[[rule]]\nlayer = \"A-WALL\"\nentity = \"LINE\"\nuse = \"oak\"\n", "map.toml:1", "3DFACE"},
         }) {
        const std::string message = complaint(bad.text);
        EXPECT_NE(message.find(bad.place), std::string::npos) << bad.text << "-> " << message;
        EXPECT_NE(message.find(bad.words), std::string::npos) << bad.text << "-> " << message;
    }
    EXPECT_THROW(read_layer_map(folder_ / "absent.toml"), InputError);
}

TEST_F(LayerMaps, WordsThatFitOnlyApartAreNamedTogether)
{
    SurfaceKey lamp = on("LAMP");
    lamp.block = "B";
    face(lamp);
    face(on("WALL"));
    const std::string message = complaint("[[rule]]\nlayer = \"WALL\"\nblock = \"B\"\nuse = \"oak\"\n");
    EXPECT_NE(message.find("no surface has layer = \"WALL\", block = \"B\" together"), std::string::npos) << message;
}

TEST_F(LayerMaps, RulesWithoutEffectAreNoted)
{
    face(on("A-WALL"));
    apply("[[rule]]\nlayer = \"A-WALL\"\nuse = \"oak\"\nside = \"front\"\n[[rule]]\nlayer = \"*\"\nuse = \"pine\"\n");
    EXPECT_EQ(material_of("A-WALL"), "pine");
    ASSERT_TRUE(imported_.report.has(Finding::unused));
    EXPECT_EQ(imported_.report.notes().size(), 2u) << "the rule, and the side of what does not emit";
}

TEST_F(LayerMaps, AnEmptyFileAndAnEmptyMapAreNoTrouble)
{
    apply("");
    EXPECT_TRUE(imported_.scene.modifiers.empty());
    EXPECT_TRUE(summarize_layers(imported_).empty());
}

TEST_F(LayerMaps, TheProposedMapReadsBackAndGivesTheProposedMaterials)
{
    imported_.file_materials.emplace_back("glow\"ing", Light{Spectrum::grey(3)});
    imported_.file_materials.emplace_back("stuff", Plastic{Spectrum::grey(0.4), 0, 0});
    const std::vector<std::string> layers{"A-WALL-FULL", "Türen \"neu\"", "a*b?c[d]e", "x..y",  "墙", "back\\slash",
                                          "A-GLAZ",      "nothing",       "tab\there", "oak..", "[["};
    for (const std::string& layer : layers)
        face(on(layer));
    SurfaceKey lamp = on("nothing");
    lamp.material = "glow\"ing";
    face(lamp);
    SurfaceKey stuff = on("thing");
    stuff.material = "stuff";
    face(stuff);
    const std::string text = propose_layer_map(imported_);
    apply(text);
    EXPECT_EQ(material_of("A-WALL-FULL"), "generic_wall") << text;
    EXPECT_EQ(material_of("Türen \"neu\""), "light_wood");
    EXPECT_EQ(material_of("墙"), "generic_wall");
    EXPECT_EQ(material_of("A-GLAZ"), "glass_double_clear");
    EXPECT_EQ(material_of("oak.."), "oak");
    EXPECT_EQ(material_of("nothing/grey_50"), "grey_50");
    EXPECT_EQ(material_of("thing"), "stuff");
    EXPECT_NE(imported_.scene.find_modifier("nothing/glow\"ing.half"), void_modifier);
    EXPECT_NE(text.find("1 surface, 1 m2"), std::string::npos) << text;
    EXPECT_FALSE(imported_.report.has(Finding::unmapped));
}

} // namespace
} // namespace lightwell
