#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/generators/scene_text_out.h"
#include "importers/radiance/inline_commands.h"
#include "importers/radiance/transform_words.h"
#include "importers/radiance/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

using generators::BadWords;
using generators::WordReader;

constexpr const char* usage =
    "Usage: replmarks [-e][-m newmod][-s size] {-x objfile | -i octree | -I mesh} modname .. [file ..]\n";

/// What stands in the place of the markers of one modifier.
struct Replacement {
    char kind = 'x'; ///< x: an xform of a file, i: an instance, I: a mesh
    std::string file, modifier;
};

struct Wish {
    bool expand = false;
    std::optional<std::string> modifier;
    double scale = 0; ///< 0: the size of a marker does not count
    std::vector<Replacement> replacements;
    std::vector<std::string> files;
};

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    WordReader reader(words);
    while (reader.more() && reader.peek().starts_with('-')) {
        const std::string option = reader.word("option");
        if (option == "-e") {
            wish.expand = true;
        } else if (option == "-m") {
            wish.modifier = reader.word("modifier");
        } else if (option == "-s") {
            wish.scale = reader.number("scale");
        } else if (option == "-x" || option == "-i" || option == "-I") {
            Replacement replacement{option[1], reader.word("file"), {}};
            replacement.modifier = reader.word("modifier of the markers");
            wish.replacements.push_back(std::move(replacement));
        } else {
            throw BadWords("command line error at '" + option + "'");
        }
    }
    if (wish.replacements.empty())
        throw BadWords("Use error - one of -x, -i or -I is needed");
    while (reader.more())
        wish.files.push_back(reader.word("file"));
    return wish;
}

/// The map that a marker stands for: the longest side is left, the second longest is the x axis, the third points
/// along y, and both begin at the origin.
Affine map_of(const std::vector<double>& numbers, double scale, const std::string& place)
{
    const std::size_t count = numbers.size() / 3;
    if (count < 3 || numbers.size() % 3 != 0)
        throw InputError{place, "a marker has three corners or more"};
    const auto corner = [&](std::size_t i) {
        const double* at = &numbers[3 * (i % count)];
        return Point{at[0], at[1], at[2]};
    };
    std::vector<std::size_t> sides(count); // side i goes from corner i to the next
    for (std::size_t i = 0; i < count; ++i)
        sides[i] = i;
    std::stable_sort(sides.begin(), sides.end(), [&](std::size_t a, std::size_t b) {
        return length(corner(a + 1) - corner(a)) > length(corner(b + 1) - corner(b));
    });
    const std::array<std::size_t, 2> x_side{sides[1], (sides[1] + 1) % count}, y_side{sides[2], (sides[2] + 1) % count};
    const bool meets_at_first = x_side[0] == y_side[0] || x_side[0] == y_side[1];
    const std::size_t origin = meets_at_first ? x_side[0] : x_side[1];
    if (origin != y_side[0] && origin != y_side[1])
        throw InputError{place, "the second and third longest sides of a marker do not meet"};
    const Vec3 x = corner(meets_at_first ? x_side[1] : x_side[0]) - corner(origin);
    const Vec3 y_like = corner(origin == y_side[0] ? y_side[1] : y_side[0]) - corner(origin);
    const Vec3 z = cross(x, y_like);
    if (!(length(z) > 0))
        throw InputError{place, "a marker has no area"};
    const double size = scale > 0 ? scale * length(x) : 1;
    const Vec3 z_axis = normalized(z), x_axis = normalized(x);
    return {x_axis * size, cross(z_axis, x_axis) * size, z_axis * size, corner(origin)};
}

class MarkRun {
public:
    MarkRun(const Wish& wish, const GeneratorInput& input, const CommandPolicy& policy, int depth, std::string& out)
        : wish_(wish), input_(input), policy_(policy), depth_(depth), out_(out)
    {
    }

    void replace(std::string_view text, const std::string& name)
    {
        Words words(text, name);
        Primitive primitive;
        for (;;) {
            const std::size_t begin = words.offset();
            const Words::Next next = words.next();
            const std::size_t from = words.offset();
            out_ += text.substr(begin, from - begin);
            if (next == Words::Next::end)
                return;
            if (next == Words::Next::command && wish_.expand) {
                const std::string place = words.place(from), line = words.command();
                replace(answer_command(line.substr(1), place + ": " + line, input_, policy_, depth_), place);
                continue;
            }
            if (next == Words::Next::comment)
                words.comment();
            else if (next == Words::Next::command)
                words.command();
            else if (words.read(primitive); primitive.type == "alias")
                words.alias_target(primitive);
            else if (replaced(primitive, words))
                continue;
            out_ += text.substr(from, words.offset() - from);
        }
    }

private:
    bool replaced(const Primitive& primitive, const Words& words)
    {
        const auto found =
            std::find_if(wish_.replacements.begin(), wish_.replacements.end(),
                         [&](const Replacement& replacement) { return replacement.modifier == primitive.modifier; });
        if (found == wish_.replacements.end() || primitive.type != "polygon")
            return false;
        const std::string place = words.place(primitive);
        const auto transform = words_of(map_of(primitive.numbers, wish_.scale, place));
        if (!transform)
            throw InputError{place, "the marker stands for no rotation and scale"};
        std::string line;
        for (const std::string& word : *transform)
            line += ' ' + word;
        const std::string modifier = wish_.modifier.value_or("void"), name(primitive.name);
        if (found->kind == 'x')
            out_ += fmt::format("\n!xform -n {}{}{} {}\n", name, wish_.modifier ? " -m " + modifier : "", line,
                                found->file);
        else
            out_ += fmt::format("\n{} {} {}\n{} {}{}\n0\n0\n", modifier, found->kind == 'i' ? "instance" : "mesh", name,
                                transform->size() + 1, found->file, line);
        return true;
    }

    const Wish& wish_;
    const GeneratorInput& input_;
    const CommandPolicy& policy_;
    int depth_;
    std::string& out_;
};

} // namespace

GeneratorAnswer replmarks(const std::vector<std::string>& words, const GeneratorInput& input,
                          const CommandPolicy& policy, int depth)
{
    return generators::answered(words, usage, [&](GeneratorAnswer& answer) {
        const Wish wish = wish_of(words);
        answer.text = generators::comment_of(words);
        MarkRun run(wish, input, policy, depth, answer.text);
        if (wish.files.empty())
            run.replace(input.standard_input ? input.standard_input() : "", "(standard input)");
        for (const std::string& name : wish.files) {
            const auto file = input.find_file(name);
            if (!file)
                throw BadWords("cannot open file \"" + name + "\"");
            run.replace(MappedFile(*file).bytes(), name);
        }
    });
}

} // namespace lightwell::scene_text
