#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const std::string red = "void plastic red\n0\n0\n5 .7 .1 .1 0 0\n";

/// Text, and how the message must begin.
struct Damage {
    std::string text, beginning;
};

const Damage damages[] = {
    {"void", "scene.rad:1: the file ends after \"void\""},
    {"void plastic", "scene.rad:1: the file ends after \"void plastic\""},
    {"\nvoid plastic p", "scene.rad:2: plastic \"p\": the file ends before the number of its words"},
    {"void plastic p 0 0 5 .1 .1", "scene.rad:1: plastic \"p\": the file ends before its number 3"},
    {"void plastic p 2 a", "scene.rad:1: plastic \"p\": the file ends before its word 2"},
    {"void plastic p x", "scene.rad:1: plastic \"p\": the number of words is \"x\""},
    {"void plastic p 0 0 -5", "scene.rad:1: plastic \"p\": the number of numbers is \"-5\""},
    {"void plastic p 0 0 99999999999999999999", "scene.rad:1: plastic \"p\": the number of numbers is"},
    {"void plastic p 0 0 1000000000000 .1 .2", "scene.rad:1: plastic \"p\": the file ends before its number 3"},
    {"void plastic p 0 0 5\n.1 .1 nan 0 0", "scene.rad:2: plastic \"p\": number 3 is \"nan\""},
    {"void plastic p 0 0 5\n.1 .1 inf 0 0", "scene.rad:2: plastic \"p\": number 3 is \"inf\""},
    {"void plastic p 0 0 5\n.1 .1 1e999 0 0", "scene.rad:2: plastic \"p\": number 3 is \"1e999\""},
    {"void plastic p 0 0 5\n.1 .1 .1 0 0.1.2", "scene.rad:2: plastic \"p\": number 5 is \"0.1.2\""},
    {"void plastic p 0 0 4 .1 .1 .1 0", "scene.rad:1: plastic \"p\": 4 numbers, expected 5"},
    {"void glass p 0 0 2 .1 .1", "scene.rad:1: glass \"p\": 2 numbers, expected 3 or 4"},
    {"void trans p 0 0 5 .1 .1 .1 0 0", "scene.rad:1: trans \"p\": 5 numbers, expected 7"},
    {"void glow p 0 0 3 .1 .1 .1", "scene.rad:1: glow \"p\": 3 numbers, expected 4"},
    {"void spotlight p 0 0 4 1 1 1 3", "scene.rad:1: spotlight \"p\": 4 numbers, expected 7"},
    {"void light p 0 0 4 1 1 1 3", "scene.rad:1: light \"p\": 4 numbers, expected 3"},
    {"void plastic p 0 0 5 1.5 .9 .1 0 0", "scene.rad:1: plastic \"p\": "},
    {"void plastik p 0 0 5 .1 .1 .1 0 0", "scene.rad:1: plastik \"p\": \"plastik\" is no type"},
    {red + "\nblue sphere s 0 0 4 0 0 0 1", "scene.rad:6: sphere \"s\": modifier \"blue\" is not defined above"},
    {"s sphere s 0 0 4 0 0 0 1\n" + red, "scene.rad:1: sphere \"s\": modifier \"s\" is not defined above"},
    {"void alias a b", "scene.rad:1: alias \"a\": modifier \"b\" is not defined above"},
    {"void alias a", "scene.rad:1: alias \"a\": the file ends before"},
    {"void alias a a", "scene.rad:1: alias \"a\": modifier \"a\" is not defined above"},
    {"void illum i 1 gone 0 3 1 1 1", "scene.rad:1: illum \"i\": modifier \"gone\" is not defined above"},
    {red + "red sphere s 0 0 3 0 0 0", "scene.rad:5: sphere \"s\": 3 numbers, expected 4"},
    {red + "red polygon s 0 0 8 0 0 0 1 0 0 1 1", "scene.rad:5: polygon \"s\": 8 numbers"},
    {red + "red polygon s 0 0 6 0 0 0 1 0 0", "scene.rad:5: polygon \"s\": 6 numbers"},
    {red + "red polygon s 0 0 9 0 0 0 1 0 0 1 1 0 7", "scene.rad:5: the file ends after \"7\""},
    {red + "red cone s 0 0 8 0 0 0 0 0 1 -1 1", "scene.rad:5: cone \"s\": radii -1 and 1"},
    {red + "red ring s 0 0 8 0 0 0 0 0 0 0 1", "scene.rad:5: ring \"s\": radii"},
    {red + "red ring s 0 0 8 0 0 0 0 0 1 -1 1", "scene.rad:5: ring \"s\": radii"},
    {red + "red source s 0 0 4 0 0 1 0", "scene.rad:5: source \"s\": angle 0"},
    {red + "red source s 0 0 4 0 0 0 1", "scene.rad:5: source \"s\": angle 1"},
    {"void brightfunc s 2 skybr skybright.cal 0 3 9 1 1", "scene.rad:1: brightfunc \"s\": 3 numbers, the first 9"},
    {"void brightfunc s 2 skybr skybright.cal 0 3 1 1 1", "scene.rad:1: brightfunc \"s\": 3 numbers, the first 1"},
    {"void brightfunc s 4 skybr skybright.cal -rx 90 0 3 2 1 1", "scene.rad:1: brightfunc \"s\": the transform tilts"},
    {"void instance i 1 gone.oct 0 0", "scene.rad:1: instance \"i\": \"gone.oct\" is compiled"},
    {"void instance i 0 0 0", "scene.rad:1: instance \"i\": no file name"},
    {"void instance i 3 scene.rad -q 1 0 0", "scene.rad:1: instance \"i\": \"-q\" is no transform"},
    {"void instance i 3 scene.rad -s 0 0 0", "scene.rad:1: instance \"i\": -s is 0"},
    {"void instance i 3 scene.rad -t 1 0 0", "scene.rad:1: instance \"i\": -t is followed by \"nothing\""},
    {"void instance i 1 scene.rad 0 0", "scene.rad:1: instance \"i\": files refer to each other in a circle"},
    {"!xform scene.rad", "scene.rad:1: !xform: files refer to each other in a circle: scene.rad -> scene.rad"},
    {"!xform -t 1 0 0 scene.rad", "scene.rad:1: !xform: files refer to each other in a circle"},
    {"!xform -t 1 0", "scene.rad:1: !xform: -t is followed by \"nothing\""},
    {"!xform -rx ninety scene.rad", "scene.rad:1: !xform: -rx is followed by \"ninety\""},
    {"!xform -s 1/3 scene.rad", "scene.rad:1: !xform: -s is followed by \"1/3\""},
    {"!xform -a 99999999 -t 1 0 0 x.rad", "scene.rad:1: !xform: the arrays ask for more than"},
    {"!xform -a 9999 -t 1 0 0 -a 9999 -t 0 1 0 x.rad", "scene.rad:1: !xform: the arrays ask for more than"},
    {"!xform -s 1e300 -s 1e300 x.rad", "scene.rad:1: !xform: the transform is singular or not finite"},
    {"!xform gone.rad", "scene.rad:1: !xform: file \"gone.rad\" is not found"},
    {"!xform -t 1 0 0", "scene.rad:1: !xform: no file name"},
    {"!xform -Q x.rad", "scene.rad:1: !xform: option -Q is not known or not modelled yet"},
    {"!xform -m gone scene.rad", "scene.rad:1: !xform \"gone\": modifier \"gone\" is not defined above"},
    {"!xform gone.rad | xform -t 1 0 0", "scene.rad:1: !xform: xform: cannot find file \"gone.rad\""},
    {"!genbox m b 1 1 1 > x.rad", "scene.rad:1: !genbox: the command uses \">\""},
    {"!genbox m b 1 1", "scene.rad:1: !genbox: genbox: Use error - size is missing"},
    {"!cat 6 21 12", "scene.rad:1: !cat: `cat` is a command that is not answered here"},
    {"\n\n!genbox red b 1 2 3 \\\n -b .1\nx", "scene.rad:3: !genbox"},
    {"#@view v -vtx", "scene.rad:1: view type"},
    {"#@grid g 1 x 1", "scene.rad:1: word 3 of `#@grid` is no count"},
    {red + "red mesh m 1 m.rtm 0 0", "scene.rad:5: mesh \"m\": \"m.rtm\" is compiled"},
    {red + "void mesh m 1 m.rtm 0 0", "scene.rad:5: mesh \"m\": \"m.rtm\" is compiled"},
    {"#?RADIANCE\noconv\nFORMAT=Radiance_octree\n\n\x01\x02", "scene.rad: "},
};

