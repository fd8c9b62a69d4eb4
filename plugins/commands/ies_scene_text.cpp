#include "plugins/commands/ies_scene_text.h"

#include "plugins/commands/command.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace lightwell::commands {
namespace {

/// Radiance's luminous efficacy of white light, which its data files are divided by; lumens_per_watt is the same.
constexpr double candela_per_watt = 179;
/// Files round their angles to hundredths of a degree.
constexpr double same_step_deg = 1e-3;
constexpr int numbers_a_line = 4;

void append_numbers(std::string& text, const std::vector<double>& numbers, double factor)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += fmt::format("\t{:g}", numbers[i] * factor);
        if ((i + 1) % numbers_a_line == 0 || i + 1 == numbers.size())
            text += '\n';
    }
}

/// One dimension of a data file: its ends when the steps are even, else all places.
void append_places(std::string& text, const std::vector<double>& places)
{
    const double step = (places.back() - places.front()) / static_cast<double>(places.size() - 1);
    bool even = true;
    for (std::size_t i = 1; i < places.size(); ++i)
        even = even && std::fabs(places[i] - places[i - 1] - step) < same_step_deg;
    text += fmt::format("{:g} {:g} {}\n", even ? places.front() : 0, even ? places.back() : 0, places.size());
    if (!even)
        append_numbers(text, places, 1);
}

/// What turns a direction into the places of the table, and the transform that goes with it.
struct Coordinates {
    std::vector<std::string> functions, transform;
};

Coordinates coordinates_of(const IesFile& file)
{
    const std::vector<double>&planes = file.horizontal_deg, &angles = file.vertical_deg;
    if (file.type == 2) {
        Coordinates found{{planes.front() < 0 ? "srcB_horiz" : "srcB_horiz2"}, {}};
        if (planes.size() == 1)
            found.functions.clear();
        found.functions.push_back(angles.front() < 0 ? "srcB_vert" : "srcB_vert2");
        return found;
    }
    if (planes.size() == 1)
        return {{"src_theta"}, {}};
    const double span = planes.back() - planes.front();
    const std::string plane = span <= 90 + same_step_deg    ? "src_phi4"
                              : span <= 180 + same_step_deg ? "src_phi2"
                                                            : "src_phi";
    if (std::fabs(planes.front() - 90) < same_step_deg) // what is symmetric about the plane from 90 to 270
        return {{plane + "+90", "src_theta"}, {"-rz", "-90"}};
    return {{plane, "src_theta"}, {}};
}

std::string list_of(const std::vector<std::string>& words)
{
    std::string text = std::to_string(words.size());
    for (const std::string& word : words)
        text += ' ' + word;
    return text + " \n";
}

std::string numbers_of(const std::vector<double>& numbers)
{
    std::string text = std::to_string(numbers.size());
    for (const double number : numbers)
        text += fmt::format(" {:g}", number);
    return text + '\n';
}

/// How surfaces share what the table says: the function, and its numbers behind the factor.
struct Correction {
    const char* function = "flatcorr";
    double per_area = 1; ///< 1/m2; 1 where the function divides
    std::vector<double> sizes = {};
};

