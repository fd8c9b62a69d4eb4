#include "engine/pictures/rgbe_header.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/pictures/exr_file.h"

#include <cmath>

namespace lightwell {

namespace {

bool is_name_character(char c) noexcept
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '-';
}

/// The name of a line NAME=value; empty for a command line or other text.
std::string_view variable_name(std::string_view line) noexcept
{
    std::size_t end = 0;
    while (end < line.size() && is_name_character(line[end]))
        ++end;
    return end < line.size() && line[end] == '=' ? line.substr(0, end) : std::string_view{};
}

/// Numbers of an EXPOSURE (one) or COLORCORR (three) line.
std::vector<double> factors_in(std::string_view name, std::string_view value, std::size_t count,
                               const std::string& place)
{
    std::vector<double> numbers;
    for (const std::string_view word : split(value)) {
        const std::optional<double> number = parse_double(word);
        if (!(number && *number > 0 && std::isfinite(*number)))
            break;
        numbers.push_back(*number);
    }
    if (numbers.size() != count)
        throw InputError{place, std::string(name) + "=" + std::string(value) + " in the header",
                         "expected " + std::to_string(count) + " positive number" + (count > 1 ? "s" : "")};
    return numbers;
}

std::string joined(double a, double b, double c)
{
    return shortest(a) + " " + shortest(b) + " " + shortest(c);
}

/// PRIMARIES with few digits still mean the engine's own.
bool names_engine_primaries(std::string_view primaries)
{
    constexpr double last_digit = 1e-3;
    const Primaries& e = engine_primaries;
    const std::array<float, 8> own{e.red_x, e.red_y, e.green_x, e.green_y, e.blue_x, e.blue_y, e.white_x, e.white_y};
    const std::vector<std::string_view> words = split(primaries);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::optional<double> number = i < words.size() ? parse_double(words[i]) : std::nullopt;
        if (!number || !(std::fabs(*number - static_cast<double>(own[i])) <= last_digit))
            return false;
    }
    return true;
}

struct Factors {
    double exposure = 1;
    std::array<double, 3> colour{1, 1, 1};
};

void take_variable(std::string_view name, std::string_view value, RgbeHeader& header, Factors& factors,
                   const std::string& place)
{
    std::string& entry = header.variables[std::string(name)];
    if (name == "EXPOSURE") {
        factors.exposure *= factors_in(name, value, 1, place)[0];
        entry = shortest(factors.exposure);
    } else if (name == "COLORCORR") {
        const std::vector<double> numbers = factors_in(name, value, 3, place);
        for (std::size_t i = 0; i < 3; ++i)
            factors.colour[i] *= numbers[i];
        entry = joined(factors.colour[0], factors.colour[1], factors.colour[2]);
    } else if (name == "VIEW" && !entry.empty()) {
        entry.append(" ").append(value); // a later view states only what it changes
    } else {
        entry = value;
    }
}

/// Entries that are no lines of a Radiance header of their own.
bool is_kept_elsewhere(const std::string& name)
{
    return name == "history" || name == "FORMAT" || name == "EXPOSURE" || name == "COLORCORR" ||
           name == "chromaticities" || name == "whiteLuminance" || name.starts_with("units.");
}

std::string line_of(std::string name, std::string value)
{
    for (char& c : name)
        if (!is_name_character(c))
            c = '_';
    for (char& c : value)
        if (c == '\n' || c == '\r' || c == '\0')
            c = ' '; // a header line cannot hold a line break
    return name + "= " + value + "\n";
}

double entry_or_one(const Picture& picture, const std::string& name, std::size_t count, std::size_t which,
                    const std::string& place)
{
    const auto found = picture.header.find(name);
    return found == picture.header.end() ? 1 : factors_in(name, found->second, count, place)[which];
}

/// Lines that bring the product in the history to what the picture's own entries ask for.
void add_factors(const Picture& picture, const RgbeHeader& history, RgbeHeaderText& result, const std::string& place)
{
    constexpr double no_difference = 1e-6; // single precision of the pixels
    const auto in_history = [&](const std::string& name, std::size_t count, std::size_t which) {
        const auto found = history.variables.find(name);
        return found == history.variables.end() ? 1 : factors_in(name, found->second, count, place)[which];
    };
    const double exposure = entry_or_one(picture, "EXPOSURE", 1, 0, place);
    const double missing = exposure / in_history("EXPOSURE", 1, 0);
    if (!(std::fabs(missing - 1) <= no_difference))
        result.text += line_of("EXPOSURE", shortest(missing));
    std::array<double, 3> missing_colour{};
    bool complete = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const double colour = entry_or_one(picture, "COLORCORR", 3, i, place);
        missing_colour[i] = colour / in_history("COLORCORR", 3, i);
        complete = complete && std::fabs(missing_colour[i] - 1) <= no_difference;
        result.factors[i] = exposure * colour;
    }
    if (!complete)
        result.text += line_of("COLORCORR", joined(missing_colour[0], missing_colour[1], missing_colour[2]));
}

} // namespace

RgbeHeader parse_rgbe_header(std::string_view lines, const std::string& place)
{
    RgbeHeader header;
    Factors factors;
    for (bool first = true; !lines.empty(); first = false) {
        const std::string_view line = lines.substr(0, lines.find('\n'));
        lines.remove_prefix(std::min(lines.size(), line.size() + 1));
        const std::string_view name = variable_name(line);
        const std::string_view value = name.empty() ? name : trimmed(line.substr(name.size() + 1));
        if (name == "FORMAT")
            header.format = value;
        else if (!(first && line.starts_with("#?")) && !line.empty())
            header.history.append(header.history.empty() ? "" : "\n").append(line);
        if (!name.empty() && name != "FORMAT")
            take_variable(name, value, header, factors, place);
    }
    for (std::size_t i = 0; i < 3; ++i)
        header.factors[i] = factors.exposure * factors.colour[i];
    const auto primaries = header.variables.find("PRIMARIES");
    if (primaries != header.variables.end() && !names_engine_primaries(primaries->second))
        header.variables["chromaticities"] = primaries->second;
    return header;
}

RgbeHeaderText rgbe_header_of(const Picture& picture, const std::string& place)
{
    const auto entry = picture.header.find("history");
    const RgbeHeader history =
        parse_rgbe_header(entry == picture.header.end() ? std::string_view{} : entry->second, place);
    RgbeHeaderText result{"#?RADIANCE\n" + history.history + (history.history.empty() ? "" : "\n"), {}};
    for (const auto& [name, value] : picture.header) {
        const auto stated = history.variables.find(name);
        if (!is_kept_elsewhere(name) && (stated == history.variables.end() || stated->second != value))
            result.text += line_of(name, value);
    }
    const auto chromaticities = picture.header.find("chromaticities");
    if (chromaticities != picture.header.end() && !picture.header.contains("PRIMARIES"))
        result.text += line_of("PRIMARIES", chromaticities->second);
    add_factors(picture, history, result, place);
    result.text += "FORMAT=32-bit_rle_rgbe\n\n";
    return result;
}

} // namespace lightwell
