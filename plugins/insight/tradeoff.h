#pragma once

#include "engine/base/progress.h"
#include "engine/simulate/simulate.h"
#include "plugins/insight/chart.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// How far values lie from a reference, relative to it; where the reference is below a thousandth of its mean, relative
/// to that.
struct ErrorFigures {
    double rms = 0, mean_bias = 0, percentile_95 = 0, maximum = 0;
};
/// @throws std::invalid_argument when the numbers differ in count
ErrorFigures error_figures(const std::vector<double>& values, const std::vector<double>& reference);

/// One run: what was asked of whom, what it took, how well it did.
struct TradePoint {
    std::string program = "Lightwell", setting;
    std::string without; ///< technique that was switched off
    double cpu_s = 0, wall_s = 0;
    ErrorFigures error;
    std::vector<double> chosen_for; ///< wanted RMS errors that this is the cheapest setting for
    std::string failure;            ///< why there are no figures
};

struct TradeReference {
    std::vector<double> values;
    double residual = 0; ///< RMS over the items of its own relative standard error
    double cpu_s = 0;
    int samples = 0;
};

struct Tradeoff {
    std::string of, unit; ///< "grid desk, 120 sensors", "lx"
    TradeReference reference;
    std::vector<TradePoint> points;
};

struct TradeSettings {
    double reference_cpu_s = 120; ///< that the reference may take, roughly
    std::vector<double> accuracies = {0.3, 0.1, 0.05, 0.02, 0.01, 0.005};
    double technique_accuracy = 0.05; ///< at which techniques are switched off one by one
    bool peers = true;                ///< run rtrace, rpict where they are on the PATH
    double peer_cpu_s = 300;          ///< after which one of them is ended
    std::filesystem::path peer_file;  ///< answers of further programs, see read_peer_runs(); may be empty
    std::uint64_t seed = 1;
    int threads = 0;
    Preparation preparation = {};
};

/// Runs the scene over settings, against a reference by unbiased path tracing.
Tradeoff measure_tradeoff(const Scene& scene, const SensorGrid& grid, const TradeSettings& settings,
                          const Progress& progress = {});
Tradeoff measure_tradeoff(const Scene& scene, const View& view, int width, int height, const TradeSettings& settings,
                          const Progress& progress = {});

/// Marks for each wanted error the cheapest setting of Lightwell, all techniques on, that reached it.
void choose_settings(Tradeoff& tradeoff);
/// One line a run, with a header that names the units.
std::string tradeoff_csv(const Tradeoff& tradeoff);
std::string tradeoff_text(const Tradeoff& tradeoff);
/// RMS error against CPU time, everybody in one plot.
Chart tradeoff_chart(const Tradeoff& tradeoff, const std::string& title);

} // namespace lightwell
