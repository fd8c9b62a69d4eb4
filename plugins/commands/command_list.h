#pragma once

#include "plugins/commands/command.h"

namespace lightwell::commands {

// One function for each command, or for a family of them; the name is the first word.
int getinfo(const std::vector<std::string>& words, const Streams& streams);
int ies2rad(const std::vector<std::string>& words, const Streams& streams);
int obj2mesh(const std::vector<std::string>& words, const Streams& streams);
int obj2rad(const std::vector<std::string>& words, const Streams& streams);
int oconv(const std::vector<std::string>& words, const Streams& streams);
int pvalue(const std::vector<std::string>& words, const Streams& streams);
int rcalc(const std::vector<std::string>& words, const Streams& streams);
int rpict(const std::vector<std::string>& words, const Streams& streams);
int rtrace(const std::vector<std::string>& words, const Streams& streams);
int vwrays(const std::vector<std::string>& words, const Streams& streams);
int generate(const std::vector<std::string>& words, const Streams& streams);
int transform(const std::vector<std::string>& words, const Streams& streams);

} // namespace lightwell::commands
