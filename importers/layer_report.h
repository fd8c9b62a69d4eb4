#pragma once

#include "importers/importer.h"

#include <filesystem>
#include <string>

namespace lightwell {

/// One object for programs: `file`, `unit`, `bounds_m` ([[x,y,z],[x,y,z]], null when there is nothing), `layers` (name,
/// surfaces, area_m2, material: assigned, or proposed before mapping) and `entities` (read, made, skipped by type,
/// layer and reason).
std::string layers_json(const Imported& imported, const std::filesystem::path& file);
/// The same as a table for people: layers, then what was skipped.
std::string layers_table(const Imported& imported);

} // namespace lightwell
