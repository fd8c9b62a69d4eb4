#include "importers/importer.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(KeyTable, EqualKeysShareOneModifierAndDifferentOnesDoNot)
{
    Imported imported;
    KeyTable table{imported};
    const SurfaceKey wall{"A-WALL", "g", "b", "m", "LINE", Spectrum{0.1, 0.2, 0.3}};
    const ModifierId first = table.modifier_for(wall);
    EXPECT_EQ(table.modifier_for(wall), first);
    for (int field = 0; field < 6; ++field) {
        SurfaceKey other = wall;
        if (field == 5)
            other.colour = Spectrum{0.1, 0.2, 0.30000001};
        else
            (field == 0   ? other.layer
             : field == 1 ? other.group
             : field == 2 ? other.block
             : field == 3 ? other.material
                          : other.entity) += "x";
        EXPECT_EQ(table.modifier_for(other), first + field + 1) << field;
    }
    SurfaceKey colourless = wall;
    colourless.colour.reset();
    EXPECT_EQ(table.modifier_for(colourless), 7);
    EXPECT_EQ(imported.keys.size(), imported.scene.modifiers.size());
    EXPECT_EQ(imported.scene.modifiers[0].name, "A-WALL");
    EXPECT_EQ(imported.keys[1].layer, "A-WALLx");
}

TEST(KeyTable, FieldsThatRunTogetherStayApart)
{
    Imported imported;
    KeyTable table{imported};
    const ModifierId a = table.modifier_for({"ab", "c", "", "", "", {}});
    EXPECT_NE(table.modifier_for({"a", "bc", "", "", "", {}}), a);
    EXPECT_NE(table.modifier_for({"a", "b", "c", "", "", {}}), a);
    EXPECT_NE(table.modifier_for({std::string("ab\0c", 4), "", "", "", "", {}}), a);
}

TEST(KeyTable, PlaceholdersAreApartFromLayersOfTheSameKey)
{
    Imported imported;
    KeyTable table{imported};
    const SurfaceKey zero{"0", "", "", "", "", {}};
    const ModifierId layer = table.modifier_for(zero), placeholder = table.inherited(zero);
    EXPECT_NE(layer, placeholder);
    EXPECT_EQ(table.inherited(zero), placeholder);
    EXPECT_TRUE(std::holds_alternative<Alias>(imported.scene.modifiers[0].what));
    EXPECT_TRUE(std::holds_alternative<Inherited>(imported.scene.modifiers[1].what));
    EXPECT_EQ(std::get<Alias>(imported.scene.modifiers[0].what).target, void_modifier);
}

TEST(KeyTable, AMillionLookUpsTakeNoQuadraticTime)
{
    Imported imported;
    KeyTable table{imported};
    for (int round = 0; round < 10; ++round)
        for (int i = 0; i < 100000; ++i)
            ASSERT_EQ(table.modifier_for({"layer" + std::to_string(i), "", "", "", "", {}}), i);
    EXPECT_EQ(imported.keys.size(), 100000u);
}

} // namespace
} // namespace lightwell
