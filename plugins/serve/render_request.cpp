#include "engine/base/text.h"
#include "engine/control/work_count.h"
#include "engine/pictures/exr.h"
#include "plugins/cli/options.h"
#include "plugins/serve/host_picture.h"
#include "plugins/serve/scene_summary.h"
#include "plugins/serve/session.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace lightwell::serve {
namespace {

using Clock = std::chrono::steady_clock;

/// The first picture has the fewest paths that give an error; each further one has twice as many and ambient light
/// that is half as coarse.
constexpr int first_samples = 8;
constexpr double coarsest_accuracy = 0.4;
/// What the next pass takes, in times of the last one.
constexpr double next_pass = 2.5;
constexpr int most_samples = 1 << 16;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The passes of a picture that gets better while one looks.
struct Pass {
    int samples;
    double accuracy;
    bool last;
};
std::vector<Pass> passes_of(const PictureSettings& wanted, double seconds)
{
    std::vector<Pass> passes;
    const bool by_time = seconds > 0, by_samples = wanted.samples > 0;
    const double finest = by_time ? 0.005 : wanted.accuracy;
    double accuracy = std::max(coarsest_accuracy, finest);
    for (int samples = first_samples;; samples *= 2, accuracy = std::max(accuracy / 2, finest)) {
        const bool enough = by_samples ? samples >= wanted.samples
                            : by_time  ? samples >= most_samples
                                       : accuracy <= finest;
        if (enough)
            break;
        passes.push_back({samples, accuracy, false});
    }
    passes.push_back({by_time ? most_samples : wanted.samples, finest, true});
    return passes;
}

/// Before all others comes a picture with so many times fewer pixels a side, as long as enough of them are left.
constexpr int coarser = 4, fewest_pixels = 16;

bool begins_coarse(const PictureSettings& wanted)
{
    return wanted.region.width == 0 && std::min(wanted.width, wanted.height) >= coarser * fewest_pixels;
}

/// Each pixel of the small picture as a block of the large one.
Picture enlarged(const Picture& small, int width, int height)
{
    Picture large{width, height, {}, small.header};
    for (const auto& [name, values] : small.channels) {
        std::vector<float>& to = large.add_channel(name);
        for (int y = 0, i = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i)
                to[static_cast<std::size_t>(i)] = small.at(name, x * small.width / width, y * small.height / height);
    }
    return large;
}

std::string members_of(const PictureJob& job, const PictureResult& result, const std::vector<std::string>& layers)
{
    nlohmann::ordered_json json = {{"width", result.picture.width}, {"height", result.picture.height},
                                   {"samples", result.samples},     {"error", result.median_relative_error},
                                   {"bias", result.bias.mean},      {"seconds", result.seconds}};
    std::string members = json.dump();
    members = "\"file\":" + quoted(job.file.string()) + "," + members.substr(1, members.size() - 2) + ",\"layers\":[";
    for (std::size_t i = 0; i < layers.size(); ++i)
        members += (i == 0 ? "" : ",") + quoted(layers[i]);
    return members + "]," + notes_member(result.report);
}

} // namespace

std::vector<float> Session::layer_indices_of(const PictureJob& job, Told& told)
{
    const Scene& scene = loaded_->simulation->scene();
    if (!loaded_->rays)
        loaded_->rays.emplace(scene);
    return layer_indices(scene, *loaded_->rays, job.view, job.settings, loaded_->layers, [&told] { told.check(); });
}

void Session::write_picture(const PictureJob& job, const std::optional<HostLayer>& layer, PictureResult& result) const
{
    Picture& picture = result.picture;
    picture.header = picture_header(*loaded_->simulation, job);
    picture.header["samples"] = std::to_string(result.samples);
    picture.header["median_relative_error"] = shortest(result.median_relative_error);
    if (layer)
        write_exr(host_picture(picture, layer->name, layer->indices), job.file, ExrUse::hand_over);
    else
        write_exr(picture, job.file);
}

PictureResult Session::render_progressively(PictureJob& job, const std::optional<HostLayer>& layer, Told& told) const
{
    const Clock::time_point start = Clock::now();
    const PictureSettings wanted = job.settings;
    const std::vector<Pass> passes = passes_of(wanted, job.time_s);
    PictureResult result;
    double last_pass_s = 0, done = 0;
    if (begins_coarse(wanted)) {
        PictureSettings small = wanted;
        small.width /= coarser;
        small.height /= coarser;
        small.samples = passes.front().samples;
        small.accuracy = passes.front().accuracy;
        result = loaded_->simulation->render(job.view, small, told.part(0, 0));
        result.picture = enlarged(result.picture, wanted.width, wanted.height);
        write_picture(job, layer, result);
        told.events().partial(told.id(), job.file.string(), result.samples, result.median_relative_error);
    }
    for (const Pass& pass : passes) {
        const double left_s = job.time_s - seconds_since(start);
        if (job.time_s > 0 && last_pass_s > 0 && next_pass * last_pass_s > left_s)
            break;
        const Clock::time_point pass_start = Clock::now();
        job.settings.samples = pass.samples;
        job.settings.accuracy = pass.accuracy;
        const double share = pass.last ? 1 - done : (1 - done) / 4;
        result = loaded_->simulation->render(job.view, job.settings, told.part(done, done + share));
        done += share;
        write_picture(job, layer, result);
        last_pass_s = seconds_since(pass_start);
        told.events().partial(told.id(), job.file.string(), result.samples, result.median_relative_error);
    }
    result.seconds = seconds_since(start);
    return result;
}

void Session::render(const Request& request, Told& told)
{
    const Simulation& ready = lit_simulation();
    PictureJob job = picture_job(request);
    std::optional<HostLayer> layer;
    if (request.layer)
        layer = {*request.layer, layer_indices_of(job, told)};
    PictureResult result;
    if (request.progressive) {
        result = render_progressively(job, layer, told);
    } else {
        if (job.time_s > 0) {
            const WorkCount work =
                work_within(job.time_s * processors(request.threads), ready, job.view, job.settings, told.part(0, 0.1));
            job.settings.accuracy = work.accuracy;
            job.settings.samples = work.samples;
        }
        result = ready.render(job.view, job.settings, told.part(job.time_s > 0 ? 0.1 : 0, 1));
        write_picture(job, layer, result);
    }
    told.events().result(told.id(), "picture", members_of(job, result, loaded_->layers));
}

} // namespace lightwell::serve
