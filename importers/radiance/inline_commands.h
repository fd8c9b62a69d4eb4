#pragma once

#include "importers/generators/generator.h"

/// \file Commands in scene text (`!genbox ... | xform ...`), answered without starting a program.
namespace lightwell::scene_text {

/// A command line between pipes, quotes and backslashes taken away.
using CommandStages = std::vector<std::vector<std::string>>;
/// @throws InputError for what only a shell understands: `;`, `&`, `<`, `>`, `$`, backquotes outside quotes
CommandStages command_stages(const std::string& command, const std::string& place);

/// How commands in scene text are answered.
struct CommandPolicy {
    bool run_others = false; ///< commands that are not known here are given to the shell
};
/// The output of a command line. Known are the generators, `xform` and `replmarks`.
/// @param depth  of commands within the output of commands
/// @throws InputError when a command is not known, or fails
std::string answer_command(const std::string& command, const std::string& place, const GeneratorInput& input,
                           const CommandPolicy& policy, int depth = 0);

/// xform: scene text, transformed. Words as of the command line, its name first.
/// Error   numbers are printed with 12 digits; quarter turns are exact
GeneratorAnswer xform(const std::vector<std::string>& words, const GeneratorInput& input, const CommandPolicy& policy,
                      int depth = 0);
/// replmarks: triangular markers replaced by objects.
GeneratorAnswer replmarks(const std::vector<std::string>& words, const GeneratorInput& input,
                          const CommandPolicy& policy, int depth = 0);

} // namespace lightwell::scene_text