class LampText {
public:
    LampText(const IesFile& file, const IesWish& wish)
        : wish_(wish), down_(file.type != 1 || file.vertical_deg.front() < 90),
          up_(file.type == 1 && file.vertical_deg.back() > 90)
    {
    }
    Correction correction(const std::optional<IesOpening>& opening) const
    {
        using Shape = IesOpening::Shape;
        if (!opening) {
            const double radius_m = *wish_.illum_radius / wish_.units_per_metre;
            return {"corr", 1 / (std::numbers::pi * radius_m * radius_m)};
        }
        const double width = opening->width_m, length = opening->length_m, height = opening->height_m;
        const double disk = std::numbers::pi / 4 * width * width;
        if (opening->shape == Shape::sphere)
            return {"corr", 1 / disk};
        const bool has_sides = down_ && up_ && height > 0.0005 + 1e-9; // what is flat has the least height
        if (opening->shape == Shape::disk)
            return has_sides ? Correction{"cylcorr", 1, {width, height}} : Correction{"flatcorr", 1 / disk};
        return has_sides ? Correction{"boxcorr", 1, {length, width, height}}
                         : Correction{"flatcorr", 1 / (width * length)};
    }
    std::string surfaces(const std::optional<IesOpening>& opening) const
    {
        using Shape = IesOpening::Shape;
        if (!opening)
            return sphere(*wish_.illum_radius);
        const double to_units = wish_.units_per_metre;
        if (opening->shape == Shape::sphere)
            return sphere(opening->width_m / 2 * to_units);
        const bool sides = !correction(opening).sizes.empty();
        return opening->shape == Shape::disk ? disks(*opening, sides) : faces(*opening, sides);
    }

private:
    std::string head(const char* type, const char* suffix, int numbers) const
    {
        return fmt::format("\n'{0}_light' {1} '{0}.{2}'\n0\n0\n{3}", wish_.name, type, suffix, numbers);
    }
    std::string sphere(double radius) const { return head("sphere", "s", 4) + fmt::format(" 0 0 0 {:g}\n", radius); }
    std::string disks(const IesOpening& opening, bool side) const
    {
        const double radius = opening.width_m / 2 * wish_.units_per_metre;
        const double z = opening.height_m / 2 * wish_.units_per_metre;
        std::string text;
        if (down_)
            text += head("ring", "d", 8) + fmt::format("\n\t0 0 {:g}\n\t0 0 -1\n\t0 {:g}\n", -z, radius);
        if (up_)
            text += head("ring", "u", 8) + fmt::format("\n\t0 0 {:g}\n\t0 0 1\n\t0 {:g}\n", z, radius);
        if (side)
            text += head("cylinder", "c", 7) + fmt::format("\n\t0 0 {:g}\n\t0 0 {:g}\n\t{:g}\n", z, -z, radius);
        return text;
    }
    std::string faces(const IesOpening& opening, bool sides) const
    {
        const double x = opening.length_m / 2 * wish_.units_per_metre;
        const double y = opening.width_m / 2 * wish_.units_per_metre;
        const double z = opening.height_m / 2 * wish_.units_per_metre;
        const auto face = [&](const char* suffix, const double(&corners)[4][3]) {
            std::string text = head("polygon", suffix, 12) + '\n';
            for (const auto& c : corners)
                text += fmt::format("\t{:g}\t{:g}\t{:g}\n", c[0] * x, c[1] * y, c[2] * z);
            return text;
        };
        std::string text;
        if (down_)
            text += face("d", {{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}});
        if (up_)
            text += face("u", {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
        if (sides)
            text += face("1", {{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}}) +
                    face("2", {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}) +
                    face("3", {{1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}}) +
                    face("4", {{-1, 1, -1}, {-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}});
        return text;
    }

    const IesWish& wish_;
    bool down_, up_; ///< directions that the table holds
};

std::string tilt_text(const IesFile& file, const IesWish& wish)
{
    std::vector<std::string> words{"noop", wish.tilt_file, "tilt.cal",
                                   file.tilt_position == 1 ? "tilt_ang" : "tilt_xang"};
    if (file.tilt_position == 2)
        words.insert(words.end(), {"-rz", "90"});
    return fmt::format("\nvoid brightdata {}\n{}0\n0\n", wish.tilt_name, list_of(words));
}

std::string shape_comments(const std::optional<IesOpening>& opening)
{
    if (!opening)
        return "# IES file shape overridden\n# Radiance geometry shape = sphere\n";
    using Shape = IesOpening::Shape;
    const char* const made = opening->shape == Shape::sphere ? "sphere"
                             : opening->shape == Shape::disk ? "disk or cylinder"
                                                             : "rectangle or box";
    std::string text = fmt::format("# IES file shape = {}\n# Radiance geometry shape = {}\n", opening->name, made);
    if (!opening->replaced.empty())
        text += fmt::format("# makeshape: shape is {}, which is not supported.\n# makeshape: replaced with {}\n",
                            opening->replaced, opening->replacement);
    return text;
}

} // namespace

std::string ies_data(const IesFile& file)
{
    const bool one_plane = file.horizontal_deg.size() == 1;
    std::string text = one_plane ? "1\n" : "2\n";
    if (!one_plane)
        append_places(text, file.horizontal_deg);
    append_places(text, file.vertical_deg);
    text += '\n';
    append_numbers(text, file.candela, 1 / candela_per_watt);
    return text;
}

std::string ies_tilt_data(const IesFile& file)
{
    std::string text = fmt::format("1\n0 0 {}\n", file.tilt_deg.size());
    append_numbers(text, file.tilt_deg, 1);
    text += '\n';
    append_numbers(text, file.tilt_share, 1);
    return text;
}

std::string ies_scene_text(const IesFile& file, const std::optional<IesOpening>& opening, const IesWish& wish)
{
    if (file.type == 3)
        throw Fatal("unsupported photometric type (3)");
    std::string text;
    for (const std::string& comment : wish.comments)
        text += comment + '\n';
    if (!wish.tilt_name.empty())
        text += tilt_text(file, wish);
    text += fmt::format("\n# {:g} watt luminaire, lamp*ballast factor = {:g}\n", file.watts,
                        file.ballast_factor * file.lamp_factor);
    text += shape_comments(opening);
    const LampText lamp(file, wish);
    const Correction correction = lamp.correction(opening);
    const Coordinates coordinates = coordinates_of(file);
    std::vector<std::string> words{correction.function, '\'' + wish.data_file + '\'', "source.cal"};
    words.insert(words.end(), coordinates.functions.begin(), coordinates.functions.end());
    words.insert(words.end(), coordinates.transform.begin(), coordinates.transform.end());
    std::vector<double> numbers{wish.factor * file.multiplier * file.ballast_factor * file.lamp_factor *
                                correction.per_area};
    numbers.insert(numbers.end(), correction.sizes.begin(), correction.sizes.end());
    text += fmt::format("\n'{}' brightdata '{}_dist'\n{}0\n{}", wish.tilt_name.empty() ? "void" : wish.tilt_name,
                        wish.name, list_of(words), numbers_of(numbers));
    text += fmt::format("\n'{0}_dist' {1} '{0}_light'\n0\n0\n3 {2:g} {3:g} {4:g}\n", wish.name,
                        opening ? "light" : "illum", wish.colour.r, wish.colour.g, wish.colour.b);
    return text + lamp.surfaces(opening);
}

} // namespace lightwell::commands
