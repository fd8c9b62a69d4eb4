#pragma once

#include "importers/importer.h"

namespace lightwell {

/// Chooses the importer by content: DXF, OBJ, glTF or GLB.
/// @throws InputError that lists the formats when none recognises the file
Imported import_file(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace lightwell
