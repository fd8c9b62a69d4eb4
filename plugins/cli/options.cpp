#include "plugins/cli/options.h"

#include "engine/base/text.h"
#include "importers/units.h"
#include "plugins/cli/scene_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace lightwell {

void add_import_words(CLI::App& command, ImportWords& words)
{
    command
        .add_option("--unit", words.unit, "unit of the drawing, when the file is silent or wrong: mm, m, in, ft, ...")
        ->type_name("UNIT");
    command.add_option("--up", words.up, "axis that points up in the file: y or z")->check(CLI::IsMember({"y", "z"}));
    command.add_flag("--keep-triangles", words.keep_triangles, "leave the triangles of a flat face as they are");
    command
        .add_option("--crease-angle", words.crease_angle_deg,
                    "shade meshes without normals as round across edges bent less (degrees)")
        ->check(CLI::Range(0.0, 180.0));
    command
        .add_option("--extrude", words.extrude,
                    "raise the outlines of layers of a plan (DXF) to walls: A-WALL=2.8, *WALL*=2800mm; repeatable")
        ->type_name("LAYER=HEIGHT")
        ->expected(1)
        ->take_all();
}

ImportOptions import_options(const ImportWords& words)
{
    ImportOptions options;
    if (!words.unit.empty())
        options.metres_per_unit = parse_unit(words.unit).value;
    options.up = words.up;
    options.keep_triangles = words.keep_triangles;
    options.crease_angle_deg = words.crease_angle_deg;
    for (const std::string& rule : words.extrude)
        options.raised.push_back(parse_raised_layer(rule, "--extrude"));
    return options;
}

void add_sky_words(CLI::App& command, SkyWords& words)
{
    command
        .add_option(
            "--sky", words.type,
            "adds a CIE sky: clear, clear-no-sun, intermediate, intermediate-no-sun, overcast, uniform, cie-1 to "
            "cie-15")
        ->check(CLI::IsMember(sky_names()))
        ->type_name("TYPE");
    command.add_option("--place", words.place, "latitude,longitude in degrees, north and east positive: 52.5,13.4")
        ->type_name("LAT,LON");
    command.add_option("--time", words.time, "moment with its offset from UTC: 2026-03-21T12:00+01:00")
        ->type_name("ISO");
    command.add_option("--north", words.north_deg, "direction of north, degrees counter-clockwise from +y (default 0)")
        ->type_name("DEG");
    command.add_option("--turbidity", words.turbidity, "of the air (default 2.45)")->check(CLI::Range(1.0, 12.0));
    command.add_option("--ground", words.ground_reflectance, "reflectance of the ground outside (default 0.2)")
        ->check(CLI::Range(0.0, 1.0));
}

void add_scene_words(CLI::App& command, SceneWords& words)
{
    command.add_option("scene", words.file, "scene description (.rad) or CAD file (.dxf, .obj, .gltf, .glb)")
        ->required();
    command.add_option("--map", words.map, "layer map (TOML): which layer is made of what")->type_name("FILE");
    add_import_words(command, words.import);
    add_sky_words(command, words.sky);
}

double parse_accuracy(const std::string& text)
{
    const bool percent = !text.empty() && text.back() == '%';
    const auto number = parse_double(percent ? std::string_view(text).substr(0, text.size() - 1) : text);
    const double accuracy = number ? *number / (percent ? 100 : 1) : -1;
    if (!(accuracy > 0 && accuracy < 1))
        throw CLI::ValidationError("--accuracy", "\"" + text + "\" is no accuracy; expected 5% or 0.05, below 100%");
    return accuracy;
}

namespace {

constexpr long long most_pixels_a_side = 32768; // beyond any screen and plotter; what the simulation takes

} // namespace

RegionWords parse_region(const std::string& text)
{
    std::vector<int> numbers;
    for (const std::string_view word : split(text, ","))
        if (const auto number = parse_integer(word); number && *number >= 0 && *number <= most_pixels_a_side)
            numbers.push_back(static_cast<int>(*number));
    const bool four = numbers.size() == 4 && std::count(text.begin(), text.end(), ',') == 3;
    if (!four || numbers[0] >= numbers[2] || numbers[1] >= numbers[3])
        throw CLI::ValidationError("--region", "\"" + text +
                                                   "\" is no region; expected X0,Y0,X1,Y1 in pixels with X0 < X1 and "
                                                   "Y0 < Y1, row 0 at the top, for example 100,50,200,150");
    return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::pair<int, int> parse_size(const std::string& text)
{
    const auto parts = split(text, "x");
    const auto width = parts.size() == 2 ? parse_integer(parts[0]) : std::nullopt;
    const auto height = parts.size() == 2 ? parse_integer(parts[1]) : std::nullopt;
    if (!width || !height || *width < 1 || *height < 1 || *width > most_pixels_a_side || *height > most_pixels_a_side)
        throw CLI::ValidationError("--size", "\"" + text + "\" is no size; expected WIDTHxHEIGHT, for example 960x540");
    return {static_cast<int>(*width), static_cast<int>(*height)};
}

} // namespace lightwell
