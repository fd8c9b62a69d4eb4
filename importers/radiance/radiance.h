#pragma once

#include "engine/scene/scene.h"

#include <filesystem>
#include <string>

namespace lightwell {

/// Reads a scene description (the core of the Radiance language): materials and emitters, aliases, all surfaces,
/// `mesh` naming an .obj, `instance` naming a .rad file (or NAME.oct beside which NAME.rad stands), the sky
/// function of gensky, our comments `#@from`, `#@view`, `#@grid`; `!xform ... FILE` is answered without running it.
/// Files are looked for beside the referring file, beside `file`, in the working folder and on RAYPATH.
/// @param report  what was left out or repaired, with file and line
/// @return        valid by construction: validate() passes
/// @throws InputError with file and line: unknown modifier or type, wrong number of arguments, NaN, files that refer
///         to each other in a circle, commands other than xform, materials that are not modelled yet where used
Scene read_radiance(const std::filesystem::path& file, Report& report);

struct WriteOptions {
    bool flat = false;               ///< expand every instance, so that one file says it all
    double chord_tolerance_m = 1e-3; ///< for round shapes under maps that are no similarity
};
/// Writes `file`; unless flat, prototypes and meshes into NAME.parts beside it, with a script that compiles them for
/// other programs. Reading it back gives the same scene; instances that other programs could not use (emitters and
/// mirrors inside, maps that are no similarity) come back written out, and everything does when flat.
/// Error   maps of instances 1e-12 relative; all else exact but round shapes made of facets, see chord_tolerance_m
/// @throws InputError when the folder is missing, or a flat file would have more than fifty million surfaces
void write_radiance(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options, Report& report);

} // namespace lightwell
