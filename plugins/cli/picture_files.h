#pragma once

#include "engine/control/predict.h"
#include "plugins/cli/status.h"

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

namespace lightwell {

/// One picture to be made: what it shows, how well, and the files it goes to.
struct PictureJob {
    View view;
    PictureSettings settings;
    std::filesystem::path file; ///< NAME.exr; the others take its name
    bool png = false, hdr = false;
    std::map<std::string, std::string> provenance; ///< of the scene
    Report report;                                 ///< of the scene, for the run record
    std::optional<Prediction> predicted = {};
    double time_s = 0; ///< wanted, of a machine whose processors are free; 0: the settings say how much work
};

/// Largest size within width x height whose pixels are square in the view.
void fit_to_view(const View& view, PictureSettings& settings);

/// Renders into NAME.partial.exr, going on where an interrupted run of the same picture stopped, and ends with
/// NAME.exr, NAME.run.json and, when asked for, NAME.png and NAME.hdr. Prints one line on `out`.
/// @return Status::no when interrupted, with the way to go on printed on `err`
Status make_picture(const Simulation& simulation, const PictureJob& job, std::ostream& out, std::ostream& err);

} // namespace lightwell
