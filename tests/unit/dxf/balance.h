#pragma once

#include "importers/importer.h"

#include <filesystem>

namespace lightwell::test {

/// Entities that an import of this file must account for, counted from what the reader found: those of the model, of
/// layouts, of each block that the model shows, once, and the texts of inserts among all of them.
std::size_t entities_to_account_for(const std::filesystem::path& file);

/// read = made + skipped, and read is what there is.
void expect_balanced(const Imported& imported, const std::filesystem::path& file);

} // namespace lightwell::test
