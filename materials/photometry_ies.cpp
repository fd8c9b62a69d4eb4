#include "materials/photometry_ies.h"

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

/// What follows a keyword of the label.
std::string keyword(const std::vector<std::string>& label, std::string_view word)
{
    for (const std::string& line : label)
        if (const std::size_t at = line.find(word); at != std::string::npos)
            return std::string(trimmed(std::string_view(line).substr(at + word.size())));
    return {};
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
void take_tilt(IesNumbers& numbers, IesFile& file)
{
    file.tilt_position = static_cast<int>(numbers.count("the lamp's position", 1));
    const std::size_t pairs = numbers.count("the number of tilt angles", 1);
    file.tilt_deg = numbers.list(pairs, "a tilt angle");
    file.tilt_share = numbers.list(pairs, "a tilt factor");
    for (std::size_t i = 0; i < pairs; ++i) {
        constexpr double most_share = 10; // lamps give somewhat more or less when they are tilted
        if (i > 0 && !(file.tilt_deg[i] > file.tilt_deg[i - 1]))
            throw InputError{numbers.place(), "tilt angles do not ascend"};
        if (!(file.tilt_share[i] >= 0 && file.tilt_share[i] <= most_share))
            throw InputError{numbers.place(), "a tilt factor is " + shortest(file.tilt_share[i]) + ", expected 0 to " +
                                                  shortest(most_share)};
    }
}

/// A size in the file's unit; the longest luminaires have a hundred metres.
double size_of(IesNumbers& numbers, const char* what, double unit)
{
    constexpr double longest_m = 1000;
    const double size = numbers.next(what);
    if (!(std::fabs(size * unit) <= longest_m))
        throw InputError{numbers.place(), std::string(what) + " is " + shortest(size * unit) + " m, expected at most " +
                                              shortest(longest_m) + " m"};
    return size;
}

/// A word of the file that is one of two or three numbers.
int choice(IesNumbers& numbers, const char* what, int most, const char* expected)
{
    const double number = numbers.next(what);
    for (int i = 1; i <= most; ++i)
        if (number == i)
            return i;
    throw InputError{numbers.place(), std::string(what) + " is " + shortest(number) + ", expected " + expected};
}

/// Everything behind the table of tilts.
void take_photometry(IesNumbers& numbers, IesFile& file)
{
    file.lamps = numbers.next("the number of lamps");
    file.lumens = numbers.next("the lumens of a lamp");
    file.multiplier = numbers.next("the multiplier");
    const std::size_t verticals = numbers.count("the number of vertical angles", 2);
    const std::size_t planes = numbers.count("the number of horizontal angles", 1);
    file.type = choice(numbers, "the photometric type", 3, "1 (C), 2 (B) or 3 (A)");
    file.metres = choice(numbers, "the unit", 2, "1 (feet) or 2 (metres)") == 1 ? metres_per_foot : 1;
    file.width = size_of(numbers, "the width", file.metres);
    file.length = size_of(numbers, "the length", file.metres);
    file.height = size_of(numbers, "the height", file.metres);
    file.ballast_factor = numbers.next("the ballast factor");
    file.lamp_factor = numbers.next("the ballast-lamp factor");
    file.watts = numbers.next("the input watts");
    file.vertical_deg = numbers.list(verticals, "a vertical angle");
    file.horizontal_deg = numbers.list(planes, "a horizontal angle");
    file.candela = numbers.list(planes * verticals, "a candela value");
    const double factor = file.multiplier * file.ballast_factor * file.lamp_factor;
    for (const double candela : file.candela)
        if (!(candela * factor >= 0 && std::isfinite(candela * factor)))
            throw InputError{numbers.place(),
                             std::string("a candela value is ") + shortest(candela * factor) + ", expected at least 0"};
}

/// The lines of a text without their ends, UTF-8.
std::vector<std::string> lines_of(std::string_view text)
{
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        lines.push_back(to_utf8(line.substr(0, line.find('\r'))));
        at = end + 1;
    }
    return lines;
}

} // namespace

bool looks_like_ies(std::string_view text)
{
    return tilt_line(text) != std::string_view::npos;
}

IesFile read_ies_file(std::string_view text, const std::string& file_name, Report& report)
{
    const std::size_t tilt = tilt_line(text);
    if (tilt == std::string_view::npos)
        throw InputError{file_name, "no line TILT=", "expected a file of the form IES LM-63"};
    const std::size_t end = std::min(text.find('\n', tilt), text.size());
    IesFile file;
    file.label = lines_of(text.substr(0, tilt));
    file.tilt = std::string(trimmed(text.substr(tilt + 5, end - tilt - 5)));
    IesNumbers numbers{text.substr(end), file.label.size() + 1, file_name};
    if (lowercase_ascii(file.tilt) == "include")
        take_tilt(numbers, file);
    take_photometry(numbers, file);
    if (!numbers.at_end())
        report.add(Finding::ignored, numbers.place(), "what stands behind the intensities is not read");
    return file;
}

void read_tilt_table(std::string_view text, const std::string& file_name, IesFile& file)
{
    IesNumbers numbers{text, 1, file_name};
    take_tilt(numbers, file);
}

Photometry parse_ies(std::string_view text, const std::string& file_name, Report& report)
{
    IesFile file = read_ies_file(text, file_name, report);
    Photometry photometry;
    photometry.type = file.type == 1 ? Photometry::Type::C : file.type == 2 ? Photometry::Type::B : Photometry::Type::A;
    photometry.name = keyword(file.label, "[LUMINAIRE]");
    const std::string tilt = lowercase_ascii(file.tilt);
    if (tilt != "include" && tilt != "none")
        photometry.tilt_file = file.tilt;
    photometry.opening = opening_of(file.width * file.metres, file.length * file.metres, file.height * file.metres);
    photometry.watts = file.watts;
    photometry.lamp_lumens = file.lumens > 0 ? file.lamps * file.lumens : 0;
    photometry.vertical_deg = std::move(file.vertical_deg);
    photometry.horizontal_deg = std::move(file.horizontal_deg);
    photometry.tilt_deg = std::move(file.tilt_deg);
    photometry.tilt_share = std::move(file.tilt_share);
    photometry.candela = std::move(file.candela);
    for (double& candela : photometry.candela)
        candela *= file.multiplier * file.ballast_factor * file.lamp_factor;
    complete_planes(photometry, file_name);
    return photometry;
}

void parse_tilt(std::string_view text, const std::string& file_name, Photometry& photometry)
{
    IesFile file;
    read_tilt_table(text, file_name, file);
    photometry.tilt_deg = std::move(file.tilt_deg);
    photometry.tilt_share = std::move(file.tilt_share);
}

} // namespace lightwell
