#pragma once

#include "engine/control/predict.h"
#include "plugins/cli/status.h"

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// One illuminance map to be made: where, how well, and the files it goes to.
struct MapJob {
    SensorGrid grid;
    GridSettings settings;
    std::vector<std::filesystem::path> files; ///< .csv, .exr or .png, any number
    std::map<std::string, std::string> provenance;
    Report report;
    std::optional<Prediction> predicted = {};
    double time_s = 0; ///< wanted, of a machine whose processors are free; 0: the settings say how much work
};

/// Mean, extremes and uniformity (minimum / mean) of a map, lx.
struct MapSummary {
    double mean = 0, minimum = 0, maximum = 0, uniformity = 0;
    double mean_error = 0; ///< standard error of the mean, from the replicates
};
MapSummary summarize(const GridResult& result);

/// Throws when a file's ending is none of the three, or a list of points is to become a picture.
/// @throws InputError
void check_map_files(const MapJob& job);

/// Computes the illuminance of each sensor and writes the files and NAME.run.json. Prints one line on `out`.
/// @return Status::no when interrupted; nothing is written then
Status make_map(const Simulation& simulation, const MapJob& job, std::ostream& out, std::ostream& err);

} // namespace lightwell
