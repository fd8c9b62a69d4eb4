#include "importers/radiance/inline_commands.h"

#include "engine/base/errors.h"

#include <cstdio>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

/// Commands whose output holds commands, and so on: deeper than this it never ends.
constexpr int deepest = 32;
/// Text that one command may make: more is a slip (and would exhaust memory).
constexpr std::size_t most_text = std::size_t{1} << 30;

std::string shell_output(const std::string& command, const std::string& place)
{
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr)
        throw InputError{place, "the shell cannot be started"};
    std::string text;
    char block[65536];
    bool too_long = false;
    while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) {
        text.append(block, got);
        too_long = text.size() > most_text;
        if (too_long)
            break;
    }
    const int status = pclose(pipe);
    if (too_long)
        throw InputError{place, "the command writes more than a gigabyte", "check for loops"};
    if (status != 0)
        throw InputError{place, fmt::format("the command failed with status {}", status), "run it by hand to see why"};
    return text;
}

bool is_known(const std::string& name)
{
    return name == "xform" || name == "replmarks" || find_generator(name) != nullptr;
}

GeneratorAnswer answer_stage(const std::vector<std::string>& words, const GeneratorInput& input,
                             const CommandPolicy& policy, int depth)
{
    if (words[0] == "xform")
        return xform(words, input, policy, depth);
    if (words[0] == "replmarks")
        return replmarks(words, input, policy, depth);
    return find_generator(words[0])(words, input);
}

/// One line without its end, for a message within a message.
std::string first_line(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

} // namespace

CommandStages command_stages(const std::string& command, const std::string& place)
{
    CommandStages stages(1);
    char quote = 0;
    bool inside = false;
    const auto begin_word = [&] {
        if (!inside)
            stages.back().emplace_back();
        inside = true;
    };
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
            begin_word();
            stages.back().back() += command[++i];
        } else if (quote != 0) {
            if (c == quote)
                quote = 0;
            else
                stages.back().back() += c;
        } else if (static_cast<unsigned char>(c) <= ' ') {
            inside = false;
        } else if (c == '|') {
            stages.emplace_back();
            inside = false;
        } else if (std::string_view("<>;&$`").find(c) != std::string_view::npos) {
            throw InputError{place, fmt::format("the command uses \"{}\", which only a shell understands", c),
                             "run it, write its output to a file and name the file with !xform"};
        } else {
            begin_word();
            if (c == '"' || c == '\'')
                quote = c;
            else
                stages.back().back() += c;
        }
    }
    if (quote != 0)
        throw InputError{place, fmt::format("a quotation begun with {} does not end", quote), "close it"};
    for (const std::vector<std::string>& words : stages)
        if (words.empty())
            throw InputError{place, "a command is empty"};
    return stages;
}

std::string answer_command(const std::string& command, const std::string& place, const GeneratorInput& input,
                           const CommandPolicy& policy, int depth)
{
    if (depth > deepest)
        throw InputError{place, fmt::format("commands call commands more than {} deep", deepest),
                         "check for a file that includes itself"};
    CommandStages stages;
    bool known = true;
    try {
        stages = command_stages(command, place);
        for (const std::vector<std::string>& words : stages)
            known = known && is_known(words[0]);
    } catch (const InputError&) {
        if (!policy.run_others)
            throw;
        known = false;
    }
    if (!known && policy.run_others)
        return shell_output(command, place);
    for (const std::vector<std::string>& words : stages)
        if (!is_known(words[0]))
            throw InputError{
                place,
                fmt::format("`{}` is a command that is not answered here and not run without permission", words[0]),
                "run it yourself, write its output to NAME.rad and put `!xform NAME.rad` in its place"};
    std::string text;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        GeneratorInput stage_input = input;
        if (i > 0)
            stage_input.standard_input = [&text] { return text; };
        GeneratorAnswer answer = answer_stage(stages[i], stage_input, policy, depth + 1);
        if (answer.status != 0)
            throw InputError{place, first_line(answer.messages)};
        text = std::move(answer.text);
    }
    return text;
}

} // namespace lightwell::scene_text
