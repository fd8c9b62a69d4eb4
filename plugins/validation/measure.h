#pragma once

#include "plugins/validation/case.h"

namespace lightwell {

/// One checked quantity, measured finely enough where that is affordable.
/// @param settings  seed and whether this is a full run
ValidationRow run_check(const Simulation& simulation, const Check& check, const ValidationOptions& options);

} // namespace lightwell
