#include "engine/base/nearest.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const std::vector<std::string> layers{"A-WALL", "A-WALL-FULL", "A-DOOR", "A-GLAZ", "S-COLS"};

TEST(Nearest, PutsSlipsOfTheFingerFirst)
{
    EXPECT_EQ(nearest("A-WALLS", layers, 1).at(0), "A-WALL");
    EXPECT_EQ(nearest("A-DROO", layers, 1).at(0), "A-DOOR") << "swapped letters";
    EXPECT_EQ(nearest("a_glaz", layers, 1).at(0), "A-GLAZ") << "case and signs";
    EXPECT_EQ(nearest("wall full", layers, 1).at(0), "A-WALL-FULL");
}

TEST(Nearest, GivesAsManyAsThereAre)
{
    EXPECT_EQ(nearest("x", layers, 3).size(), 3u);
    EXPECT_EQ(nearest("x", layers, 99).size(), 5u);
    EXPECT_TRUE(nearest("x", {}).empty());
    EXPECT_EQ(nearest_hint("x", {}), "");
    EXPECT_EQ(nearest_hint("A-DOR", layers, 1), "nearest: A-DOOR");
}

TEST(Nearest, LongNamesAreComparedByTheirBeginning)
{
    const std::string wall = "A-WALL" + std::string(1000000, 'x');
    EXPECT_EQ(nearest(wall, {std::string(1000000, 'y'), wall}, 1).at(0), wall);
}

} // namespace
} // namespace lightwell
