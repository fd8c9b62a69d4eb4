#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "materials/photometry.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr double metres_per_foot = 0.3048;
constexpr double most_angles = 10'000;

/// Numbers of the file one after the other, with the line each stands in.
class IesNumbers {
public:
    IesNumbers(std::string_view text, std::size_t line, const std::string& file) : text_(text), line_(line), file_(file)
    {
    }
    double next(const char* what)
    {
        while (at_ < text_.size() && is_gap(text_[at_]))
            line_ += text_[at_++] == '\n' ? 1 : 0;
        std::size_t end = at_;
        while (end < text_.size() && !is_gap(text_[end]))
            ++end;
        const std::string_view word = text_.substr(at_, end - at_);
        at_ = end;
        if (word.empty())
            throw InputError{place(), std::string("the file ends before ") + what};
        const auto number = parse_double(word);
        if (!number || !std::isfinite(*number))
            throw InputError{place(), std::string(what) + " is \"" + std::string(word) + "\", expected a number"};
        return *number;
    }
    std::size_t count(const char* what, double least)
    {
        const double number = next(what);
        if (!(number >= least && number <= most_angles))
            throw InputError{place(), std::string(what) + " is " + shortest(number) + ", expected " + shortest(least) +
                                          " to " + shortest(most_angles)};
        return static_cast<std::size_t>(number);
    }
    std::vector<double> list(std::size_t size, const char* what)
    {
        std::vector<double> numbers;
        for (std::size_t i = 0; i < size; ++i)
            numbers.push_back(next(what));
        return numbers;
    }
    std::string place() const { return file_ + ':' + std::to_string(line_); }
    bool at_end() const { return std::all_of(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), is_gap); }

private:
    static bool is_gap(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\x1a'; }
    std::string_view text_;
    std::size_t at_ = 0, line_;
    std::string file_;
};

/// Where the line `TILT=` begins, behind the keywords.
std::size_t tilt_line(std::string_view text)
{
    for (std::size_t at = 0; at < text.size();) {
        if (lowercase_ascii(text.substr(at, 5)) == "tilt=")
            return at;
        const std::size_t end = text.find('\n', at);
        at = end == std::string_view::npos ? text.size() : end + 1;
    }
    return std::string_view::npos;
}

std::string keyword(std::string_view head, std::string_view word)
{
    const std::size_t at = head.find(word);
    if (at == std::string_view::npos)
        return {};
    const std::string_view rest = head.substr(at + word.size());
    return to_utf8(trimmed(rest.substr(0, rest.find_first_of("\r\n"))));
}

using Shape = Photometry::Opening::Shape;

/// What an opening without height is: sizes below 0 are diameters, one of them may be left out.
Photometry::Opening flat_opening(double x, double y)
{
    const bool round = x < 0 || y < 0;
    const double a = std::fabs(x), b = std::fabs(y), size = std::max(a, b);
    if (size == 0)
        return {};
    if (round)
        return {Shape::ellipse, a > 0 ? a : size, b > 0 ? b : size, 0};
    // A line of light: as wide as a millimetre.
    constexpr double thin_m = 0.001;
    return {Shape::rectangle, std::max(a, thin_m), std::max(b, thin_m), 0};
}

/// Source  LM-63-2019, table of luminous openings; of LM-63-1995 those that it does not have
Photometry::Opening opening_of(double width, double length, double height)
{
    const double x = length, y = width, a = std::fabs(x), b = std::fabs(y), h = std::fabs(height);
    if (height == 0)
        return flat_opening(x, y);
    if (height > 0) {
        if (x < 0 || y < 0)
            return {Shape::vertical_cylinder, a > 0 ? a : b, b > 0 ? b : a, h};
        if (a == 0 && b == 0)
            return {};
        const Photometry::Opening flat = flat_opening(x, y);
        return {Shape::box, flat.x_m, flat.y_m, h};
    }
    const bool lies_along_x = x > 0 && (y == 0 || std::fabs(b - h) < 1e-6 * h);
    const bool lies_along_y = y > 0 && (x == 0 || std::fabs(a - h) < 1e-6 * h);
    if (lies_along_x)
        return {Shape::cylinder_along_x, a, h, h};
    if (lies_along_y)
        return {Shape::cylinder_along_y, h, b, h};
    const double across = a > 0 ? a : b, other = b > 0 ? b : across;
    if (across == 0 || (std::fabs(across - h) < 1e-6 * h && std::fabs(other - h) < 1e-6 * h))
        return {Shape::sphere, h, h, h};
    return {Shape::ellipsoid, across, other, h};
}

