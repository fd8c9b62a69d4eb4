#include "plugins/insight/tradeoff.h"

#include "engine/base/errors.h"
#include "engine/control/predict.h"
#include "engine/simulate/technique_names.h"
#include "plugins/insight/peers.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <functional>
#include <stdexcept>

namespace lightwell {
namespace {

constexpr double dark_share = 1e-3; ///< of the mean: darker items are held against this share

/// What one run found.
struct Found {
    std::vector<double> values, errors;
};

/// A grid or a view, and how to run it.
struct Subject {
    std::string name, unit;
    std::size_t count = 0; ///< of values
    /// @param samples  0: chosen from the accuracy
    std::function<Found(const Simulation&, double accuracy, int samples, bool unbiased, const Techniques&)> run;
    std::function<PeerRun(const RadiancePeers&, int quality)> peer;
};

double mean_of(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values)
        sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// What each error is divided by.
std::vector<double> yardsticks(const std::vector<double>& reference)
{
    const double least = dark_share * mean_of(reference);
    std::vector<double> found;
    for (const double value : reference)
        found.push_back(std::max(value, least));
    return found;
}

/// The clocks of a run.
class Clocks {
public:
    void stop(TradePoint& point) const
    {
        point.cpu_s = process_cpu_seconds() - cpu_;
        point.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    }
    double cpu_s() const { return process_cpu_seconds() - cpu_; }

private:
    double cpu_ = process_cpu_seconds();
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Unbiased paths, as many as fill the time; a short run tells how many that is.
TradeReference find_reference(const Scene& scene, const Subject& subject, const TradeSettings& settings)
{
    constexpr int pilot = 64, most = 1 << 22;
    const Simulation simulation{Scene(scene), settings.preparation};
    TradeReference reference;
    const Clocks pilot_clock;
    subject.run(simulation, 0.05, pilot, true, {});
    const double each = std::max(1e-9, pilot_clock.cpu_s() / pilot);
    reference.samples = static_cast<int>(
        std::clamp(settings.reference_cpu_s / each, static_cast<double>(pilot), static_cast<double>(most)));
    reference.samples -= reference.samples % 8;
    const Clocks clock;
    const Found found = subject.run(simulation, 0.05, reference.samples, true, {});
    reference.cpu_s = clock.cpu_s();
    reference.values = found.values;
    const std::vector<double> by = yardsticks(found.values);
    double squares = 0;
    for (std::size_t i = 0; i < by.size(); ++i)
        squares += by[i] > 0 ? std::pow(found.errors[i] / by[i], 2) : 0;
    reference.residual = by.empty() ? 0 : std::sqrt(squares / static_cast<double>(by.size()));
    if (!(mean_of(found.values) > 0))
        throw InputError{subject.name, "is dark: no light reaches it",
                         "look for lamps or a sky that are on, and for openings"};
    return reference;
}

TradePoint run_own(const Scene& scene, const Subject& subject, const TradeSettings& settings,
                   const TradeReference& reference, double accuracy, const std::string& without)
{
    TradePoint point;
    point.setting = fmt::format("{:g} %", 100 * accuracy);
    point.without = without;
    Techniques techniques;
    Preparation preparation = settings.preparation;
    if (!without.empty())
        switch_off(without, techniques, preparation);
    Scene copy = scene;
    const Clocks clock;
    const Simulation simulation(std::move(copy), preparation);
    const Found found = subject.run(simulation, accuracy, 0, false, techniques);
    clock.stop(point);
    point.error = error_figures(found.values, reference.values);
    return point;
}

TradePoint point_of(const PeerRun& run, const TradeReference& reference)
{
    TradePoint point;
    point.program = run.program;
    point.setting = run.setting;
    point.cpu_s = run.cpu_s;
    point.wall_s = run.wall_s;
    point.failure = run.failure;
    if (run.failure.empty())
        point.error = error_figures(run.values, reference.values);
    return point;
}

void add_peers(const Scene& scene, const Subject& subject, const TradeSettings& settings, Tradeoff& tradeoff,
               const Progress& progress)
{
    const RadiancePeers peers(scene, settings.peer_cpu_s);
    if (!peers.absent().empty()) {
        TradePoint point;
        point.program = "Radiance";
        point.failure = peers.absent();
        tradeoff.points.push_back(point);
        return;
    }
    for (int quality = 0; quality < RadiancePeers::qualities; ++quality) {
        if (progress.stop())
            throw Cancelled{};
        progress.tell("other programs", static_cast<double>(quality) / RadiancePeers::qualities);
        tradeoff.points.push_back(point_of(subject.peer(peers, quality), tradeoff.reference));
    }
}

Tradeoff measure(const Scene& scene, const Subject& subject, const TradeSettings& settings, const Progress& progress)
{
    Tradeoff tradeoff{subject.name, subject.unit, {}, {}};
    std::vector<PeerRun> elsewhere; // read before an hour is spent
    if (!settings.peer_file.empty())
        elsewhere = read_peer_runs(settings.peer_file, subject.count);
    progress.tell("reference", 0);
    tradeoff.reference = find_reference(scene, subject, settings);
    std::vector<std::pair<double, std::string>> runs;
    for (const double accuracy : settings.accuracies)
        runs.emplace_back(accuracy, "");
    for (const TechniqueName& technique : technique_names())
        runs.emplace_back(settings.technique_accuracy, technique.name);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (progress.stop())
            throw Cancelled{};
        progress.tell("settings", static_cast<double>(i) / static_cast<double>(runs.size()));
        tradeoff.points.push_back(run_own(scene, subject, settings, tradeoff.reference, runs[i].first, runs[i].second));
    }
    if (settings.peers)
        add_peers(scene, subject, settings, tradeoff, progress);
    for (const PeerRun& run : elsewhere)
        tradeoff.points.push_back(point_of(run, tradeoff.reference));
    choose_settings(tradeoff);
    return tradeoff;
}

} // namespace

ErrorFigures error_figures(const std::vector<double>& values, const std::vector<double>& reference)
{
    if (values.size() != reference.size())
        throw std::invalid_argument("values and reference differ in count");
    ErrorFigures figures;
    const std::vector<double> by = yardsticks(reference);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(by[i] > 0))
            continue;
        const double off = (values[i] - reference[i]) / by[i];
        figures.rms += off * off;
        figures.mean_bias += off;
        sizes.push_back(std::fabs(off));
    }
    if (sizes.empty())
        return figures;
    const auto count = static_cast<double>(sizes.size());
    std::sort(sizes.begin(), sizes.end());
    figures.rms = std::sqrt(figures.rms / count);
    figures.mean_bias /= count;
    figures.percentile_95 = sizes[std::min(sizes.size() - 1, static_cast<std::size_t>(0.95 * count))];
    figures.maximum = sizes.back();
    return figures;
}

