#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace lightwell::commands {

/// A file as Radiance's commands look for it: as named, then in the folders of RAYPATH.
std::optional<std::filesystem::path> find_in_library(const std::string& name);
/// All of a stream.
std::string whole_stream(std::istream& in);

} // namespace lightwell::commands