TEST(SceneDamage, EachKindIsOneMessageWithFileLineAndEntity)
{
    const SceneFolder folder;
    for (const Damage& damage : damages) {
        const std::string message = folder.error(damage.text);
        EXPECT_TRUE(message.starts_with(damage.beginning)) << damage.text << "\ngave: " << message;
    }
}

TEST(SceneDamage, NoCutOfAWholeSceneCrashesOrIsTakenForSomethingElse)
{
    const SceneFolder folder;
    folder.write("unit.rad", red + "red polygon face 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0");
    const std::string whole = "#@from x\n" + red +
                              "inherit alias wall red\nwall polygon w 0 0 9 0 0 0 1 0 0 0 1 0\n"
                              "void brightfunc skyfunc 2 skybr skybright.cal 0 3 2 40 6\n"
                              "!xform -n a -t 1 0 0 unit.rad\nvoid instance i 3 unit.rad -rz 9 0 0\n";
    int refused = 0, read = 0;
    for (std::size_t size = 0; size <= whole.size(); ++size)
        (folder.error(whole.substr(0, size)).empty() ? read : refused) += 1;
    EXPECT_GT(refused, 100);
    EXPECT_GT(read, 20);
}

TEST(SceneDamage, NoSingleChangedByteCrashes)
{
    const SceneFolder folder;
    const std::string whole = red + "red cone c 0 0 8 0 0 0 0 0 1 .5 .2\nred ring r 0 0 8 0 0 0 0 0 1 0 1\n"
                                    "!xform -a 3 -t 1 0 0 -n b x.rad\n#@grid g 1 1 1\n#@view v -vp 1 2 3\n";
    folder.write("x.rad", red);
    int refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const char c : {'\0', ' ', '-', '9', '#', '!', '"', '\n', '\xFF'}) {
            std::string damaged = whole;
            damaged[i] = c;
            refused += folder.error(damaged).empty() ? 0 : 1;
        }
    EXPECT_GT(refused, 100);
}

TEST(SceneDamage, FilesThatReferToEachOtherInACircleAreNamedInOrder)
{
    const SceneFolder folder;
    folder.write("a.rad", "void instance b 1 b.oct 0 0\n");
    folder.write("b.rad", "\n!xform -t 0 0 1 c.rad\n");
    folder.write("c.rad", "void instance a 1 a.rad 0 0\n");
    const std::string message = folder.error("void instance a 1 a.oct 0 0");
    EXPECT_NE(message.find("c.rad:1: instance \"a\": files refer to each other in a circle: "
                           "a.rad -> b.rad -> c.rad -> a.rad"),
              std::string::npos)
        << message;
}

TEST(SceneDamage, AMissingFileAFolderAndAnEmptyFileAreTold)
{
    const SceneFolder folder;
    Report report;
    EXPECT_THROW(read_radiance(folder.path("missing.rad"), report), InputError);
    EXPECT_THROW(read_radiance(folder.path(""), report), InputError);
    EXPECT_EQ(folder.error(""), "");
    EXPECT_TRUE(folder.read("\xEF\xBB\xBF# only a comment").root.surfaces.empty());
}

} // namespace
} // namespace lightwell