/// How much light the lamps give when the luminaire is tilted.
void take_tilt(IesNumbers& numbers, Photometry& photometry)
{
    numbers.next("the lamp's position");
    const std::size_t pairs = numbers.count("the number of tilt angles", 1);
    photometry.tilt_deg = numbers.list(pairs, "a tilt angle");
    photometry.tilt_share = numbers.list(pairs, "a tilt factor");
    for (std::size_t i = 0; i < pairs; ++i) {
        constexpr double most_share = 10; // lamps give somewhat more or less when they are tilted
        if (i > 0 && !(photometry.tilt_deg[i] > photometry.tilt_deg[i - 1]))
            throw InputError{numbers.place(), "tilt angles do not ascend"};
        if (!(photometry.tilt_share[i] >= 0 && photometry.tilt_share[i] <= most_share))
            throw InputError{numbers.place(), "a tilt factor is " + shortest(photometry.tilt_share[i]) +
                                                  ", expected 0 to " + shortest(most_share)};
    }
}

/// A size in the file's unit; the longest luminaires have a hundred metres.
double size_m(IesNumbers& numbers, const char* what, double unit)
{
    constexpr double longest_m = 1000;
    const double size = numbers.next(what) * unit;
    if (!(std::fabs(size) <= longest_m))
        throw InputError{numbers.place(), std::string(what) + " is " + shortest(size) + " m, expected at most " +
                                              shortest(longest_m) + " m"};
    return size;
}

} // namespace

bool looks_like_ies(std::string_view text)
{
    return tilt_line(text) != std::string_view::npos;
}

Photometry parse_ies(std::string_view text, const std::string& file_name, Report& report)
{
    const std::size_t tilt = tilt_line(text);
    if (tilt == std::string_view::npos)
        throw InputError{file_name, "no line TILT=", "expected a file of the form IES LM-63"};
    const std::size_t end = std::min(text.find('\n', tilt), text.size());
    const std::string tilt_word = lowercase_ascii(trimmed(text.substr(tilt + 5, end - tilt - 5)));
    const auto lines =
        static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(tilt), '\n'));
    IesNumbers numbers{text.substr(end), lines + 1, file_name};
    Photometry photometry;
    if (tilt_word == "include")
        take_tilt(numbers, photometry);
    else if (tilt_word != "none")
        photometry.tilt_file = std::string(trimmed(text.substr(tilt + 5, end - tilt - 5)));
    photometry.name = keyword(text.substr(0, tilt), "[LUMINAIRE]");
    const double lamps = numbers.next("the number of lamps"), lumens = numbers.next("the lumens of a lamp");
    const double multiplier = numbers.next("the multiplier");
    const std::size_t verticals = numbers.count("the number of vertical angles", 2);
    const std::size_t planes = numbers.count("the number of horizontal angles", 1);
    const double type = numbers.next("the photometric type"), unit = numbers.next("the unit");
    if (type != 1 && type != 2 && type != 3)
        throw InputError{numbers.place(),
                         std::string("the photometric type is ") + shortest(type) + ", expected 1 (C), 2 (B) or 3 (A)"};
    photometry.type = type == 1 ? Photometry::Type::C : type == 2 ? Photometry::Type::B : Photometry::Type::A;
    if (unit != 1 && unit != 2)
        throw InputError{numbers.place(),
                         std::string("the unit is ") + shortest(unit) + ", expected 1 (feet) or 2 (metres)"};
    const double metres = unit == 1 ? metres_per_foot : 1;
    const double width = size_m(numbers, "the width", metres), length = size_m(numbers, "the length", metres);
    photometry.opening = opening_of(width, length, size_m(numbers, "the height", metres));
    const double ballast = numbers.next("the ballast factor"), lamp_factor = numbers.next("the ballast-lamp factor");
    photometry.watts = numbers.next("the input watts");
    photometry.lamp_lumens = lumens > 0 ? lamps * lumens : 0;
    photometry.vertical_deg = numbers.list(verticals, "a vertical angle");
    photometry.horizontal_deg = numbers.list(planes, "a horizontal angle");
    photometry.candela = numbers.list(planes * verticals, "a candela value");
    const double factor = multiplier * ballast * lamp_factor;
    for (double& candela : photometry.candela)
        if (candela *= factor; !(candela >= 0 && std::isfinite(candela)))
            throw InputError{numbers.place(),
                             std::string("a candela value is ") + shortest(candela) + ", expected at least 0"};
    if (!numbers.at_end())
        report.add(Finding::ignored, numbers.place(), "what stands behind the intensities is not read");
    complete_planes(photometry, file_name);
    return photometry;
}

void parse_tilt(std::string_view text, const std::string& file_name, Photometry& photometry)
{
    IesNumbers numbers{text, 1, file_name};
    take_tilt(numbers, photometry);
}

} // namespace lightwell
