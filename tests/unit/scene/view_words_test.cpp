#include "engine/base/errors.h"
#include "engine/scene/view.h"

#include <gtest/gtest.h>

namespace lightwell {

TEST(ViewWords, EveryWordIsReadAndWrittenAgain)
{
    const std::string text =
        "-vtc -vp 1 2 3 -vd 0 4 0.5 -vu 0 0.5 1 -vh 300 -vv 75.5 -vs 0.25 -vl -0.5 -vo -1 -va 12.5 -pd 0.05 -pf 3";
    const View view = parse_view(text, "test");
    EXPECT_EQ(view.kind, View::Kind::cylindrical);
    EXPECT_EQ(view.direction, (Vec3{0, 4, 0.5}));
    EXPECT_EQ(view.shift, 0.25);
    EXPECT_EQ(view.lift, -0.5);
    EXPECT_EQ(view.fore_m, -1);
    EXPECT_EQ(view.aft_m, 12.5);
    EXPECT_EQ(view.lens_m, 0.05);
    EXPECT_EQ(view.focus_m, 3);
    EXPECT_EQ(to_text(view), text);
    EXPECT_EQ(to_text(parse_view("rvu " + text, "test")), text);
    EXPECT_EQ(to_text(parse_view("VIEW= " + text, "test")), text);
}

TEST(ViewWords, EveryKindHasItsLetterAndAWordWithoutLensNamesNone)
{
    for (const char letter : {'v', 'l', 'c', 'h', 'a', 's'}) {
        const std::string text = std::string("-vt") + letter;
        EXPECT_EQ(static_cast<char>(parse_view(text, "test").kind), letter);
        EXPECT_EQ(to_text(parse_view(text, "test")),
                  text + " -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 45 -vv 45 -vs 0 -vl 0 -vo 0 -va 0");
    }
}

TEST(ViewWords, WhatIsWrongIsNamed)
{
    const auto message = [](const std::string& text) {
        try {
            parse_view(text, "desk.vf");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_NE(message("-vtx").find("view type \"-vtx\" is not known"), std::string::npos);
    EXPECT_NE(message("-vp 1 2").find("\"nothing\", expected a finite number"), std::string::npos);
    EXPECT_NE(message("-pd wide").find("-pd is followed by \"wide\""), std::string::npos);
    EXPECT_NE(message("-va nan").find("-va is followed by \"nan\""), std::string::npos);
    EXPECT_NE(message("-vz 1").find("desk.vf: \"-vz\" is not a word of a view"), std::string::npos);
}

} // namespace lightwell
