#include "engine/base/errors.h"
#include "materials/functions/program.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

double value_of(const std::string& text, const std::string& expression, const std::vector<double>& arguments = {},
                const std::vector<double>& channels = {}, const std::string& context = "")
{
    Definitions definitions = standard_definitions();
    definitions.add(text, "test.cal", context);
    const Program program = Program::compile(definitions, {expression}, context, arguments, "test");
    double value = 0;
    EXPECT_TRUE(program.evaluate(channels, {&value, 1}));
    return value;
}

TEST(FunctionLanguage, ContextsHideTheirNamesAndReachOutward)
{
    Definitions definitions;
    definitions.add("x = 1; y = 10; show = x;", "outer.cal");
    definitions.add("x = 2; both = x + y; everywhere = x`; own = `x; only`here = 7;", "inner.cal", "in");
    const auto value = [&](const std::string& expression, const std::string& context) {
        double found = 0;
        Program::compile(definitions, {expression}, context, {}, "test").evaluate({}, {&found, 1});
        return found;
    };
    EXPECT_EQ(value("x", ""), 1);
    EXPECT_EQ(value("x", "in"), 2);
    EXPECT_EQ(value("show", "in"), 1); // a name means what it means where it is written
    EXPECT_EQ(value("both", "in"), 12);
    EXPECT_EQ(value("everywhere", "in"), 1);
    EXPECT_EQ(value("own", "in"), 2);
    EXPECT_EQ(value("x`in", ""), 2);
    EXPECT_EQ(value("only`here", "in"), 7);
    EXPECT_THROW(value("both", ""), InputError);
}

TEST(FunctionLanguage, OnlyTheChosenOperandIsWorkedOut)
{
    // Without this, the recursion would never end: the conditional is a function of its own.
    EXPECT_EQ(value_of("when(a, b, c) = if(a, b, c); down(n) = when(n - .5, down(n - 1), 42);", "down(20)"), 42);
    EXPECT_EQ(value_of("ignore(a, b) = a;", "ignore(3, sqrt(-1))"), 3);
}

TEST(FunctionLanguage, ArgumentsOfThePatternAreCountedFromOne)
{
    EXPECT_EQ(value_of("", "A2 + 10 * arg(0)", {5, 7, 9}), 37);
    EXPECT_EQ(value_of("f(n) = arg(n);", "f($1)", {5, 7, 9}, {3}), 9);
    EXPECT_EQ(value_of("", "if(AC - 4, A5, 1)", {1, 2}), 1); // what cannot be reached may be missing
    EXPECT_THROW(value_of("", "A3", {1, 2}), InputError);
}

TEST(FunctionLanguage, FunctionsPassThroughSeveralHands)
{
    EXPECT_EQ(value_of("apply(f, x) = f(x); outer(g, x) = apply(g, x); half(x) = x / 2;", "outer(half, 10)"), 5);
    EXPECT_EQ(value_of("", "dot(D, P)", {}, {1, 2, 3, 0, 0, 1, 4, 5, 6}), 32);
    EXPECT_EQ(value_of("", "cross(3, D, P)", {}, {1, 2, 3, 0, 0, 1, 4, 5, 6}), -3);
}

TEST(FunctionLanguage, VariablesAreWorkedOutOnceInEachEvaluation)
{
    // Each level doubles the work unless values are kept: 2^60 steps would pass every bound.
    std::string text = "v0 = $1;";
    for (int i = 1; i <= 60; ++i) {
        const std::string before = std::to_string(i - 1);
        text.append("v").append(std::to_string(i)).append(" = v").append(before).append(" + 0 * v").append(before);
        text.append(";");
    }
    EXPECT_EQ(value_of(text, "v60", {}, {3}), 3);
    Definitions definitions;
    definitions.add("a = $1 * $1; b = a + a;", "test");
    const Program program = Program::compile(definitions, {"b", "a"}, "", {}, "test");
    for (const double x : {2.0, 3.0}) {
        double values[2];
        EXPECT_TRUE(program.evaluate({&x, 1}, values));
        EXPECT_EQ(values[0], 2 * x * x);
        EXPECT_EQ(values[1], x * x);
    }
}

TEST(FunctionLanguage, WhatDependsOnNothingIsWorkedOutBeforehand)
{
    const Program program =
        Program::compile(standard_definitions(), {"sin(PI / 6) * A1 + bound(0, 3, 1)"}, "", {4}, "test");
    EXPECT_EQ(program.highest_channel(), 0);
    EXPECT_EQ(program.size(), 1u);
    EXPECT_EQ(Program::compile(standard_definitions(), {"Pz + 1"}, "", {}, "test").highest_channel(), 9);
}

TEST(FunctionLanguage, TheErrorFunctionsAreThere)
{
    EXPECT_NEAR(value_of("", "erf(1.5)"), 0.9661051464753107, 1e-15);
    EXPECT_NEAR(value_of("", "erfc(1.5)"), 0.033894853524689274, 1e-16);
}

TEST(FunctionLanguage, NoiseIsSmoothAndItsSlopeIsItsDerivative)
{
    constexpr double h = 1e-5;
    for (const double x : {0.1, 0.9, -3.3, 255.7, -256.4}) {
        SCOPED_TRACE(x);
        const auto noise = [&](double dx) { return value_of("", "noise3($1, .37, -8.2)", {}, {x + dx}); };
        EXPECT_NEAR((noise(h) - noise(-h)) / (2 * h), value_of("", "noise3x($1, .37, -8.2)", {}, {x}), 1e-8);
    }
}

} // namespace
} // namespace lightwell
