#pragma once

#include "engine/base/spectrum.h"
#include "plugins/commands/ies_opening.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell::commands {

/// How scene text is made of a photometric file.
struct IesWish {
    std::vector<std::string> comments; ///< lines that the scene text begins with
    std::string name;                  ///< of modifiers and surfaces
    std::string data_file;             ///< as the scene text names it
    std::string tilt_name;             ///< of the modifier that tilts; empty without a table
    std::string tilt_file;             ///< as the scene text names it
    double units_per_metre = 1;
    std::optional<double> illum_radius; ///< in those units: the distribution on an invisible sphere
    double factor = 1;
    Spectrum colour{1, 1, 1};
};

/// The intensities as a data file: W/sr by plane and angle from the nadir.
std::string ies_data(const IesFile& file);
/// The share of light by the angle of tilt as a data file.
std::string ies_tilt_data(const IesFile& file);
/// The lamp as scene text.
/// @param opening  of the file; nothing with `illum_radius`
/// @throws Fatal for photometry of type A, which Radiance's functions do not know
std::string ies_scene_text(const IesFile& file, const std::optional<IesOpening>& opening, const IesWish& wish);

} // namespace lightwell::commands
