#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/generators/scene_text_out.h"
#include "importers/radiance/inline_commands.h"
#include "importers/radiance/words.h"
#include "importers/radiance/xform_words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace lightwell::scene_text {
namespace {

using generators::BadWords;

/// What a transform does to the arguments of a type.
enum class Effect {
    none,
    words, ///< the transform is appended: functions, data, pictures, instances, meshes
    thick, ///< the same, and the first word is a length
    polygon,
    ball,       ///< a point and a radius
    cone,       ///< two points and two radii
    cylinder,   ///< two points and a radius
    ring,       ///< a point, a direction and two radii
    source,     ///< a direction
    aim,        ///< the last three of seven numbers
    reach,      ///< the fourth number is a length
    absorbing,  ///< the first three numbers are shares per length
    two_sided,  ///< the same for the numbers from the fifth on
    scattering, ///< the first three numbers are per length
    lettering   ///< a point and two directions
};

const std::map<std::string_view, Effect>& effects()
{
    static const std::map<std::string_view, Effect> all = [] {
        std::map<std::string_view, Effect> map{
            {"polygon", Effect::polygon},     {"sphere", Effect::ball},       {"bubble", Effect::ball},
            {"cone", Effect::cone},           {"cup", Effect::cone},          {"cylinder", Effect::cylinder},
            {"tube", Effect::cylinder},       {"ring", Effect::ring},         {"source", Effect::source},
            {"spotlight", Effect::aim},       {"glow", Effect::reach},        {"dielectric", Effect::absorbing},
            {"interface", Effect::two_sided}, {"mist", Effect::scattering},   {"brighttext", Effect::lettering},
            {"colortext", Effect::lettering}, {"mixtext", Effect::lettering}, {"BSDF", Effect::thick}};
        for (const char* type :
             {"instance", "mesh",      "colorfunc", "brightfunc", "colordata", "brightdata", "colorpict", "specfunc",
              "specdata", "specpict",  "texfunc",   "texdata",    "mixfunc",   "mixdata",    "mixpict",   "plastic2",
              "metal2",   "trans2",    "ashik2",    "plasfunc",   "metfunc",   "transfunc",  "BRTDfunc",  "plasdata",
              "metdata",  "transdata", "prism1",    "prism2",     "WGMDfunc",  "aBSDF"})
            map[type] = Effect::words;
        return map;
    }();
    return all;
}

bool is_surface(std::string_view type)
{
    static constexpr std::string_view surfaces[] = {"polygon", "sphere", "bubble", "cone",     "cup", "cylinder",
                                                    "tube",    "ring",   "source", "instance", "mesh"};
    return std::find(std::begin(surfaces), std::end(surfaces), type) != std::end(surfaces);
}

/// A word as it can stand in scene text.
std::string quoted_word(std::string_view word)
{
    const bool plain = !word.empty() && word.find_first_of(" \t\r\n\"'") == std::string_view::npos;
    const char quote = word.find('"') == std::string_view::npos ? '"' : '\'';
    return plain ? std::string(word) : quote + std::string(word) + quote;
}

std::string number_text(double value)
{
    return fmt::format(" {:18.12g}", value == 0 ? 0 : value);
}

/// The numbers of a primitive under a map.
/// @throws BadWords when there are too few
class MovedNumbers {
public:
    MovedNumbers(const std::vector<double>& numbers, const XformCopy& copy, std::string place)
        : numbers_(numbers), copy_(copy), place_(std::move(place))
    {
    }

    std::vector<double> under(Effect effect)
    {
        switch (effect) {
        case Effect::polygon:
            polygon();
            break;
        case Effect::ball:
            point(0), length(3);
            break;
        case Effect::cone:
            point(0), point(3), length(6), length(7);
            break;
        case Effect::cylinder:
            point(0), point(3), length(6);
            break;
        case Effect::ring:
            point(0), direction(3), length(6), length(7);
            break;
        case Effect::source:
            direction(0);
            break;
        case Effect::aim:
            direction(4);
            break;
        case Effect::lettering:
            if (!numbers_.empty())
                point(0), direction(3), direction(6);
            break;
        default:
            materials(effect);
        }
        return std::move(numbers_);
    }

private:
    void materials(Effect effect)
    {
        const auto absorb = [&](std::size_t first) {
            for (std::size_t i = first; i < std::min(first + 3, numbers_.size()); ++i)
                numbers_[i] = std::pow(numbers_[i], 1 / copy_.scale);
        };
        if (effect == Effect::reach && numbers_.size() > 3)
            length(3);
        if (effect == Effect::absorbing || effect == Effect::two_sided)
            absorb(0);
        if (effect == Effect::two_sided)
            absorb(4);
        if (effect == Effect::scattering)
            for (std::size_t i = 0; i < std::min<std::size_t>(3, numbers_.size()); ++i)
                numbers_[i] /= copy_.scale;
    }
    void polygon()
    {
        for (std::size_t i = 0; i + 2 < numbers_.size(); i += 3)
            point(i);
        if (copy_.map.determinant() < 0)
            for (std::size_t i = 0, j = numbers_.size() / 3; i + 1 < j; ++i) {
                --j;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    std::swap(numbers_[3 * i + axis], numbers_[3 * j + axis]);
            }
    }
    void need(std::size_t count) const
    {
        if (numbers_.size() < count)
            throw BadWords(fmt::format("{}: has {} numbers, expected at least {}", place_, numbers_.size(), count));
    }
    void set(std::size_t at, const Vec3& value)
    {
        for (int axis = 0; axis < 3; ++axis)
            numbers_[at + static_cast<std::size_t>(axis)] = value[axis];
    }
    void point(std::size_t at)
    {
        need(at + 3);
        set(at, copy_.map.point({numbers_[at], numbers_[at + 1], numbers_[at + 2]}));
    }
    void direction(std::size_t at)
    {
        need(at + 3);
        set(at, copy_.map.vector({numbers_[at], numbers_[at + 1], numbers_[at + 2]}));
    }
    void length(std::size_t at)
    {
        need(at + 1);
        numbers_[at] *= copy_.scale;
    }

