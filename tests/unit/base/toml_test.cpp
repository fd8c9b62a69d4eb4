#include "engine/base/errors.h"
#include "engine/base/toml.h"

#include <gtest/gtest.h>

#include <functional>

namespace lightwell {
namespace {

std::string complaint(const std::function<void()>& action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Toml, ValuesArriveWithTheirLines)
{
    const TomlTable table = parse_toml("a = 1\nb = \"two\"\n\n[t]\nc = true\nd = [1, 2.5]\ne = \"x\"\n[[l]]\nf = 1\n"
                                       "[[l]]\nf = 2\n",
                                       "f.toml");
    EXPECT_EQ(table.number("a"), 1);
    EXPECT_EQ(table.text("b"), "two");
    const TomlTable* inner = table.table("t");
    ASSERT_TRUE(inner);
    EXPECT_EQ(inner->place(), "f.toml:4");
    EXPECT_EQ(inner->place_of("d"), "f.toml:6");
    EXPECT_EQ(inner->boolean("c"), true);
    EXPECT_EQ(inner->numbers("d"), (std::vector<double>{1, 2.5}));
    EXPECT_EQ(inner->texts("e"), std::vector<std::string>{"x"});
    const auto list = table.tables("l");
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[1]->place(), "f.toml:10");
    EXPECT_EQ(list[1]->number("f"), 2);
    EXPECT_FALSE(table.number("absent"));
    EXPECT_FALSE(table.table("absent"));
    EXPECT_TRUE(table.tables("absent").empty());
}

TEST(Toml, WrongTypesAndUnknownWordsAreNamedWithTheirLine)
{
    const TomlTable table = parse_toml("a = 1\nb = [1, \"x\"]\nc = {}\n", "f.toml");
    EXPECT_EQ(complaint([&] { table.text("a"); }), "f.toml:1: a is 1, expected a text in quotes");
    EXPECT_EQ(complaint([&] { table.numbers("b"); }), "f.toml:2: b is a list, expected a list of numbers");
    EXPECT_EQ(complaint([&] { table.number("c"); }), "f.toml:3: c is a table, expected a number");
    EXPECT_EQ(complaint([&] {
                  table.expect_words({"a", "b", "cc"});
              }),
              "f.toml:3: unknown word \"c\"; nearest: cc, a, b");
}

TEST(Toml, DatesAreTexts)
{
    const TomlTable table = parse_toml("t = 2026-06-21T12:00:00+02:00\nd = 2026-06-21\n", "f.toml");
    EXPECT_EQ(table.text("t"), "2026-06-21T12:00:00+02:00");
    EXPECT_EQ(table.text("d"), "2026-06-21");
}

TEST(Toml, WhatIsNoTomlIsRefusedWithItsLine)
{
    EXPECT_EQ(complaint([] { parse_toml("a = 1\nb = \n", "f.toml"); }).find("f.toml:2: is no TOML"), 0u);
    for (const std::string& text : {std::string("\xFF\xFE"), std::string("a = 1\na = 2"), std::string(100000, '['),
                                    "a = " + std::string(100000, '['), std::string("a = \0", 5), std::string("[a")})
        EXPECT_THROW(parse_toml(text, "f.toml"), InputError);
    EXPECT_THROW(read_toml("/nowhere/at/all.toml"), InputError);
}

TEST(Toml, QuotedTextsReadBack)
{
    for (const std::string& text : {std::string("plain"), std::string("\"quoted\" \\ back"),
                                    std::string("墙 tab\t\n\r\x01\x7F"), std::string(), std::string("a\0b", 3)})
        EXPECT_EQ(parse_toml("a = " + toml_quoted(text), "f").text("a"), text);
}

} // namespace
} // namespace lightwell
