#pragma once

#include "plugins/cli/map_files.h"
#include "plugins/cli/picture_files.h"

/// \file What requests of a host share with the subcommands, without what those print.
namespace lightwell {

/// @throws InputError when nothing in the scene emits light
void require_light(const Scene& scene, const std::string& files);

/// Entries that say how the picture came about: view, settings, seed, units, program.
std::map<std::string, std::string> picture_header(const Simulation& simulation, const PictureJob& job);

/// Computes the illuminance of each sensor and writes the files and NAME.run.json.
/// @throws Cancelled, before anything is written
GridResult measure_map(const Simulation& simulation, MapJob& job, const Progress& progress);

} // namespace lightwell
