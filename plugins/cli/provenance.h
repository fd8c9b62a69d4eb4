#pragma once

#include "engine/base/report.h"
#include "engine/control/predict.h"
#include "engine/simulate/simulate.h"
#include "plugins/cli/options.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// "lightwell 0.1.0".
std::string program_version();
/// Keeps the command line for the records of this run; called once, at the start.
void remember_command(const std::vector<std::string>& arguments);

/// What varies from run to run and therefore stands beside a result, not in it: NAME.run.json.
struct RunRecord {
    double seconds = 0;
    double cpu_seconds = 0; ///< of all threads
    int threads = 0;        ///< as asked; 0: all processors
    int samples = 0;
    WorkCounts work;
    double wanted_accuracy = 0;
    double median_relative_error = 0;
    BiasEstimate bias;                       ///< no points: not looked for
    double wanted_time_s = 0;                ///< 0: an accuracy was wanted
    std::string replay;                      ///< words of the command line that repeat the result to the bit
    std::map<std::string, std::string> more; ///< settings of the result, as in its header
    std::optional<Prediction> predicted;
    Report report;
};
/// All but `more`.
/// @param job, result  of a picture or a map
template <class Job, class Result>
RunRecord record_of(const Job& job, const Result& result, double cpu_seconds)
{
    RunRecord record;
    record.seconds = result.seconds;
    record.cpu_seconds = cpu_seconds;
    record.predicted = job.predicted;
    record.threads = job.settings.threads;
    record.samples = result.samples;
    record.work = result.work;
    record.wanted_accuracy = job.settings.accuracy;
    record.median_relative_error = result.median_relative_error;
    record.bias = result.bias;
    record.wanted_time_s = job.time_s;
    record.replay = replay_words(job.settings.accuracy, result.samples, job.settings.seed);
    record.report = job.report;
    record.report.add(result.report);
    return record;
}
/// `room.exr` -> `room.run.json`.
std::filesystem::path run_record_name(const std::filesystem::path& result);
void write_run_record(const std::filesystem::path& result, const RunRecord& record);

} // namespace lightwell
