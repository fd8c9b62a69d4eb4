#include "engine/base/errors.h"
#include "materials/functions/program.h"

#include <gtest/gtest.h>

#include <chrono>

namespace lightwell {
namespace {

std::string message_of(const std::string& text, const std::string& expression = "1")
{
    try {
        Definitions definitions;
        definitions.add(text, "bad.cal");
        Program::compile(definitions, {expression}, "", {}, "scene.rad:7");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(DamagedFunctions, MessagesNameTheLineAndWhatWasFound)
{
    EXPECT_EQ(message_of("a = 1;\nb = 2 +;\n"), "bad.cal:2: expected a number, a name or (, found \";\"");
    EXPECT_EQ(message_of("a = 1\nb = 2;"), "bad.cal:2: expected an operator or ;, found \"b = 2;\"");
    EXPECT_EQ(message_of("{ open\na = 1;"), "bad.cal:1: a comment that begins here never ends; close it with }");
    EXPECT_EQ(message_of("a = 1 } ;"), "bad.cal:1: a } without its {, found \"} ;\"");
    EXPECT_EQ(message_of("f(x, = 1;"), "bad.cal:1: expected a name, found \"= 1;\"");
    EXPECT_EQ(message_of("= 3"), "bad.cal:1: expected a name, found \"= 3\"");
    EXPECT_EQ(message_of("a = $x;"), "bad.cal:1: a channel is $ and a whole number, found \"x;\"");
    EXPECT_EQ(message_of("a = (1 + 2"), "bad.cal:1: expected an operator or ), found the end of the text");
}

TEST(DamagedFunctions, MessagesNameWhatIsNotDefined)
{
    EXPECT_NE(message_of("a = b;\nb = nowhere + 1;", "a").find("bad.cal:2: nowhere is not defined"), std::string::npos);
    EXPECT_NE(message_of("f(x, y) = x;", "f(1)").find("too few arguments of f"), std::string::npos);
    EXPECT_NE(message_of("a = 3;", "a(1)").find("a is a variable, no function"), std::string::npos);
    EXPECT_EQ(message_of("unused = nowhere;"), "accepted");
}

TEST(DamagedFunctions, NestingWithoutEndIsRefused)
{
    EXPECT_NE(message_of("a = " + std::string(100000, '(')).find("nested more than"), std::string::npos);
    std::string sum = "a = 1";
    for (int i = 0; i < 100000; ++i)
        sum += "+1";
    EXPECT_NE(message_of(sum).find("nested more than"), std::string::npos);
    std::string chain = "v0 = 1;";
    for (int i = 1; i < 10000; ++i)
        chain.append("v").append(std::to_string(i)).append(" = v").append(std::to_string(i - 1)).append(";");
    EXPECT_NE(message_of(chain, "v9999").find("2000 deep"), std::string::npos);
}

TEST(DamagedFunctions, WorkWithoutEndGivesZeroSoon)
{
    const auto start = std::chrono::steady_clock::now();
    for (const char* text :
         {"f(x) = f(x + 1);", "f(x) = f(x) + f(x + 1);", "f(x) = f(f(x));", "f(x) = v; v = v + 1;",
          "f(x) = g(x); g(x) = f(x);", "f(x) = fib(x + 50); fib(n) = if(n - 1.5, fib(n - 1) + fib(n - 2), n);"}) {
        SCOPED_TRACE(text);
        Definitions definitions;
        definitions.add(text, "endless.cal");
        const Program program = Program::compile(definitions, {"f($1)"}, "", {}, "test");
        double value = 1;
        const double channel = 2;
        EXPECT_FALSE(program.evaluate({&channel, 1}, {&value, 1}));
        EXPECT_EQ(value, 0);
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);
}

TEST(DamagedFunctions, AnyBytesAreReadOrRefused)
{
    // Every prefix of a good text, and every text with one byte changed.
    const std::string good =
        "f(x, y) : if(x - 1.5e-3, -y ^ 2, select(2, $1, x)); { note { inner } } a`b = f(1, 2) / 3;";
    int refused = 0;
    const auto read = [&](const std::string& text) {
        try {
            Definitions definitions;
            definitions.add(text, "damaged.cal");
            Program::compile(definitions, {"1"}, "", {}, "test");
        } catch (const InputError&) {
            ++refused;
        }
    };
    for (std::size_t i = 0; i < good.size(); ++i) {
        read(good.substr(0, i));
        for (const char c : {'\0', '(', '}', '`', '9', '\xff', ';'}) {
            std::string changed = good;
            changed[i] = c;
            read(changed);
        }
    }
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace lightwell
