#pragma once

#include "plugins/validation/validation.h"

#include <string>

namespace lightwell {

/// The rows as one page that needs nothing else: what was found, plots of expected against found and of the deviation
/// over what is allowed, every row, and what is known to be wrong in published tables.
/// @param what  the options in words, with the version: "full, seed 1, lightwell 0.2"
std::string validation_html(const std::vector<ValidationRow>& rows, const std::string& what);

} // namespace lightwell