void choose_settings(Tradeoff& tradeoff)
{
    for (TradePoint& point : tradeoff.points)
        point.chosen_for.clear();
    for (const double wanted : {0.01, 0.03, 0.05, 0.1}) {
        TradePoint* best = nullptr;
        for (TradePoint& point : tradeoff.points) {
            const bool own = point.program == "Lightwell" && point.without.empty() && point.failure.empty();
            if (own && point.error.rms <= wanted && (best == nullptr || point.cpu_s < best->cpu_s))
                best = &point;
        }
        if (best != nullptr)
            best->chosen_for.push_back(wanted);
    }
}

Tradeoff measure_tradeoff(const Scene& scene, const SensorGrid& grid, const TradeSettings& settings,
                          const Progress& progress)
{
    Subject subject;
    subject.name = fmt::format("grid {}, {} sensors", grid.name, grid.sensors.size());
    subject.unit = "lx";
    subject.count = grid.sensors.size();
    subject.run = [&](const Simulation& simulation, double accuracy, int samples, bool unbiased,
                      const Techniques& techniques) {
        GridSettings wish;
        wish.accuracy = accuracy;
        wish.samples = samples;
        wish.unbiased = unbiased;
        wish.techniques = techniques;
        wish.seed = unbiased ? settings.seed + 1 : settings.seed; // the reference has paths of its own
        wish.threads = settings.threads;
        const GridResult result = simulation.illuminance(grid, wish);
        Found found;
        for (std::size_t i = 0; i < result.values.size(); ++i) {
            found.values.push_back(result.values[i].value);
            found.errors.push_back(result.standard_errors[i].value);
        }
        return found;
    };
    subject.peer = [&](const RadiancePeers& peers, int quality) { return peers.illuminance(grid, quality); };
    return measure(scene, subject, settings, progress);
}

Tradeoff measure_tradeoff(const Scene& scene, const View& view, int width, int height, const TradeSettings& settings,
                          const Progress& progress)
{
    Subject subject;
    subject.name = fmt::format("view {}, {} x {}", view.name, width, height);
    subject.unit = "cd/m2";
    subject.count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    subject.run = [&](const Simulation& simulation, double accuracy, int samples, bool unbiased,
                      const Techniques& techniques) {
        PictureSettings wish;
        wish.width = width;
        wish.height = height;
        wish.accuracy = accuracy;
        wish.samples = samples;
        wish.unbiased = unbiased;
        wish.techniques = techniques;
        wish.seed = unbiased ? settings.seed + 1 : settings.seed;
        wish.threads = settings.threads;
        const Picture picture = simulation.render(view, wish).picture;
        Found found;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                found.values.push_back(
                    luminance_of({picture.at("R", x, y), picture.at("G", x, y), picture.at("B", x, y)}).value);
                found.errors.push_back(picture.at("error.Y", x, y));
            }
        return found;
    };
    subject.peer = [&](const RadiancePeers& peers, int quality) { return peers.picture(view, width, height, quality); };
    return measure(scene, subject, settings, progress);
}

} // namespace lightwell
