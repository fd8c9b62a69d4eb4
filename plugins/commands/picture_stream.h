#pragma once

#include "engine/pictures/picture.h"

#include <iosfwd>
#include <string>

namespace lightwell::commands {

/// Writes a Radiance picture to a stream.
void write_picture(const Picture& picture, std::ostream& out);
/// Reads one from a file, or from `in` when the name is empty or `-`.
/// @param bytes  receives the file's own bytes, for its header lines
Picture read_picture(const std::string& name, std::istream& in, std::string& bytes);

} // namespace lightwell::commands
