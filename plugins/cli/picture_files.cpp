#include "plugins/cli/picture_files.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/control/work_count.h"
#include "engine/pictures/exr.h"
#include "engine/pictures/png.h"
#include "engine/pictures/rgbe.h"
#include "engine/scene/scene_hash.h"
#include "engine/simulate/technique_names.h"
#include "plugins/cli/host_calls.h"
#include "plugins/cli/options.h"
#include "plugins/cli/provenance.h"
#include "plugins/cli/terminal.h"

#include <cmath>
#include <cstdio>
#include <ostream>

namespace lightwell {
namespace {

constexpr const char* channel_units =
    "R, G, B: W/(m^2 sr), 179 lm/W; illuminance.Y: lx on the first surface, viewer's side; Z: m along the ray; "
    "N: unit normal, world; error: one standard error, R, G, B in W/(m^2 sr), Y in cd/m^2, illuminance.Y in lx";

std::string hexadecimal(std::uint64_t bits)
{
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
    return text;
}

std::string region_text(const Tile& region)
{
    if (region.width == 0)
        return "";
    return ", region " + std::to_string(region.x) + "," + std::to_string(region.y) + "," +
           std::to_string(region.x + region.width) + "," + std::to_string(region.y + region.height);
}

std::string effort_text(const PictureSettings& s)
{
    return (s.samples > 0 ? ", samples " + std::to_string(s.samples) : "") + ", accuracy " + shortest(s.accuracy);
}

/// Everything that determines the pixels: a partial file goes on only when all of it agrees.
std::string settings_text(const Simulation& simulation, const PictureJob& job)
{
    const PictureSettings& s = job.settings;
    const std::string off = switched_off(s.techniques, simulation.preparation());
    const SecondarySettings& secondary = simulation.preparation().secondary;
    const std::string ways = std::string(s.unbiased ? ", unbiased" : "") + (off.empty() ? "" : ", without " + off) +
                             (secondary.none() ? "" : ", secondary " + to_text(secondary)) +
                             (s.ambient_file.file.empty() ? "" : ", kept ambient light");
    return "size " + std::to_string(s.width) + "x" + std::to_string(s.height) + region_text(s.region) + effort_text(s) +
           ", seed " + std::to_string(s.seed) + ", scene " + hexadecimal(scene_hash(simulation.scene())) + ", view " +
           to_text(job.view) + ways + ", " + program_version();
}

/// The number behind a word of a settings text.
std::optional<double> number_after(const std::string& text, const std::string& word)
{
    const std::size_t at = text.find(", " + word + " ");
    if (at == std::string::npos)
        return std::nullopt;
    const std::size_t begin = at + word.size() + 3;
    return parse_double(std::string_view(text).substr(begin, text.find(',', begin) - begin));
}

/// Work for the time that is wanted: what an interrupted run of the same picture chose, so that its tiles serve, or
/// what pilot runs say.
PictureJob with_work(const Simulation& simulation, const PictureJob& asked, const Progress& progress)
{
    PictureJob job = asked;
    const std::string earlier = interrupted_settings(job.file);
    const auto samples = number_after(earlier, "samples"), accuracy = number_after(earlier, "accuracy");
    if (samples && accuracy) {
        job.settings.samples = static_cast<int>(*samples);
        job.settings.accuracy = *accuracy;
        if (settings_text(simulation, job) == earlier)
            return job;
    }
    job.settings.samples = 0;
    const WorkCount work =
        work_within(job.time_s * processors(job.settings.threads), simulation, job.view, job.settings, progress);
    job.settings.accuracy = work.accuracy;
    job.settings.samples = work.samples;
    job.predicted = work.prediction;
    return job;
}

PictureResult render_tiles(const Simulation& simulation, const PictureJob& job, GrowingPicture& growing,
                           ProgressLine& line)
{
    const TileStore store{
        [&](const Tile& tile) { return growing.stored(tile.x, tile.y); },
        [&](const Tile& tile, const Picture& pixels) { growing.put(tile.x, tile.y, pixels); },
    };
    return simulation.render(job.view, job.settings, line.progress(), store);
}

/// A Radiance picture knows no whole that it is a part of: the part becomes a view of its own.
Picture for_itself(Picture picture, const View& view)
{
    const Picture::Place& whole = picture.place;
    if (whole.width == 0)
        return picture;
    const double width = whole.width, height = whole.height;
    picture.header["VIEW"] = to_text(cropped(view, whole.x / width, 1 - (whole.y + picture.height) / height,
                                             (whole.x + picture.width) / width, 1 - whole.y / height));
    return picture;
}

void write_companions(const PictureResult& result, const PictureJob& job, double cpu_seconds)
{
    if (job.png)
        write_png(tone_mapped(result.picture), std::filesystem::path(job.file).replace_extension(".png"));
    if (job.hdr)
        write_rgbe(for_itself(result.picture, job.view), std::filesystem::path(job.file).replace_extension(".hdr"));
    RunRecord record = record_of(job, result, cpu_seconds);
    record.more = result.picture.header;
    write_run_record(job.file, record);
}

std::string picture_line(const PictureResult& result, const PictureJob& job)
{
    char text[200], bias[60] = "";
    if (!job.settings.unbiased)
        std::snprintf(bias, sizeof bias, "bias %+.2g +- %.2g %%, ", result.bias.mean * 100,
                      result.bias.standard_error * 100);
    std::snprintf(text, sizeof text, ": %d x %d, %d samples per pixel, median standard error %.2g %%, %s",
                  result.picture.width, result.picture.height, result.samples, result.median_relative_error * 100,
                  bias);
    return job.file.string() + text + duration_text(result.seconds);
}

Status explain_interruption(const PictureJob& job, double fraction, std::ostream& err)
{
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.0f %%", fraction * 100);
    err << "lightwell: interrupted at " << percent << "; finished tiles are in "
        << std::filesystem::path(job.file).replace_extension(".partial.exr").string()
        << "; run the same command again to go on\n";
    return Status::no;
}

} // namespace

void fit_to_view(const View& view, PictureSettings& settings)
{
    const double aspect = Camera(view).aspect();
    const double width = std::fmin(settings.width, std::round(settings.height * aspect));
    const double height = std::fmin(settings.height, std::round(settings.width / aspect));
    settings.width = static_cast<int>(std::fmax(1, width));
    settings.height = static_cast<int>(std::fmax(1, height));
}

std::map<std::string, std::string> picture_header(const Simulation& simulation, const PictureJob& job)
{
    std::map<std::string, std::string> header = job.provenance;
    header["VIEW"] = to_text(job.view);
    header["software"] = program_version();
    header["settings"] = settings_text(simulation, job);
    header["seed"] = std::to_string(job.settings.seed);
    header["units"] = channel_units;
    return header;
}

Status make_picture(const Simulation& simulation, const PictureJob& asked, std::ostream& out, std::ostream& err)
{
    ProgressLine line(asked.file.filename().string());
    const double start = process_cpu_seconds();
    const PictureJob job = asked.time_s > 0 ? with_work(simulation, asked, line.progress()) : asked;
    const Tile wanted = wanted_pixels(job.settings);
    Picture layout{wanted.width, wanted.height, {}, picture_header(simulation, job)};
    if (job.settings.region.width > 0)
        layout.place = {wanted.x, wanted.y, job.settings.width, job.settings.height};
    for (const std::string& name : tile_channels())
        layout.channels[name];
    GrowingPicture growing(job.file, layout, tile_size);
    if (growing.resumed_tiles() > 0)
        err << job.file.string() << ": going on after " << growing.resumed_tiles() << " finished tiles\n";
    try {
        PictureResult result = render_tiles(simulation, job, growing, line);
        result.picture.header.insert(layout.header.begin(), layout.header.end());
        result.picture.header["samples"] = std::to_string(result.samples);
        if (!job.settings.unbiased) {
            result.picture.header["bias"] = shortest(result.bias.mean);
            result.picture.header["bias_standard_error"] = shortest(result.bias.standard_error);
        }
        result.picture.header["median_relative_error"] = shortest(result.median_relative_error);
        growing.finish(result.picture);
        err << result.report;
        write_companions(result, job, process_cpu_seconds() - start);
        out << picture_line(result, job) << '\n';
    } catch (const Cancelled&) {
        return explain_interruption(job, line.fraction(), err);
    }
    return Status::done;
}

} // namespace lightwell
