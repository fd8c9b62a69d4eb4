#include "importers/generators/curve_functions.h"

#include "engine/base/files.h"

#include <cmath>
#include <fmt/format.h>

namespace lightwell::generators {
namespace {

/// Curves by their ends and tangents, by four points, and through the middle of four.
constexpr const char* curves = R"(
hermite(p0, p1, r0, r1, t) = p0 * ((2 * t - 3) * t * t + 1) + p1 * (-2 * t + 3) * t * t +
                             r0 * (((t - 2) * t + 1) * t) + r1 * ((t - 1) * t * t);
bezier(p1, p2, p3, p4, t) = p1 * (1 + t * (-3 + t * (3 - t))) + p2 * 3 * t * (1 + t * (-2 + t)) +
                            p3 * 3 * t * t * (1 - t) + p4 * t * t * t;
bspline(pp, p0, p1, pn, t) = pp * (1 / 6 + t * (-.5 + t * (.5 - 1 / 6 * t))) + p0 * (2 / 3 + t * t * (-1 + .5 * t)) +
                             p1 * (1 / 6 + t * (.5 + t * (.5 - .5 * t))) + pn * (1 / 6 * t * t * t);
)";

} // namespace

CurveFunctions::CurveFunctions(const GeneratorInput& input) : input_(input), definitions_(standard_definitions())
{
    definitions_.add(curves, "curves");
}

bool CurveFunctions::option(const std::string& word, WordReader& words)
{
    if (word == "-e") {
        definitions_.add(words.word("expression"), "-e");
        return true;
    }
    if (word != "-f")
        return false;
    const std::string& name = words.word("function file");
    if (const auto file = input_.find_file(name))
        definitions_.add(MappedFile(*file).bytes(), name);
    else if (const std::string_view* text = standard_function_file(name))
        definitions_.add(*text, name);
    else
        throw BadWords("cannot find function file \"" + name + "\"");
    return true;
}

void CurveFunctions::add(const std::string& name, const std::string& parameters, const std::string& expression)
{
    definitions_.add(name + '(' + parameters + ")=" + expression + ';', expression);
}

bool CurveFunctions::has(const std::string& name) const
{
    return definitions_.find(name, "") != nullptr;
}

void CurveFunctions::compile(const std::vector<std::string>& calls)
{
    program_ = Program::compile(definitions_, calls, "", {}, "expressions");
}

std::vector<double> CurveFunctions::values(std::initializer_list<double> at) const
{
    std::vector<double> found(program_->size());
    const bool whole = program_->evaluate({at.begin(), at.size()}, found);
    for (const double value : found)
        if (!whole || !std::isfinite(value))
            throw BadWords(fmt::format("an expression has no value at {:.6g}", *at.begin()));
    return found;
}

} // namespace lightwell::generators
