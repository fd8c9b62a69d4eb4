#include "plugins/cli/map_files.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/control/work_count.h"
#include "engine/pictures/exr.h"
#include "engine/pictures/false_colour.h"
#include "engine/pictures/png.h"
#include "plugins/cli/host_calls.h"
#include "plugins/cli/options.h"
#include "plugins/cli/provenance.h"
#include "plugins/cli/terminal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <ostream>

namespace lightwell {
namespace {

/// Width of a false-colour map on paper and screen; cells grow to it, so that a small room is not a stamp.
constexpr int map_width_pixels = 720;

std::string csv_of(const SensorGrid& grid, const GridResult& result)
{
    std::string text = "x,y,z,nx,ny,nz,illuminance_lx,error_lx,bias_lx\n";
    for (std::size_t i = 0; i < grid.sensors.size(); ++i) {
        const Sensor& sensor = grid.sensors[i];
        for (const double number :
             {sensor.position.x, sensor.position.y, sensor.position.z, sensor.normal.x, sensor.normal.y,
              sensor.normal.z, result.values[i].value, result.standard_errors[i].value})
            text += shortest(number) + ",";
        text += shortest(result.biases.empty() ? 0 : result.biases[i].value) + "\n";
    }
    return text;
}

/// Values of sensors as a picture, row 0 at the top (high y); NaN where there is no sensor.
std::vector<float> raster(const SensorGrid& grid, const std::vector<Illuminance>& values)
{
    std::vector<float> pixels(grid.cells.size(), std::numeric_limits<float>::quiet_NaN());
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const int sensor = grid.cells[static_cast<std::size_t>(row * grid.columns + column)];
            const auto pixel = static_cast<std::size_t>((grid.rows - 1 - row) * grid.columns + column);
            if (sensor >= 0)
                pixels[pixel] = static_cast<float>(values[static_cast<std::size_t>(sensor)].value);
        }
    return pixels;
}

std::map<std::string, std::string> map_header(const MapJob& job, const GridResult& result)
{
    std::map<std::string, std::string> header = job.provenance;
    header["software"] = program_version();
    header["grid"] = job.grid.name + ", spacing " + shortest(job.grid.spacing_m) + " m, row 0 at high y";
    header["seed"] = std::to_string(job.settings.seed);
    header["samples"] = std::to_string(result.samples);
    header["median_relative_error"] = shortest(result.median_relative_error);
    header["units"] =
        "illuminance.Y: lx on the front of each sensor; error.Y: its standard error, lx; bias.Y: its expected bias, lx";
    return header;
}

std::string caption_of(const MapJob& job, const GridResult& result)
{
    const MapSummary s = summarize(result);
    char text[240];
    std::snprintf(text, sizeof text,
                  "mean %.0f lx, minimum %.0f lx, maximum %.0f lx, uniformity %.2f (minimum/mean), "
                  "standard error of a point %.2g %%, %zu points",
                  s.mean, s.minimum, s.maximum, s.uniformity, result.median_relative_error * 100,
                  job.grid.sensors.size());
    return text;
}

void write_false_colour(const MapJob& job, const GridResult& result, const std::filesystem::path& file)
{
    FalseColour options;
    options.title = "Illuminance, " + job.grid.name;
    options.caption = caption_of(job, result);
    const int cell_pixels = std::max(1, map_width_pixels / std::max(1, job.grid.columns));
    write_png(false_colour(raster(job.grid, result.values), job.grid.columns, job.grid.rows, options, cell_pixels),
              file);
}

void write_map_picture(const MapJob& job, const GridResult& result, const std::filesystem::path& file)
{
    Picture picture{job.grid.columns, job.grid.rows, {}, map_header(job, result)};
    picture.channels["illuminance.Y"] = raster(job.grid, result.values);
    picture.channels["error.Y"] = raster(job.grid, result.standard_errors);
    if (!result.biases.empty())
        picture.channels["bias.Y"] = raster(job.grid, result.biases);
    write_exr(picture, file);
}

void write_files(const MapJob& job, const GridResult& result, double cpu_seconds)
{
    for (const std::filesystem::path& file : job.files) {
        const std::string extension = lowercase_ascii(file.extension().string());
        if (extension == ".csv")
            write_text_atomically(file, csv_of(job.grid, result));
        else if (extension == ".exr")
            write_map_picture(job, result, file);
        else
            write_false_colour(job, result, file);
    }
    RunRecord record = record_of(job, result, cpu_seconds);
    record.more = map_header(job, result);
    record.more["mean_error_lx"] = shortest(result.mean_standard_error.value);
    write_run_record(job.files.front(), record);
}

/// "bias +0.1 +- 0.2 %, ": apart from the statistical interval; nothing where there is none or it was not looked for.
std::string bias_text(const BiasEstimate& bias)
{
    char text[60] = "";
    if (bias.points > 0)
        std::snprintf(text, sizeof text, "bias %+.2g +- %.2g %%, ", bias.mean * 100, bias.standard_error * 100);
    return text;
}

void choose_work(const Simulation& simulation, MapJob& job, const Progress& progress)
{
    const WorkCount work =
        work_within(job.time_s * processors(job.settings.threads), simulation, job.grid, job.settings, progress);
    job.settings.accuracy = work.accuracy;
    job.settings.samples = work.samples;
    job.predicted = work.prediction;
}

} // namespace

MapSummary summarize(const GridResult& result)
{
    MapSummary s;
    double sum = 0;
    s.minimum = infinity;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const double value = result.values[i].value;
        sum += value;
        s.minimum = std::fmin(s.minimum, value);
        s.maximum = std::fmax(s.maximum, value);
    }
    const auto count = static_cast<double>(result.values.size());
    s.mean = sum / count;
    s.mean_error = result.mean_standard_error.value;
    s.uniformity = s.mean > 0 ? s.minimum / s.mean : 0;
    return s;
}

void check_map_files(const MapJob& job)
{
    for (const std::filesystem::path& file : job.files) {
        const std::string extension = lowercase_ascii(file.extension().string());
        const bool picture = extension == ".exr" || extension == ".png";
        if (!picture && extension != ".csv")
            throw InputError(file.string(), "the ending says no format", "expected .csv, .exr or .png");
        if (picture && job.grid.rows == 0)
            throw InputError(file.string(), "the grid is a list of points, which has no picture", "write a .csv");
    }
}

GridResult measure_map(const Simulation& simulation, MapJob& job, const Progress& progress)
{
    const double start = process_cpu_seconds();
    if (job.time_s > 0)
        choose_work(simulation, job, progress);
    GridResult result = simulation.illuminance(job.grid, job.settings, progress);
    write_files(job, result, process_cpu_seconds() - start);
    return result;
}

Status make_map(const Simulation& simulation, const MapJob& asked, std::ostream& out, std::ostream& err)
{
    check_map_files(asked);
    MapJob job = asked;
    try {
        ProgressLine line(job.files.front().filename().string());
        const GridResult result = measure_map(simulation, job, line.progress());
        err << result.report;
        std::string names;
        for (const std::filesystem::path& file : job.files)
            names += (names.empty() ? "" : ", ") + file.string();
        out << names << ": " << caption_of(job, result) << ", " << bias_text(result.bias)
            << duration_text(result.seconds) << '\n';
    } catch (const Cancelled&) {
        err << "lightwell: interrupted; " << job.files.front().string()
            << " was not written; maps start anew when the command is run again\n";
        return Status::no;
    }
    return Status::done;
}

} // namespace lightwell
