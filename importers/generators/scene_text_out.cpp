#include "importers/generators/scene_text_out.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace lightwell {

namespace {

struct NamedGenerator {
    std::string_view name;
    Generator run;
};
constexpr std::array<NamedGenerator, 8> all{{{"genblinds", genblinds},
                                             {"genbox", genbox},
                                             {"gendaylit", gendaylit},
                                             {"genprism", genprism},
                                             {"genrev", genrev},
                                             {"gensky", gensky},
                                             {"gensurf", gensurf},
                                             {"genworm", genworm}}};

} // namespace

Generator find_generator(std::string_view name)
{
    const auto* found = std::find_if(all.begin(), all.end(), [&](const NamedGenerator& g) { return g.name == name; });
    return found == all.end() ? nullptr : found->run;
}

std::vector<std::string> generator_names()
{
    std::vector<std::string> names;
    for (const NamedGenerator& generator : all)
        names.emplace_back(generator.name);
    return names;
}

namespace generators {

GeneratorAnswer answered(const std::vector<std::string>& words, const std::string& usage,
                         const std::function<void(GeneratorAnswer&)>& make)
{
    GeneratorAnswer answer;
    std::string problem;
    try {
        make(answer);
        return answer;
    } catch (const BadWords& bad) {
        problem = words[0] + ": " + bad.what() + '\n' + usage;
    } catch (const InputError& error) {
        problem = words[0] + ": " + error.what() + '\n';
    }
    return {{}, answer.messages + problem, 1};
}

const std::string& WordReader::word(const char* what)
{
    if (!more())
        throw BadWords(fmt::format("Use error - {} is missing", what));
    return words_[next_++];
}

double WordReader::number(const char* what)
{
    const std::string& text = word(what);
    const auto value = parse_double(text);
    if (!value || !std::isfinite(*value))
        throw BadWords(fmt::format("Use error - {} is \"{}\", expected a finite number", what, text));
    return *value;
}

int WordReader::count(const char* what, int least, int most)
{
    const std::string& text = word(what);
    const auto value = parse_integer(text);
    if (!value || *value < least || *value > most)
        throw BadWords(
            fmt::format("Use error - {} is \"{}\", expected a whole number from {} to {}", what, text, least, most));
    return static_cast<int>(*value);
}

std::string comment_of(const std::vector<std::string>& words)
{
    std::string text = "#";
    for (const std::string& word : words)
        text += ' ' + word;
    // A word may hold the end of a line, and what follows would no longer be a comment.
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text + '\n';
}

void begin_primitive(std::string& text, const std::string& modifier, const std::string& type, const std::string& name)
{
    text += fmt::format("\n{} {} {}\n0\n0\n", modifier, type, name);
}

std::string column(double value)
{
    return fmt::format("\t{:18.12g}", value == 0 ? 0 : value);
}

void append_point(std::string& text, const Point& point)
{
    text += column(point.x) + column(point.y) + column(point.z) + '\n';
}

void append_polygon(std::string& text, const std::string& modifier, const std::string& name,
                    const std::vector<Point>& corners)
{
    begin_primitive(text, modifier, "polygon", name);
    text += fmt::format("{}\n", 3 * corners.size());
    for (const Point& corner : corners)
        append_point(text, corner);
}

void append_round(std::string& text, const std::string& modifier, const std::string& type, const std::string& name,
                  const std::vector<Point>& points, const std::vector<double>& radii)
{
    begin_primitive(text, modifier, type, name);
    text += fmt::format("{}\n", 3 * points.size() + radii.size());
    for (const Point& point : points)
        append_point(text, point);
    for (const double radius : radii)
        text += column(radius);
    text += '\n';
}

} // namespace generators
} // namespace lightwell
