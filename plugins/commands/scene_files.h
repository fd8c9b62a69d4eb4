#pragma once

#include "engine/base/report.h"
#include "importers/radiance/compiled_scene.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace lightwell::commands {

struct Streams;

/// Notes of the reader as `NAME: warning - PLACE: TEXT`.
void write_warnings(const std::string& program, const Report& report, std::ostream& err);
/// The command as a line of a header; words with blanks are quoted.
std::string command_line_of(const std::vector<std::string>& words);

/// A scene to be lit, and the header lines of the file that it came from.
struct LoadedScene {
    Scene scene;
    std::vector<std::string> header;
    Report report;
};
/// A compiled scene, or scene text: by name, from standard input when the name is empty or `-`, or from the output of a
/// command when the name begins with `!`.
/// @throws Fatal when it cannot be opened
LoadedScene load_scene(const std::string& name, const Streams& streams);

} // namespace lightwell::commands
