#include "importers/generators/scene_text_out.h"

#include "engine/base/files.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

constexpr const char* usage =
    "Usage: genprism material name { - | vfile | N v1 v2 .. vN } [-l lvect][-r radius][-c][-e]\n";
constexpr int most_corners = 1'000'000;

struct Prism {
    std::string material, name;
    std::vector<Point> corners;
    Vec3 along{0, 0, 1};
    double radius = 0;
    bool closed = true, ends = true;

    bool counter_clockwise() const
    {
        double area = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Point& a = corners[i];
            const Point& b = corners[(i + 1) % corners.size()];
            area += a.x * b.y - a.y * b.x;
        }
        return area > 0;
    }
};

std::vector<Point> corners_in(const std::string& text, const std::string& place)
{
    std::vector<double> values;
    for (const std::string_view word : split(text, " \t\r\n,")) {
        const auto value = parse_double(word);
        if (!value || !std::isfinite(*value))
            throw BadWords(fmt::format("{}: \"{}\" is no finite number", place, word.substr(0, 40)));
        values.push_back(*value);
    }
    if (values.size() % 2 != 0)
        throw BadWords(place + ": an odd number of coordinates, expected pairs x y");
    std::vector<Point> corners;
    for (std::size_t i = 0; i < values.size(); i += 2)
        corners.push_back({values[i], values[i + 1], 0});
    return corners;
}

std::vector<Point> read_corners(WordReader& words, const GeneratorInput& input)
{
    const std::string source = words.word("list of corners");
    if (source == "-")
        return corners_in(input.standard_input ? input.standard_input() : "", "(standard input)");
    if (!parse_integer(source)) {
        const auto file = input.find_file(source);
        if (!file)
            throw BadWords("cannot open file \"" + source + "\"");
        return corners_in(std::string(MappedFile(*file).bytes()), source);
    }
    const long long count = *parse_integer(source);
    if (count < 0 || count > most_corners)
        throw BadWords("Use error - number of corners is " + source);
    std::vector<Point> corners;
    for (long long i = 0; i < count; ++i) {
        const double x = words.number("corner");
        corners.push_back({x, words.number("corner"), 0});
    }
    return corners;
}

Prism prism_of(WordReader& words, const GeneratorInput& input)
{
    Prism prism;
    prism.material = words.word("material");
    prism.name = words.word("name");
    prism.corners = read_corners(words, input);
    while (words.more()) {
        const std::string option = words.word("option");
        if (option == "-l")
            for (int axis = 0; axis < 3; ++axis)
                prism.along[axis] = words.number("extrusion");
        else if (option == "-r")
            prism.radius = words.number("radius");
        else if (option == "-c")
            prism.closed = false;
        else if (option == "-e")
            prism.ends = false;
        else
            throw BadWords("Use error - unknown option: " + option);
    }
    if (prism.corners.size() < 3)
        throw BadWords("Use error - a prism has at least three corners");
    if (prism.along.z == 0)
        throw BadWords("Use error - illegal extrusion vector: it lies in the plane of the corners");
    if (!(prism.radius >= 0))
        throw BadWords("Use error - radius must not be negative");
    return prism;
}

/// The outline moved inwards by the radius: the axes of the rounded edges.
std::vector<Point> inset_of(const Prism& prism)
{
    const std::vector<Point>& p = prism.corners;
    std::vector<Point> inset;
    const double side = prism.counter_clockwise() ? 1 : -1;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 before = normalized(p[i] - p[(i + p.size() - 1) % p.size()]);
        const Vec3 after = normalized(p[(i + 1) % p.size()] - p[i]);
        const Vec3 inwards{-before.y - after.y, before.x + after.x, 0};
        const double share = 1 + dot(before, after);
        constexpr double sharpest = 1e-6; // corners that turn right round have no inside
        if (!(share > sharpest))
            throw BadWords("Use error - a corner turns right back, it cannot be rounded");
        inset.push_back(p[i] + inwards * (side * prism.radius / share));
    }
    return inset;
}

/// Everything of one outline between two heights; the front looks outwards for an outline that runs clockwise as seen
/// from where the extrusion goes.
void append_ends(std::string& text, const Prism& prism, const std::vector<Point>& outline, const Vec3& bottom,
                 const Vec3& top)
{
    std::vector<Point> corners;
    for (const Point& p : outline)
        corners.push_back(p + bottom);
    append_polygon(text, prism.material, prism.name + ".b", corners);
    std::reverse(corners.begin(), corners.end());
    for (Point& corner : corners)
        corner += top - bottom;
    append_polygon(text, prism.material, prism.name + ".e", corners);
}

void append_side(std::string& text, const Prism& prism, std::size_t i, const Point& from, const Point& to,
                 const Vec3& bottom, const Vec3& top)
{
    append_polygon(text, prism.material, fmt::format("{}.{}", prism.name, i + 1),
                   {from + bottom, from + top, to + top, to + bottom});
}

void append_sharp(std::string& text, const Prism& prism)
{
    if (prism.ends)
        append_ends(text, prism, prism.corners, {}, prism.along);
    const std::size_t count = prism.corners.size();
    for (std::size_t i = 0; i < (prism.closed ? count : count - 1); ++i)
        append_side(text, prism, i, prism.corners[i], prism.corners[(i + 1) % count], {}, prism.along);
}

void append_rounded(std::string& text, const Prism& prism)
{
    const std::vector<Point> axes = inset_of(prism);
    const std::size_t count = axes.size();
    const Vec3 lift = prism.along * (prism.radius / length(prism.along));
    const Vec3 bottom = prism.ends ? lift : Vec3{}, top = prism.ends ? prism.along - lift : prism.along;
    if (!(2 * prism.radius < length(prism.along)))
        throw BadWords("Use error - the extrusion is too short for the radius");
    if (prism.ends)
        append_ends(text, prism, axes, {}, prism.along);
    const double side = prism.counter_clockwise() ? 1 : -1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string number = std::to_string(i + 1);
        append_round(text, prism.material, "cylinder", prism.name + ".c" + number, {axes[i] + bottom, axes[i] + top},
                     {prism.radius});
        if (prism.ends)
            for (const auto& [letter, height] : {std::pair("bs", bottom), std::pair("es", top)})
                append_round(text, prism.material, "sphere", prism.name + '.' + letter + number, {axes[i] + height},
                             {prism.radius});
        if (i + 1 == count && !prism.closed)
            continue;
        const Point from = axes[i], to = axes[(i + 1) % count];
        const Vec3 way = normalized(to - from), outwards = Vec3{way.y, -way.x, 0} * (side * prism.radius);
        append_side(text, prism, i, from + outwards, to + outwards, bottom, top);
        if (prism.ends)
            for (const auto& [letter, height] : {std::pair("bc", bottom), std::pair("ec", top)})
                append_round(text, prism.material, "cylinder", prism.name + '.' + letter + number,
                             {from + height, to + height}, {prism.radius});
    }
}

} // namespace

GeneratorAnswer genprism(const std::vector<std::string>& words, const GeneratorInput& input)
{
    return answered(words, usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        const Prism prism = prism_of(reader, input);
        answer.text = comment_of(words);
        if (prism.radius > 0)
            append_rounded(answer.text, prism);
        else
            append_sharp(answer.text, prism);
    });
}

} // namespace lightwell
