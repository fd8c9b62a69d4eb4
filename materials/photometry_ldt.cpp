#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "materials/photometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lightwell {
namespace {

constexpr double metres_per_mm = 1e-3;

/// Lines of the file; numbers may have a comma for the point.
class LdtLines {
public:
    LdtLines(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}
    std::string text(const char* what)
    {
        if (at_ >= text_.size())
            throw InputError{place(), std::string("the file ends before ") + what};
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        return to_utf8(trimmed(line.substr(0, line.find('\r'))));
    }
    double number(const char* what, double low, double high)
    {
        std::string word = text(what);
        std::replace(word.begin(), word.end(), ',', '.');
        const auto number = word.empty() ? std::optional<double>{0} : parse_double(word);
        if (!number || !(*number >= low && *number <= high))
            throw InputError{place(), std::string(what) + " is \"" + word + "\", expected " + shortest(low) + " to " +
                                          shortest(high)};
        return *number;
    }
    void skip(int lines, const char* what)
    {
        for (int i = 0; i < lines; ++i)
            text(what);
    }
    std::string place() const { return file_ + ':' + std::to_string(line_); }

private:
    std::string_view text_;
    std::size_t at_ = 0, line_ = 0;
    std::string file_;
};

/// The planes that a symmetry stores, as places in the list of all planes.
std::vector<std::size_t> stored_planes(int symmetry, std::size_t planes, const std::string& place)
{
    std::size_t first = 0, count = planes;
    if (symmetry == 1)
        count = 1;
    else if (symmetry == 2)
        count = planes / 2 + 1;
    else if (symmetry == 3)
        first = 3 * planes / 4, count = planes / 2 + 1;
    else if (symmetry == 4)
        count = planes / 4 + 1;
    if ((symmetry == 2 && planes % 2 != 0) || (symmetry > 2 && planes % 4 != 0))
        throw InputError{place, std::to_string(planes) + " planes do not fit the symmetry " + std::to_string(symmetry)};
    std::vector<std::size_t> stored;
    for (std::size_t i = 0; i < count; ++i)
        stored.push_back((first + i) % planes);
    return stored;
}

/// The length lies across plane 0. A width of 0 says round; heights are of the luminous sides.
Photometry::Opening opening(LdtLines& lines)
{
    using Shape = Photometry::Opening::Shape;
    constexpr double longest_mm = 1e6;
    const double length = lines.number("the length of the opening", 0, longest_mm) * metres_per_mm;
    const double width = lines.number("the width of the opening", 0, longest_mm) * metres_per_mm;
    double height = 0;
    for (int side = 0; side < 4; ++side)
        height = std::max(height, lines.number("a height of the opening", -longest_mm, longest_mm) * metres_per_mm);
    if (length == 0 && width == 0)
        return {};
    if (width == 0)
        return {height > 0 ? Shape::vertical_cylinder : Shape::ellipse, length, length, height};
    return {height > 0 ? Shape::box : Shape::rectangle, width, std::max(length, metres_per_mm), height};
}

/// The lamp sets; the first one is taken to be in the luminaire.
void read_lamps(LdtLines& lines, const std::string& file_name, Photometry& photometry, Report& report)
{
    constexpr double large = 1e9, most_sets = 20;
    const auto sets = static_cast<int>(lines.number("the number of lamp sets", 1, most_sets));
    for (int set = 0; set < sets; ++set) {
        lines.number("the number of lamps", -large, large);
        lines.skip(1, "the type of lamps");
        const double lumens = lines.number("the flux of lamps", 0, large);
        lines.skip(2, "colour of lamps");
        const double watts = lines.number("the watts", 0, large);
        if (set == 0) {
            photometry.lamp_lumens = lumens;
            photometry.watts = watts;
        }
    }
    if (sets > 1)
        report.add(Finding::assumed, file_name, "several sets of lamps: the first one is in the luminaire");
}

} // namespace

Photometry parse_eulumdat(std::string_view text, const std::string& file_name, Report& report)
{
    constexpr double large = 1e9, most_planes = 721, most_angles = 721;
    LdtLines lines{text, file_name};
    Photometry photometry;
    lines.skip(1, "the company");
    lines.number("the type", 0, 10);
    const int symmetry = static_cast<int>(lines.number("the symmetry", 0, 4));
    const auto planes = static_cast<std::size_t>(lines.number("the number of planes", 1, most_planes));
    lines.number("the distance between planes", 0, 360);
    const auto angles = static_cast<std::size_t>(lines.number("the number of intensities in a plane", 2, most_angles));
    lines.number("the distance between intensities", 0, 180);
    lines.skip(1, "the report");
    photometry.name = lines.text("the name");
    lines.skip(3, "number, file and date");
    lines.number("the length", 0, large);
    lines.number("the width", 0, large);
    lines.number("the height", 0, large);
    photometry.opening = opening(lines);
    lines.skip(2, "flux fraction and light output ratio");
    const double factor = lines.number("the conversion factor", 0, large);
    lines.number("the tilt", -360, 360);
    read_lamps(lines, file_name, photometry, report);
    lines.skip(10, "direct ratios");
    std::vector<double> plane_deg;
    for (std::size_t i = 0; i < planes; ++i)
        plane_deg.push_back(lines.number("the angle of a plane", -360, 360));
    for (std::size_t i = 0; i < angles; ++i)
        photometry.vertical_deg.push_back(lines.number("a vertical angle", 0, 180));
    const std::vector<std::size_t> stored = stored_planes(symmetry, planes, lines.place());
    // Symmetry 3 stores C270 to C90, x > 0; as -90 to 90 the planes ascend, and their mirror images are 90 to 270.
    std::vector<std::vector<double>> rows;
    for (const std::size_t plane : stored) {
        photometry.horizontal_deg.push_back(symmetry == 3 ? 180 - std::remainder(plane_deg[plane], 360)
                                                          : plane_deg[plane]);
        rows.emplace_back();
        for (std::size_t i = 0; i < angles; ++i)
            rows.back().push_back(lines.number("an intensity", 0, large) * photometry.lamp_lumens / 1000 *
                                  (factor > 0 ? factor : 1));
    }
    if (symmetry == 3) { // the mirrored half, which complete_planes() mirrors back
        std::reverse(photometry.horizontal_deg.begin(), photometry.horizontal_deg.end());
        std::reverse(rows.begin(), rows.end());
    }
    for (const std::vector<double>& row : rows)
        photometry.candela.insert(photometry.candela.end(), row.begin(), row.end());
    complete_planes(photometry, file_name);
    return photometry;
}

} // namespace lightwell
