#pragma once

#include "engine/scene/scene.h"

#include <filesystem>
#include <iosfwd>
#include <string>

namespace lightwell {

/// Reads a scene description (the core of the Radiance language): materials and emitters, aliases, all surfaces,
/// `mesh` naming an .obj, `instance` naming a .rad file (or NAME.oct beside which NAME.rad stands), the sky
/// function of gensky, our comments `#@from`, `#@view`, `#@grid`; `!xform ... FILE` is answered in-process.
/// @throws InputError with file and line: unknown modifier or type, wrong number of arguments, NaN, recursion
Scene read_radiance(const std::filesystem::path& file, Report& report);

struct WriteOptions {
    bool flat = false;               ///< expand every instance, so that one file says it all
    double chord_tolerance_m = 1e-3; ///< for round shapes under maps that are no similarity
};
/// Writes `file`; unless flat, prototypes as NAME.parts/*.rad beside it, referred to by `instance`.
/// Reading it back gives the same scene (flat: the same surfaces).
void write_radiance(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options, Report& report);

} // namespace lightwell
