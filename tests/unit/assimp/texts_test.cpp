#include "engine/base/errors.h"
#include "importers/assimp/foreign_scene.h"
#include "importers/assimp/ifc_text.h"

#include <gtest/gtest.h>

#include <random>

namespace lightwell {
namespace {

/// Source  ISO 10303-21, 6.3.3: the same word in its three spellings
TEST(IfcText, StringsOfOtherAlphabetsAreDecoded)
{
    EXPECT_EQ(decode_step_string("Au\\X2\\00DF\\X0\\enw\\X2\\00E4\\X0\\nde"), "Außenwände");
    EXPECT_EQ(decode_step_string("Au\\S\\_enw\\S\\dnde"), "Außenwände");
    EXPECT_EQ(decode_step_string("Au\\X\\DFenw\\X\\E4nde"), "Außenwände");
    EXPECT_EQ(decode_step_string("it''s \\\\ here"), "it's \\ here");
    EXPECT_EQ(decode_step_string("\\X2\\00D"), "00D"); // cut off: passed over, nothing read beyond the end
}

const char* const small_ifc =
    "#1= IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#2= IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
    "#3= IFCUNITASSIGNMENT((#9,#1));\n"
    "#10= IFCWALL('0000000000000000000001',#2,'a;b (''c'')',$,$,#5,#20,$);\n"
    "#11= IFCDOOR('0000000000000000000002',#2,'d',$,$,#5,#21,$);\n"
    "#12= IFCSPACE('0000000000000000000003',#2,'air',$,$,#5,$,$);\n"
    "#20= IFCPRODUCTDEFINITIONSHAPE($,$,(#31,#30));\n#21= IFCPRODUCTDEFINITIONSHAPE($,$,(#32));\n"
    "#30= IFCSHAPEREPRESENTATION(#4,'Body','Brep',(#40));\n#31= IFCSHAPEREPRESENTATION(#4,'Axis','Curve2D',(#41));\n"
    "#32= IFCSHAPEREPRESENTATION(#4,'Body','MappedRepresentation',(#50));\n#50= IFCMAPPEDITEM(#51,#6);\n"
    "#51= IFCREPRESENTATIONMAP(#7,#33);\n#33= IFCSHAPEREPRESENTATION(#4,'Body','Brep',(#42));\n"
    "#60= IFCPRESENTATIONLAYERASSIGNMENT('Axes',$,(#31),$);\n#61= IFCPRESENTATIONLAYERASSIGNMENT('Walls',$,(#30),$);\n"
    "#62= IFCPRESENTATIONLAYERASSIGNMENT('Doors',$,(#42),$);\n#63= IFCSURFACESTYLE('Default Wall',.BOTH.,(#8));\n";

TEST(IfcText, LayersAreFoundOverShapesItemsAndMappedItems)
{
    const IfcText text = read_ifc_text(small_ifc);
    ASSERT_EQ(text.layer_of_product.size(), 2u);
    EXPECT_EQ(text.layer_of_product.at("0000000000000000000001"), "Walls"); // its body, not its axis
    EXPECT_EQ(text.layer_of_product.at("0000000000000000000002"), "Doors");
    EXPECT_EQ(text.metres_per_unit, 1e-3); // the one that is assigned
    EXPECT_EQ(text.unit_name, "MILLIMETRE");
    EXPECT_EQ(text.spaces, 1u);
    EXPECT_EQ(text.style_names.at("DefaultWall"), "Default Wall");
}

TEST(IfcText, DamagedTextEndsWithWhatCouldBeUnderstood)
{
    std::mt19937 random(3);
    for (int round = 0; round < 2000; ++round) {
        std::string text = small_ifc;
        for (int i = 0; i < 6; ++i)
            text[random() % text.size()] = "()',;#=$\\X2"[random() % 11];
        text.resize(random() % (text.size() + 1));
        EXPECT_LE(read_ifc_text(text).layer_of_product.size(), 8u);
    }
    const std::string circle =
        "#1= IFCWALL('0000000000000000000001',$,$,$,$,$,#2,$);\n#2= IFCPRODUCTDEFINITIONSHAPE($,$,(#3));"
        "#3= IFCSHAPEREPRESENTATION($,'Body',$,(#4));#4= IFCMAPPEDITEM(#5,$);#5= "
        "IFCREPRESENTATIONMAP($,#3);";
    EXPECT_TRUE(read_ifc_text(circle).layer_of_product.empty());
}

ForeignScene sample()
{
    ForeignScene scene;
    scene.materials.push_back({"white", {0.8f, 0.8f, 0.7f}, {}, true, 1, 0, false});
    scene.meshes.push_back({"m", 0, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {}, {3}, {0, 1, 2}});
    scene.nodes.push_back({"root", -1, {}, {}});
    scene.nodes.push_back({"node", 0, Affine::translate({1, 2, 3}), {0}});
    scene.lights = {"lamp"};
    scene.centimetres_per_unit = 2.54;
    return scene;
}

TEST(ForeignScene, WhatIsWrittenIsReadBack)
{
    const ForeignScene back = scene_from_bytes(scene_to_bytes(sample()), "test");
    EXPECT_EQ(back.meshes.at(0).points, sample().meshes[0].points);
    EXPECT_EQ(back.nodes.at(1).to_parent, Affine::translate({1, 2, 3}));
    EXPECT_EQ(back.materials.at(0).name, "white");
    EXPECT_EQ(back.lights.at(0), "lamp");
    EXPECT_EQ(back.centimetres_per_unit, 2.54);
}

std::string complaint(const std::string& bytes)
{
    try {
        scene_from_bytes(bytes, "a.fbx");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ForeignScene, TheAnswerOfABrokenChildIsNeverBelieved)
{
    ForeignScene wrong = sample();
    wrong.meshes[0].corners[1] = 3;
    EXPECT_NE(complaint(scene_to_bytes(wrong)).find("names a point that is not there"), std::string::npos);
    wrong = sample();
    wrong.nodes[0].parent = 1;
    EXPECT_NE(complaint(scene_to_bytes(wrong)).find("do not form a tree"), std::string::npos);
    wrong = sample();
    wrong.nodes[1].meshes = {7};
    EXPECT_NE(complaint(scene_to_bytes(wrong)).find("names a mesh that is not there"), std::string::npos);
    wrong = sample();
    wrong.meshes[0].face_sizes = {4000000000u, 294967299u}; // the sum of both is 3 when it is cut to 32 bits
    EXPECT_NE(complaint(scene_to_bytes(wrong)).find("faces without corners"), std::string::npos);
    EXPECT_NE(complaint(refusal_to_bytes("Chunk is\ntoo large")).find("a.fbx: cannot be read: Chunk is too large"),
              std::string::npos);
    const std::string good = scene_to_bytes(sample());
    for (std::size_t length = 0; length < good.size(); ++length)
        EXPECT_NE(complaint(good.substr(0, length)), "accepted") << length;
    EXPECT_NE(complaint(good + "x"), "accepted");
    std::mt19937 random(5);
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = good;
        bytes[random() % bytes.size()] = static_cast<char>(random());
        complaint(bytes); // refused or another scene, without reading beyond the end (sanitizers)
    }
}

} // namespace
} // namespace lightwell
