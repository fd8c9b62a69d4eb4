#pragma once

#include "plugins/commands/command.h"

namespace lightwell::commands {

// One function for each command, or for a family of them; the name is the first word.
int generate(const std::vector<std::string>& words, const Streams& streams);
int transform(const std::vector<std::string>& words, const Streams& streams);

} // namespace lightwell::commands
