#include "plugins/commands/lamp_table.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "plugins/commands/library_path.h"

#include <algorithm>
#include <regex>

namespace lightwell::commands {
namespace {

/// Patterns and names are short; longer ones would only make the search slow.
constexpr std::size_t most_pattern = 200, most_name = 500;

/// Chromaticities of CIE standard illuminants (CIE 15:2018: A, D65, the F series, high pressure lamps HP), and the
/// share of light that is left on average over a lamp's life as lamp makers give it. Light-emitting diodes are missing:
/// they have no colour of their own.
constexpr std::string_view own_table = R"(
/warm[- ]?white/                .4370 .4042 .85
/neutral[- ]?white/             .4091 .3941 .85
/cool[- ]?white/                .3805 .3769 .85
/daylight/                      .3129 .3292 .85
/high[- ]pressure.*sodium|\bHPS\b/ .5330 .4150 .9
/low[- ]pressure.*sodium|\bLPS\b/ .5690 .4210 .93
/sodium/                        (low pressure sodium)
/metal[- ]halide/               .3812 .3797 .8
/mercury/                       .3730 .4150 .8
/xenon/                         .3240 .3240 1
/halogen|quartz/                .4242 .3990 1
/incandescent|tungsten/         .4476 .4074 .95
/fluorescent|\bfluor/           (cool white)
/\bD65/                         .3127 .3290 1
)";

/// `\<` and `\>` are not known to the library's patterns.
std::string with_word_ends(std::string pattern)
{
    for (const char* end : {"\\<", "\\>"})
        for (std::size_t at = 0; (at = pattern.find(end, at)) != std::string::npos; at += 2)
            pattern[at + 1] = 'b';
    return pattern;
}

std::regex compiled(const std::string& pattern)
{
    return std::regex(pattern, std::regex::ECMAScript | std::regex::icase);
}

LampKind kind_of(std::string_view text, const std::string& place)
{
    const auto words = split(text);
    std::vector<double> numbers;
    for (const std::string_view word : words)
        if (const auto number = parse_double(word); number && *number > 0 && *number <= 1)
            numbers.push_back(*number);
    if (words.size() != 3 || numbers.size() != 3 || numbers[0] + numbers[1] > 1)
        throw InputError{place, "\"" + std::string(trimmed(text)) + "\" is no lamp",
                         "expected x y DEPRECIATION, each above 0 and at most 1, or (ANOTHER LAMP)"};
    return {numbers[0], numbers[1], numbers[2]};
}

} // namespace

Spectrum LampKind::colour() const
{
    // XYZ with Y = 1 to the primaries (.64 .33, .29 .60, .15 .06) with the white point of equal energy.
    const double big_x = x / y, big_z = (1 - x - y) / y;
    const Spectrum pure{2.56531284 * big_x - 1.16684962 - 0.39846323 * big_z,
                        -1.02210817 * big_x + 1.97828662 + 0.04382156 * big_z,
                        0.07472438 * big_x - 0.25193957 + 1.17721519 * big_z};
    return Spectrum{std::max(0.0, pure.r), std::max(0.0, pure.g), std::max(0.0, pure.b)} * depreciation;
}

LampTable LampTable::parsed(std::string_view text, const std::string& file_name)
{
    LampTable table;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(text.substr(at, end - at));
        const std::string place = file_name + ':' + std::to_string(++number);
        at = end + 1;
        if (line.empty() || line[0] == '#')
            continue;
        const std::size_t close = line.find(line[0], 1);
        if (close == std::string_view::npos || close > most_pattern)
            throw InputError{place, "the pattern does not end", "write it between two equal characters"};
        Line entry{with_word_ends(std::string(line.substr(1, close - 1))), {}, {}};
        try {
            compiled(entry.pattern);
        } catch (const std::regex_error&) {
            throw InputError{place, "\"" + entry.pattern + "\" is no pattern"};
        }
        const std::string_view rest = trimmed(line.substr(close + 1));
        if (rest.size() > 2 && rest.front() == '(' && rest.back() == ')')
            entry.alias = std::string(rest.substr(1, rest.size() - 2));
        else
            entry.kind = kind_of(rest, place);
        table.lines_.push_back(std::move(entry));
    }
    return table;
}

std::optional<LampTable> LampTable::loaded(const std::string& name)
{
    if (const auto file = find_in_library(name))
        return parsed(MappedFile(*file).bytes(), file->string());
    if (name == "lamp.tab")
        return parsed(own_table, "the lamps of ies2rad");
    return std::nullopt;
}

const LampTable::Line* LampTable::line_of(const std::string& name) const
{
    const std::string searched = name.substr(0, most_name);
    const auto found = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
        return std::regex_search(searched, compiled(line.pattern));
    });
    return found == lines_.end() ? nullptr : &*found;
}

std::optional<LampKind> LampTable::find(const std::string& name) const
{
    const Line* line = line_of(name);
    // Names that stand for one another end nowhere: no chain is longer than the table.
    for (std::size_t steps = 0; line != nullptr && steps < lines_.size(); ++steps) {
        if (line->alias.empty())
            return line->kind;
        line = line_of(line->alias);
    }
    return std::nullopt;
}

} // namespace lightwell::commands
