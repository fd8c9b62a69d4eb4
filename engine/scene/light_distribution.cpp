#include "engine/scene/light_distribution.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "materials/functions/definitions.h"
#include "materials/patterns/channels.h"
#include "materials/patterns/place_function.h"

#include <array>

namespace lightwell {
namespace {

constexpr const char* function_file = "source.cal";
constexpr const char* function_context = "source";

/// An axis of the table: measured angles, and none of the light beyond them.
struct Axis {
    std::vector<double> angles;
    bool dark_before = false, dark_after = false;
};

/// Beyond their ends tables go on as they end: an entry of 0 close by and one at the limit stop that.
Axis closed_axis(const std::vector<double>& measured, double low, double high)
{
    constexpr double close_deg = 0.01;
    Axis axis{measured, measured.front() > low + close_deg, measured.back() < high - close_deg};
    if (axis.dark_before)
        axis.angles.insert(axis.angles.begin(), {low, measured.front() - close_deg / 2});
    if (axis.dark_after)
        axis.angles.insert(axis.angles.end(), {measured.back() + close_deg / 2, high});
    return axis;
}

DataTable::Dimension dimension_of(const Axis& axis)
{
    return {axis.angles.front(), axis.angles.back(), axis.angles.size(), axis.angles};
}

std::vector<Axis> axes_of(const Photometry& p)
{
    using Type = Photometry::Type;
    if (p.type == Type::B)
        return {closed_axis(p.horizontal_deg, -90, 90), closed_axis(p.vertical_deg, -180, 180)};
    if (p.type == Type::A)
        return {closed_axis(p.horizontal_deg, -180, 180), closed_axis(p.vertical_deg, -90, 90)};
    if (p.horizontal_deg.size() == 1)
        return {closed_axis(p.vertical_deg, 0, 180)};
    return {closed_axis(p.horizontal_deg, 0, 360), closed_axis(p.vertical_deg, 0, 180)};
}

/// Intensities in W/sr: grey light of 179 lm/W.
DataTable table_of(const Photometry& photometry)
{
    const std::vector<Axis> axes = axes_of(photometry);
    const std::size_t columns = photometry.vertical_deg.size();
    std::vector<double> values;
    const auto add_row = [&](std::size_t row, bool dark) {
        const Axis& axis = axes.back();
        const std::size_t first = axis.dark_before ? 2 : 0;
        for (std::size_t i = 0; i < axis.angles.size(); ++i)
            values.push_back(dark || i < first || i >= first + columns
                                 ? 0
                                 : photometry.candela[row * columns + i - first] / lumens_per_watt);
    };
    std::vector<DataTable::Dimension> dimensions;
    for (const Axis& axis : axes)
        dimensions.push_back(dimension_of(axis));
    if (axes.size() == 1) {
        add_row(0, false);
    } else {
        const std::size_t rows = photometry.horizontal_deg.size(), first = axes[0].dark_before ? 2 : 0;
        for (std::size_t i = 0; i < axes[0].angles.size(); ++i) {
            const bool dark = i < first || i >= first + rows;
            add_row(dark ? 0 : i - first, dark);
        }
    }
    return {std::move(dimensions), std::move(values)};
}

/// The table as a data file.
std::string text_of(const Photometry& photometry)
{
    const std::vector<Axis> axes = axes_of(photometry);
    const DataTable table = table_of(photometry);
    std::string text = std::to_string(axes.size()) + '\n';
    for (const Axis& axis : axes) {
        text += "0 0 " + std::to_string(axis.angles.size());
        for (const double angle : axis.angles)
            text += ' ' + shortest(angle);
        text += '\n';
    }
    const std::size_t columns = axes.back().angles.size();
    for (std::size_t i = 0; i < table.values().size(); ++i)
        text += shortest(table.values()[i]) + ((i + 1) % columns == 0 ? '\n' : ' ');
    return text;
}

/// Coordinates of the table, where x, y, z of the luminaire are these components of the ray's direction.
std::vector<std::string> coordinates_of(const Photometry& photometry, const std::array<std::string, 3>& d)
{
    using Type = Photometry::Type;
    const auto angle = [](const std::string& of) { return of + "/DEGREE"; };
    if (photometry.type == Type::B)
        return {angle("Asin(" + d[1] + ")"), angle("Atan2(-" + d[0] + "," + d[2] + ")")};
    if (photometry.type == Type::A)
        return {angle("Atan2(" + d[1] + "," + d[2] + ")"), angle("Asin(-" + d[0] + ")")};
    const bool upright = d[2] == "Dz";
    const std::string theta = upright ? "src_theta" : angle("Acos(" + d[2] + ")");
    const std::string phi = upright ? "src_phi" : "mod(" + angle("Atan2(-" + d[1] + ",-" + d[0] + ")") + ",360)";
    return photometry.horizontal_deg.size() == 1 ? std::vector<std::string>{theta}
                                                 : std::vector<std::string>{phi, theta};
}

/// How the pattern's frame lies in the luminaire's: z along the axis of a cylinder.
struct PatternFrame {
    Affine to_luminaire;
    std::array<std::string, 3> components; ///< of the luminaire's x, y, z
};

PatternFrame frame_along(int axis)
{
    if (axis == 0)
        return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {}}, {"Dz", "Dx", "Dy"}};
    if (axis == 1)
        return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {}}, {"Dy", "Dz", "Dx"}};
    return {{}, {"Dx", "Dy", "Dz"}};
}

} // namespace

std::shared_ptr<const PlaceFunction> light_distribution(const Photometry& photometry, const EmittingBody& body,
                                                        double share, const std::string& name)
{
    using Kind = EmittingBody::Kind;
    std::string function = "flatcorr";
    std::vector<double> numbers{share / body.area_m2};
    if (body.kind == Kind::ball) {
        function = "corr";
    } else if (body.kind == Kind::box) {
        function = "boxcorr";
        numbers = {share, body.x_m, body.y_m, body.z_m};
    } else if (body.kind == Kind::cylinder) {
        function = "cylcorr";
        numbers = {share, body.x_m, body.z_m};
    }
    const PatternFrame frame = frame_along(body.kind == Kind::cylinder ? body.axis : 2);
    Definitions definitions = standard_definitions();
    definitions.add(*standard_function_file(function_file), function_file, function_context);
    const auto compile = [&](const std::vector<std::string>& expressions) {
        return Program::compile(definitions, expressions, function_context, numbers, name);
    };
    const std::vector<std::string> coordinates = coordinates_of(photometry, frame.components);
    PatternText text{"brightdata", {function, name + ".dat", function_file}, numbers, {}, text_of(photometry), {}};
    text.words.insert(text.words.end(), coordinates.begin(), coordinates.end());
    text.made.emplace_back(1, text.contents);
    return std::make_shared<const PlaceFunction>(
        PlaceFunction::Table{compile(coordinates),
                             {std::make_shared<const DataTable>(table_of(photometry))},
                             nullptr,
                             compile({function + '(' + channel_word(value_channel) + ')'})},
        frame.to_luminaire, std::move(text));
}

} // namespace lightwell
