#pragma once

#include <cstddef>
#include <filesystem>

namespace lightwell::test {

/// Entities that an import of this file must account for, counted from what the reader found: those of the model, of
/// layouts, of each block that the model shows, once, and the texts of inserts among all of them.
std::size_t entities_to_account_for(const std::filesystem::path& file);

} // namespace lightwell::test
