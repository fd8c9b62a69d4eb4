#pragma once

#include "engine/simulate/simulate.h"

#include <span>
#include <string>
#include <vector>

namespace lightwell {

/// A technique under the name by which it is switched off.
struct TechniqueName {
    const char* name;
    const char* without; ///< what is done instead
    bool& (*part)(Techniques& techniques, Preparation& preparation);
};
std::span<const TechniqueName> technique_names() noexcept;

/// @throws InputError for a name that is not in the table; lists those that are
void switch_off(const std::string& name, Techniques& techniques, Preparation& preparation);
/// "cache,tree", in the order of the table; empty when all are on.
std::string switched_off(Techniques techniques, Preparation preparation);

} // namespace lightwell