    std::vector<double> numbers_;
    const XformCopy& copy_;
    std::string place_;
};

/// Turns a surface inside out.
std::string inverted_type(std::string_view type)
{
    static constexpr std::pair<std::string_view, std::string_view> pairs[] = {
        {"sphere", "bubble"}, {"cone", "cup"}, {"cylinder", "tube"}};
    for (const auto& [outwards, inwards] : pairs) {
        if (type == outwards)
            return std::string(inwards);
        if (type == inwards)
            return std::string(outwards);
    }
    return std::string(type);
}

class XformRun {
public:
    XformRun(const XformWords& words, const GeneratorInput& input, const CommandPolicy& policy, int depth,
             std::string& out)
        : words_(words), input_(input), policy_(policy), depth_(depth), out_(out)
    {
    }

    void transform(std::string_view text, const std::string& name, const XformCopy& copy)
    {
        Words words(text, name);
        Primitive primitive;
        for (;;) {
            switch (words.next()) {
            case Words::Next::end:
                return;
            case Words::Next::comment:
                out_ += std::string(words.comment()) + '\n';
                break;
            case Words::Next::command: {
                const std::string place = words.place(words.offset());
                command(words.command(), place, copy);
                break;
            }
            case Words::Next::primitive:
                words.read(primitive);
                if (primitive.type == "alias")
                    out_ += fmt::format("\n{} alias {}\n\t{}\n", quoted_word(primitive.modifier),
                                        quoted_word(primitive.name), quoted_word(words.alias_target(primitive)));
                else
                    append(primitive, words.place(primitive), copy);
            }
            constexpr std::size_t most_text = std::size_t{2} << 30;
            if (out_.size() > most_text)
                throw InputError{name, "the copies make more than two gigabytes of text", "use instances"};
        }
    }

private:
    void command(const std::string& line, const std::string& place, const XformCopy& copy)
    {
        if (!words_.expand) {
            std::string options;
            for (const std::string& word : words_.shown)
                if (word != "-c")
                    options += ' ' + word;
            out_ += '\n' + line + (options.empty() ? "" : " | xform -e" + options) + '\n';
            return;
        }
        const std::string text = answer_command(line.substr(1), place + ": " + line, input_, policy_, depth_);
        transform(text, place, copy);
    }

    void append(const Primitive& primitive, const std::string& place, const XformCopy& copy)
    {
        const auto found = effects().find(primitive.type);
        const Effect effect = found == effects().end() ? Effect::none : found->second;
        const bool surface = is_surface(primitive.type);
        const bool invert = surface && words_.inverted;
        std::string name(primitive.name);
        if (surface && copy.name)
            name = *copy.name + '.' + name;
        out_ +=
            fmt::format("\n{} {} {}\n",
                        surface && words_.modifier ? quoted_word(*words_.modifier) : quoted_word(primitive.modifier),
                        invert ? inverted_type(primitive.type) : std::string(primitive.type), quoted_word(name));
        append_words(primitive, effect, copy);
        std::vector<double> numbers = MovedNumbers(primitive.numbers, copy, place).under(effect);
        if (invert)
            turn_round(effect, numbers);
        append_numbers(effect, numbers);
    }

    static void turn_round(Effect effect, std::vector<double>& numbers)
    {
        if (effect == Effect::ring)
            for (std::size_t i = 3; i < 6; ++i)
                numbers[i] = -numbers[i];
        if (effect == Effect::polygon) {
            std::reverse(numbers.begin(), numbers.end());
            for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
                std::swap(numbers[i], numbers[i + 2]);
        }
    }

    void append_words(const Primitive& primitive, Effect effect, const XformCopy& copy)
    {
        std::vector<std::string> list;
        for (const std::string_view word : primitive.words)
            list.push_back(quoted_word(word));
        if (effect == Effect::thick && !list.empty())
            if (const auto thickness = parse_double(list[0]))
                list[0] = shortest(*thickness * copy.scale);
        if ((effect == Effect::words || effect == Effect::thick) && !copy.words.empty()) {
            // What is repeated by an -i before it ends here.
            if (copy.words[0] != "-i")
                list.insert(list.end(), {"-i", "1"});
            list.insert(list.end(), copy.words.begin(), copy.words.end());
        }
        out_ += std::to_string(list.size());
        for (const std::string& word : list)
            out_ += ' ' + word;
        out_ += "\n0\n";
    }

