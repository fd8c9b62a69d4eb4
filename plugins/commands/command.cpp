#include "plugins/commands/command.h"

#include "engine/base/errors.h"
#include "plugins/commands/command_list.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>

namespace lightwell::commands {
namespace {

struct NamedCommand {
    const char* name;
    Command run;
};
constexpr NamedCommand all[] = {
    {"genblinds", generate}, {"genbox", generate}, {"gendaylit", generate}, {"genprism", generate},
    {"genrev", generate},    {"gensky", generate}, {"gensurf", generate},   {"genworm", generate},
    {"getinfo", getinfo},    {"ies2rad", ies2rad}, {"obj2mesh", obj2mesh},  {"obj2rad", obj2rad},
    {"oconv", oconv},        {"pvalue", pvalue},   {"rcalc", rcalc},        {"replmarks", transform},
    {"rpict", rpict},        {"rtrace", rtrace},   {"vwrays", vwrays},      {"xform", transform},
};

std::string plain_name(const std::string& program)
{
    const std::filesystem::path path(program);
    return path.extension() == ".exe" ? path.stem().string() : path.filename().string();
}

const NamedCommand* find(const std::string& program)
{
    const std::string name = plain_name(program);
    const auto* found =
        std::find_if(std::begin(all), std::end(all), [&](const NamedCommand& c) { return name == c.name; });
    return found == std::end(all) ? nullptr : found;
}

} // namespace

bool is_command(const std::string& program)
{
    return find(program) != nullptr;
}

int run_command(const std::vector<std::string>& words)
{
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    const int status = run_command(words, {std::cin, std::cout, std::cerr});
    if (!std::cout.flush()) {
        std::cerr << plain_name(words[0]) << ": fatal - standard output cannot be written\n";
        return 1;
    }
    return status;
}

int run_command(const std::vector<std::string>& words, const Streams& streams)
{
    const NamedCommand* command = find(words.at(0));
    if (command == nullptr) {
        streams.err << "lightwell: \"" << words[0] << "\" is no command\n";
        return 2;
    }
    std::vector<std::string> named = words;
    named[0] = command->name;
    std::string problem;
    int status = 1;
    try {
        return command->run(named, streams);
    } catch (const Fatal& fatal) {
        problem = fatal.what();
        status = fatal.status;
    } catch (const InputError& error) {
        problem = error.what();
    } catch (const std::bad_alloc&) {
        problem = "out of memory";
    } catch (const std::exception& error) {
        problem = std::string("internal error: ") + error.what();
    }
    streams.out.flush();
    streams.err << named[0] << ": fatal - " << problem << '\n';
    return status;
}

std::vector<std::string> command_names()
{
    std::vector<std::string> names;
    for (const NamedCommand& command : all)
        names.emplace_back(command.name);
    return names;
}

bool commands_permitted()
{
    const char* const value = std::getenv("LIGHTWELL_RUN_COMMANDS");
    return value != nullptr && std::string(value) == "1";
}

} // namespace lightwell::commands
