#pragma once

#include "importers/radiance/radiance.h"

namespace lightwell {

struct RadianceReadOptions {
    /// Commands in the text that are not answered here are given to the shell. Only for text that is trusted.
    bool run_commands = false;
};
/// read_radiance() with options. Commands are answered without running them: `!xform`, the generators, `!replmarks`,
/// and pipes of these.
Scene read_radiance(const std::filesystem::path& file, Report& report, const RadianceReadOptions& options);

} // namespace lightwell
