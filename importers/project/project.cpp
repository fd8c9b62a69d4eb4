#include "importers/project/project.h"

#include "engine/base/duration.h"
#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/base/toml.h"
#include "importers/project/date_time.h"
#include "importers/units.h"

#include <cmath>

namespace lightwell {
namespace {

/// A number within [low, high], both ends allowed.
double bounded(const TomlTable& table, const char* word, double value, double low, double high)
{
    if (!(value >= low && value <= high))
        throw InputError{table.place_of(word), std::string(word) + " is " + shortest(value) + ", expected " +
                                                   shortest(low) + " to " + shortest(high)};
    return value;
}

double needed(const TomlTable& table, const char* word, double low, double high)
{
    const auto value = table.number(word);
    if (!value)
        throw InputError{table.place(), std::string("has no ") + word};
    return bounded(table, word, *value, low, high);
}

std::optional<int> whole(const TomlTable& table, const char* word, int low, int high)
{
    const auto value = table.number(word);
    if (!value)
        return std::nullopt;
    bounded(table, word, *value, low, high);
    if (*value != std::floor(*value))
        throw InputError{table.place_of(word),
                         std::string(word) + " is " + shortest(*value) + ", expected a whole number"};
    return static_cast<int>(*value);
}

/// Runs a reader of a text and puts the line of the project in front of its complaint.
template <class Read>
auto at_line(const std::string& place, const Read& read)
{
    try {
        return read();
    } catch (const InputError& error) {
        throw InputError{place, error.what()};
    }
}

std::filesystem::path beside(const std::filesystem::path& project, const std::string& name)
{
    return project.parent_path() / name;
}

ProjectInputs read_inputs(const TomlTable& project, const std::filesystem::path& file)
{
    const TomlTable* table = project.table("inputs");
    if (!table)
        throw InputError{project.place(), "has no [inputs]", "add [inputs] with files = [\"building.dxf\"]"};
    table->expect_words({"files", "map", "unit", "up", "extrude"});
    ProjectInputs inputs;
    for (const std::string& name : table->texts("files"))
        inputs.files.push_back(beside(file, name));
    if (inputs.files.empty())
        throw InputError{table->place(), "has no files", "add files = [\"building.dxf\"]"};
    if (const auto map = table->text("map"))
        inputs.map = beside(file, *map);
    inputs.unit = table->text("unit").value_or("");
    if (!inputs.unit.empty())
        at_line(table->place_of("unit"), [&] { return parse_unit(inputs.unit); });
    inputs.up = table->text("up").value_or("");
    if (!inputs.up.empty() && inputs.up != "y" && inputs.up != "z")
        throw InputError{table->place_of("up"), "up is \"" + inputs.up + "\", expected \"y\" or \"z\""};
    for (const std::string& rule : table->texts("extrude"))
        inputs.raised.push_back(parse_raised_layer(rule, table->place_of("extrude")));
    return inputs;
}

PlaceAndTime read_place(const TomlTable& table)
{
    table.expect_words({"latitude", "longitude", "utc_offset", "north", "time"});
    PlaceAndTime place;
    place.latitude_deg = needed(table, "latitude", -90, 90);
    place.longitude_deg = needed(table, "longitude", -180, 180);
    const std::string text = table.text("time").value_or("");
    const auto time = parse_date_time(text);
    if (!time)
        throw InputError{table.place_of("time"), "time is \"" + text + "\", expected such as \"2026-06-21T12:00\"",
                         "with an offset: \"2026-06-21T12:00+02:00\""};
    place.year = time->year;
    place.month = time->month;
    place.day = time->day;
    place.hour = time->hour;
    const auto offset = table.number("utc_offset");
    if (!offset && !time->utc_offset_h)
        throw InputError{table.place(), "does not say by which clock the time is",
                         "add utc_offset = 1 (hours ahead of UTC), or write it into the time: 12:00+01:00"};
    if (offset)
        bounded(table, "utc_offset", *offset, -14, 14);
    if (offset && time->utc_offset_h && *offset != *time->utc_offset_h)
        throw InputError{table.place_of("utc_offset"),
                         "utc_offset is " + shortest(*offset) + ", but the time says " + shortest(*time->utc_offset_h),
                         "keep one of the two"};
    place.utc_offset_h = offset ? *offset : *time->utc_offset_h;
    return place;
}

std::optional<SkyOptions> read_sky(const TomlTable& table)
{
    table.expect_words({"type", "sun", "turbidity", "ground_reflectance"});
    const std::string type = table.text("type").value_or("clear");
    SkyOptions sky;
    if (type == "none")
        return std::nullopt;
    if (type == "clear")
        sky.kind = CieSky::clear;
    else if (type == "intermediate")
        sky.kind = CieSky::intermediate;
    else if (type == "overcast")
        sky.kind = CieSky::overcast;
    else if (type == "uniform")
        sky.kind = CieSky::uniform;
    else
        throw InputError{table.place_of("type"), "type is \"" + type + '"',
                         "expected clear, intermediate, overcast, uniform or none (electric light only)"};
    const bool can_have_sun = sky.kind == CieSky::clear || sky.kind == CieSky::intermediate;
    sky.with_sun = table.boolean("sun").value_or(can_have_sun);
    if (sky.with_sun && !can_have_sun)
        throw InputError{table.place_of("sun"), "a sky of type \"" + type + "\" hides the sun",
                         "use type = \"intermediate\" or sun = false"};
    sky.turbidity = bounded(table, "turbidity", table.number("turbidity").value_or(sky.turbidity), 1, 20);
    sky.ground_reflectance =
        bounded(table, "ground_reflectance", table.number("ground_reflectance").value_or(sky.ground_reflectance), 0, 1);
    return sky;
}

Vec3 vector_of(const TomlTable& table, const char* word)
{
    const std::vector<double> numbers = table.numbers(word);
    const Vec3 v = numbers.size() == 3 ? Vec3{numbers[0], numbers[1], numbers[2]} : Vec3{infinity, 0, 0};
    if (!is_finite(v))
        throw InputError{table.place_of(word), std::string(word) + " needs three finite numbers [x, y, z]"};
    return v;
}

View::Kind kind_of(const TomlTable& table)
{
    const std::string kind = table.text("kind").value_or("perspective");
    constexpr std::pair<const char*, View::Kind> kinds[] = {
        {"perspective", View::Kind::perspective}, {"parallel", View::Kind::parallel},
        {"cylindrical", View::Kind::cylindrical}, {"hemispherical", View::Kind::hemispherical},
        {"angular", View::Kind::angular},         {"planisphere", View::Kind::planisphere}};
    for (const auto& [name, found] : kinds)
        if (kind == name)
            return found;
    throw InputError{table.place_of("kind"), "kind is \"" + kind + '"',
                     "expected perspective, parallel, cylindrical, hemispherical, angular or planisphere"};
}

View view_by_words(const TomlTable& table)
{
    View view;
    view.kind = kind_of(table);
    view.position = vector_of(table, "position");
    if (table.has("direction") == table.has("target"))
        throw InputError{table.place(), "needs a direction or a target, and only one of them",
                         "direction = [0, 1, 0], or target = [x, y, z] of a point to look at"};
    view.direction =
        table.has("direction") ? vector_of(table, "direction") : vector_of(table, "target") - view.position;
    if (table.has("up"))
        view.up = vector_of(table, "up");
    const bool fisheye = view.kind == View::Kind::hemispherical || view.kind == View::Kind::angular ||
                         view.kind == View::Kind::planisphere;
    view.horizontal = table.number("horizontal").value_or(fisheye ? 180 : view.horizontal);
    view.vertical = table.number("vertical").value_or(fisheye ? 180 : view.vertical);
    view.shift = table.number("shift").value_or(0);
    view.lift = table.number("lift").value_or(0);
    view.fore_m = table.number("fore").value_or(0);
    view.aft_m = table.number("aft").value_or(0);
    view.lens_m = table.number("lens").value_or(0);
    view.focus_m = table.number("focus").value_or(0);
    return view;
}

ProjectView read_view(const TomlTable& table, std::size_t number)
{
    table.expect_words({"name", "text", "position", "direction", "target", "up", "kind", "horizontal", "vertical",
                        "shift", "lift", "fore", "aft", "lens", "focus", "size"});
    ProjectView result;
    if (const auto text = table.text("text")) {
        for (const char* word : {"position", "direction", "target", "up", "kind", "horizontal", "vertical", "shift",
                                 "lift", "fore", "aft", "lens", "focus"})
            if (table.has(word))
                throw InputError{table.place_of(word), std::string(word) + " stands beside text",
                                 "give the view in Radiance's words or in ours, not in both"};
        result.view = parse_view(*text, table.place_of("text"));
    } else {
        result.view = view_by_words(table);
    }
    result.view.name = table.text("name").value_or("view" + std::to_string(number));
    at_line(table.place(), [&] { return Camera{result.view}; });
    const std::vector<double> size = table.numbers("size");
    if (size.empty())
        return result;
    constexpr double largest_side = 32768;
    for (const double side : size)
        if (size.size() != 2 || !(side >= 1 && side <= largest_side) || side != std::floor(side))
            throw InputError{table.place_of("size"), "size needs two whole numbers of pixels from 1 to 32768",
                             "for example size = [960, 540]"};
    result.width = static_cast<int>(size[0]);
    result.height = static_cast<int>(size[1]);
    return result;
}

GridRequest read_grid(const TomlTable& table, std::size_t number, const std::filesystem::path& file)
{
    table.expect_words({"on", "spacing", "name"});
    const std::string on = table.text("on").value_or("");
    GridRequest grid = at_line(table.place_of("on"), [&] { return parse_grid(on); });
    if (grid.kind == GridRequest::Kind::file)
        grid.file = beside(file, grid.file).string();
    if (const auto spacing = table.number("spacing"))
        grid.spacing_m = bounded(table, "spacing", *spacing, 1e-4, 1e6);
    grid.name = table.text("name").value_or("grid" + std::to_string(number));
    return grid;
}

std::optional<double> read_time(const TomlTable& table)
{
    const auto text = table.text("time");
    if (!text)
        return std::nullopt;
    const auto seconds = parse_duration(*text);
    if (!seconds)
        throw InputError{table.place_of("time"), "time is \"" + *text + "\"", "expected \"60s\", \"5min\" or \"2h\""};
    return seconds;
}

std::string read_quality(const TomlTable& table)
{
    const std::string quality = table.text("quality").value_or("");
    if (!quality.empty() && quality != "draft" && quality != "normal" && quality != "fine")
        throw InputError{table.place_of("quality"), "quality is \"" + quality + "\"",
                         "expected \"draft\", \"normal\" or \"fine\""};
    return quality;
}

ProjectWish read_wish(const TomlTable& table)
{
    table.expect_words({"accuracy", "samples", "time", "quality", "seed"});
    ProjectWish wish;
    if (const auto accuracy = table.number("accuracy"))
        wish.accuracy = bounded(table, "accuracy", *accuracy, 1e-5, 1);
    wish.samples = whole(table, "samples", 1, 1 << 24);
    wish.time_s = read_time(table);
    wish.quality = read_quality(table);
    const char* first = nullptr;
    for (const char* word : {"accuracy", "samples", "time", "quality"}) {
        if (!table.has(word))
            continue;
        if (first != nullptr)
            throw InputError{table.place_of(word), std::string(first) + " and " + word + " contradict each other",
                             "keep one: each says how much work is wanted"};
        first = word;
    }
    wish.seed = whole(table, "seed", 0, 2147483647);
    return wish;
}

ProjectOutput read_output(const TomlTable& table)
{
    table.expect_words({"folder", "png", "hdr"});
    ProjectOutput output;
    output.folder = table.text("folder").value_or(output.folder.string());
    output.png = table.boolean("png").value_or(output.png);
    output.hdr = table.boolean("hdr").value_or(output.hdr);
    return output;
}

} // namespace

Project read_project(const std::filesystem::path& file)
{
    const TomlTable table = read_toml(file);
    table.expect_words({"inputs", "place", "sky", "view", "grid", "wish", "output"});
    Project project;
    project.file = file;
    project.inputs = read_inputs(table, file);
    if (const TomlTable* place = table.table("place")) {
        project.place = read_place(*place);
        project.north_deg = bounded(*place, "north", place->number("north").value_or(0), -360, 360);
        project.sky = SkyOptions{};
    }
    if (const TomlTable* sky = table.table("sky")) {
        project.sky = read_sky(*sky);
        if (project.sky && !project.place)
            throw InputError{sky->place(), "a sky needs a [place] with latitude, longitude and time",
                             "or type = \"none\" for electric light only"};
    }
    for (const TomlTable* view : table.tables("view"))
        project.views.push_back(read_view(*view, project.views.size() + 1));
    for (const TomlTable* grid : table.tables("grid"))
        project.grids.push_back(read_grid(*grid, project.grids.size() + 1, file));
    if (const TomlTable* wish = table.table("wish"))
        project.wish = read_wish(*wish);
    if (const TomlTable* output = table.table("output"))
        project.output = read_output(*output);
    project.output.folder = beside(file, project.output.folder.string());
    return project;
}

} // namespace lightwell
