#pragma once

#include "importers/importer.h"

#include <filesystem>

namespace lightwell::test {

/// read = made + skipped, and read is what there is.
void expect_balanced(const Imported& imported, const std::filesystem::path& file);

} // namespace lightwell::test