    void append_numbers(Effect effect, const std::vector<double>& numbers)
    {
        const bool rows = effect == Effect::polygon || effect == Effect::cone || effect == Effect::cylinder ||
                          effect == Effect::ring || effect == Effect::lettering;
        out_ += std::to_string(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (rows && i % 3 == 0)
                out_ += '\n';
            else if (effect == Effect::aim && i == 4)
                out_ += "\n\t";
            out_ += number_text(numbers[i]);
        }
        out_ += '\n';
    }

    const XformWords& words_;
    const GeneratorInput& input_;
    const CommandPolicy& policy_;
    int depth_;
    std::string& out_;
};

/// The header of one copy.
std::string header(const XformWords& words, const XformCopy& copy)
{
    std::vector<std::string> all{"xform"};
    if (!words.array) {
        all.insert(all.end(), words.shown.begin(), words.shown.end());
    } else {
        all.insert(all.end(), {"-n", *copy.name});
        if (words.modifier)
            all.insert(all.end(), {"-m", *words.modifier});
        all.insert(all.end(), copy.words.begin(), copy.words.end());
    }
    return generators::comment_of(all);
}

struct Source {
    std::string name, text;
};

std::vector<Source> sources_of(const XformWords& words, const GeneratorInput& input, GeneratorAnswer& answer)
{
    std::vector<Source> sources;
    if (words.files.empty()) {
        sources.push_back({"(standard input)", input.standard_input ? input.standard_input() : ""});
        if (trimmed(sources[0].text).empty())
            answer.messages += "xform: (standard input): warning - empty file\n";
        return sources;
    }
    for (const std::string& name : words.files) {
        const auto file = input.find_file(name);
        if (!file)
            throw BadWords("cannot find file \"" + name + "\"");
        sources.push_back({name, std::string(MappedFile(*file).bytes())});
    }
    return sources;
}

void run_once(const std::vector<std::string>& words, const GeneratorInput& input, const CommandPolicy& policy,
              int depth, GeneratorAnswer& answer)
{
    const XformWords wish = read_xform_words(words, "xform");
    // The header stands even before a file that cannot be found.
    if (!wish.array)
        answer.text += header(wish, wish.copies.front());
    const std::vector<Source> sources = sources_of(wish, input, answer);
    XformRun run(wish, input, policy, depth, answer.text);
    for (const XformCopy& copy : wish.copies) {
        if (wish.array)
            answer.text += header(wish, copy);
        for (const Source& source : sources)
            run.transform(source.text, source.name, copy);
    }
}

/// One call for each line of the file after -f; comments pass.
void run_lines(const std::vector<std::string>& words, std::size_t option, const GeneratorInput& input,
               const CommandPolicy& policy, int depth, GeneratorAnswer& answer)
{
    if (option + 1 >= words.size())
        throw BadWords("command line error at '-f'");
    const auto file = input.find_file(words[option + 1]);
    if (!file)
        throw BadWords("cannot find file \"" + words[option + 1] + "\"");
    const std::string text(MappedFile(*file).bytes());
    int number = 0;
    for (const std::string_view line : split(text, "\r\n")) {
        const std::vector<std::string_view> own = split(line);
        if (own.empty())
            continue;
        if (own[0].starts_with('#')) {
            answer.text += std::string(line) + '\n';
            continue;
        }
        std::vector<std::string> call(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(option));
        call.insert(call.end(), own.begin(), own.end());
        call.insert(call.end(), words.begin() + static_cast<std::ptrdiff_t>(option) + 2, words.end());
        // The last name given counts; the number of the line makes it differ from the others.
        const auto last_name = std::find(call.rbegin(), call.rend(), "-n");
        const std::string suffix = '.' + std::to_string(number++);
        if (last_name != call.rend() && last_name != call.rbegin())
            *(last_name - 1) += suffix;
        else
            call.insert(call.begin() + 1, {"-n", 'a' + suffix});
        run_once(call, input, policy, depth, answer);
    }
}

} // namespace

GeneratorAnswer xform(const std::vector<std::string>& words, const GeneratorInput& input, const CommandPolicy& policy,
                      int depth)
{
    GeneratorAnswer answer;
    try {
        const auto option = std::find(words.begin(), words.end(), "-f");
        if (option == words.end())
            run_once(words, input, policy, depth, answer);
        else
            run_lines(words, static_cast<std::size_t>(option - words.begin()), input, policy, depth, answer);
    } catch (const BadWords& bad) {
        answer.messages += "xform: " + std::string(bad.what()) + '\n';
        answer.status = 1;
    } catch (const InputError& error) {
        answer.messages += "xform: fatal - " + std::string(error.what()) + '\n';
        answer.status = 1;
    }
    return answer;
}

} // namespace lightwell::scene_text
