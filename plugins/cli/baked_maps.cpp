#include "plugins/cli/baked_maps.h"

#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/pictures/exr.h"
#include "plugins/cli/provenance.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace lightwell {
namespace {

constexpr const char* units =
    "front.Y, back.Y: illuminance on the front and the back of the surface, lx; error: one standard error, lx; NaN "
    "where the surface does not cover the texel";

/// Results of one side of one chart.
struct Side {
    const char* name;
    std::size_t first; ///< index of the chart's first sensor in the result
};

std::vector<Side> sides_of(const BakeJob& job, std::size_t first, std::size_t all)
{
    if (job.sides == BakeSides::front)
        return {{"front", first}};
    if (job.sides == BakeSides::back)
        return {{"back", first}};
    return {{"front", first}, {"back", all + first}};
}

std::size_t sensors_a_side(const BakeJob& job)
{
    std::size_t count = 0;
    for (const SurfaceChart& chart : job.charts)
        count += chart.sensors.size();
    return count;
}

/// Illuminance by area.
struct Mean {
    double area_m2 = 0, flux_lm = 0, minimum_lx = infinity, maximum_lx = 0;

    void add(double area, double lx)
    {
        area_m2 += area;
        flux_lm += area * lx;
        minimum_lx = std::fmin(minimum_lx, lx);
        maximum_lx = std::fmax(maximum_lx, lx);
    }
    double mean_lx() const { return area_m2 > 0 ? flux_lm / area_m2 : 0; }
    nlohmann::ordered_json json() const
    {
        return {{"mean_lx", mean_lx()}, {"minimum_lx", minimum_lx}, {"maximum_lx", maximum_lx}};
    }
};

void add_side(Mean& mean, const SurfaceChart& chart, const GridResult& result, std::size_t first)
{
    for (std::size_t i = 0; i < chart.sensors.size(); ++i)
        mean.add(chart.areas_m2[i], result.values[first + i].value);
}

/// Texels as a picture, row 0 at the top.
std::vector<float> raster(const SurfaceChart& chart, const std::vector<Illuminance>& values, std::size_t first)
{
    std::vector<float> pixels(chart.cells.size(), std::numeric_limits<float>::quiet_NaN());
    const auto columns = static_cast<std::size_t>(chart.columns), rows = static_cast<std::size_t>(chart.rows);
    for (std::size_t texel = 0; texel < chart.cells.size(); ++texel)
        if (chart.cells[texel] >= 0)
            pixels[(rows - 1 - texel / columns) * columns + texel % columns] =
                static_cast<float>(values[first + static_cast<std::size_t>(chart.cells[texel])].value);
    return pixels;
}

void write_picture(const BakeJob& job, const SurfaceChart& chart, const std::vector<Side>& sides,
                   const GridResult& result, const std::string& name)
{
    Picture picture{chart.columns, chart.rows, {}, job.provenance};
    picture.header["software"] = program_version();
    picture.header["surface"] = to_utf8(chart.id);
    picture.header["layer"] = to_utf8(chart.layer);
    picture.header["units"] = units;
    picture.header["spacing_m"] = shortest(job.spacing_m);
    picture.header["seed"] = std::to_string(job.settings.seed);
    picture.header["samples"] = std::to_string(result.samples);
    picture.header["median_relative_error"] = shortest(result.median_relative_error);
    for (const Side& side : sides) {
        picture.channels[std::string(side.name) + ".Y"] = raster(chart, result.values, side.first);
        picture.channels[std::string("error.") + side.name + ".Y"] = raster(chart, result.standard_errors, side.first);
    }
    write_exr(picture, job.folder / name);
}

/// "00012_A-FLOR_2F3.exr": unique by its number, readable by the rest.
std::string file_name(std::size_t number, const std::string& id)
{
    constexpr std::size_t longest = 60; // of the readable part: folders hold names of 255 bytes
    char digits[16];
    std::snprintf(digits, sizeof digits, "%05zu_", number);
    std::string name = digits;
    for (const char c : id.substr(0, longest)) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                           c == '_' || c == '.';
        name += plain ? c : '_';
    }
    return name + ".exr";
}

nlohmann::ordered_json json_of(const Vec3& v)
{
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

nlohmann::ordered_json json_of(const SurfaceChart& chart)
{
    static constexpr const char* kinds[] = {"plane", "round", "triangles"};
    nlohmann::ordered_json json = {{"surface", to_utf8(chart.id)},
                                   {"layer", to_utf8(chart.layer)},
                                   {"kind", kinds[static_cast<std::size_t>(chart.kind)]},
                                   {"columns", chart.columns},
                                   {"rows", chart.rows}};
    if (chart.kind != SurfaceChart::Kind::plane)
        return json;
    json["corner"] = json_of(chart.corner);
    json["across"] = json_of(chart.across);
    json["up"] = json_of(chart.up);
    json["texel_m"] = {length(chart.across) / chart.columns, length(chart.up) / chart.rows};
    return json;
}

/// Means by layer, in the order of the layers' names.
std::map<std::string, std::map<std::string, Mean>> means_by_layer(const BakeJob& job, const GridResult& result)
{
    std::map<std::string, std::map<std::string, Mean>> layers;
    const std::size_t all = sensors_a_side(job);
    std::size_t first = 0;
    for (const SurfaceChart& chart : job.charts) {
        for (const Side& side : sides_of(job, first, all))
            add_side(layers[chart.layer][side.name], chart, result, side.first);
        first += chart.sensors.size();
    }
    return layers;
}

} // namespace

SensorGrid sensors_of(const BakeJob& job)
{
    SensorGrid grid;
    grid.name = "surfaces";
    grid.spacing_m = job.spacing_m;
    for (const bool back : {false, true}) {
        if (job.sides == (back ? BakeSides::front : BakeSides::back))
            continue;
        for (const SurfaceChart& chart : job.charts)
            for (const Sensor& sensor : chart.sensors)
                grid.sensors.push_back({sensor.position, back ? -sensor.normal : sensor.normal});
    }
    return grid;
}

void write_baked_maps(const BakeJob& job, const GridResult& result)
{
    nlohmann::ordered_json json = {{"program", program_version()},
                                   {"units", units},
                                   {"rows", "the first row of a picture is the highest: v from 1 to 0"},
                                   {"spacing_m", job.spacing_m},
                                   {"samples", result.samples},
                                   {"median_relative_error", result.median_relative_error}};
    for (const auto& [name, value] : job.provenance)
        json["provenance"][name] = to_utf8(value);
    json["surfaces"] = nlohmann::ordered_json::array();
    const std::size_t all = sensors_a_side(job);
    std::size_t first = 0;
    for (const SurfaceChart& chart : job.charts) {
        const std::vector<Side> sides = sides_of(job, first, all);
        const std::string name = file_name(json["surfaces"].size(), chart.id);
        write_picture(job, chart, sides, result, name);
        nlohmann::ordered_json entry = json_of(chart);
        entry["file"] = name;
        for (const Side& side : sides) {
            Mean mean;
            add_side(mean, chart, result, side.first);
            entry["area_m2"] = mean.area_m2;
            entry[side.name] = mean.json();
        }
        json["surfaces"].push_back(std::move(entry));
        first += chart.sensors.size();
    }
    for (const auto& [layer, sides] : means_by_layer(job, result))
        for (const auto& [side, mean] : sides) {
            json["layers"][to_utf8(layer)]["area_m2"] = mean.area_m2;
            json["layers"][to_utf8(layer)][side] = mean.json();
        }
    write_text_atomically(job.folder / "maps.json", json.dump(2) + "\n");
}

std::string layer_table(const BakeJob& job, const GridResult& result)
{
    std::string table = "layer\tarea_m2";
    for (const Side& side : sides_of(job, 0, 0))
        table += "\t" + std::string(side.name) + "_lx";
    for (const auto& [layer, sides] : means_by_layer(job, result)) {
        char text[64];
        std::snprintf(text, sizeof text, "\t%.4g", sides.begin()->second.area_m2);
        table += "\n" + to_utf8(layer) + text;
        for (const Side& side : sides_of(job, 0, 0)) {
            std::snprintf(text, sizeof text, "\t%.4g", sides.at(side.name).mean_lx());
            table += text;
        }
    }
    return table + "\n";
}

} // namespace lightwell
