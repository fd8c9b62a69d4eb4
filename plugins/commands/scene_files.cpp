#include "plugins/commands/scene_files.h"

#include "engine/base/files.h"
#include "plugins/commands/command.h"
#include "plugins/commands/library_path.h"

#include <cstdio>
#include <ostream>

namespace lightwell::commands {
namespace {

constexpr int system_status = 2;

/// The words of a command that the user gave on this program's own command line.
std::string output_of(const std::string& command)
{
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr)
        throw Fatal("cannot start \"" + command + "\"", system_status);
    std::string text;
    char block[65536];
    while (const std::size_t got = std::fread(block, 1, sizeof block, pipe))
        text.append(block, got);
    if (pclose(pipe) != 0)
        throw Fatal("bad status from \"!" + command + "\"", system_status);
    return text;
}

} // namespace

void write_warnings(const std::string& program, const Report& report, std::ostream& err)
{
    for (const Note& note : report.notes())
        err << program << ": warning - " << note.place << ": " << note.text
            << (note.count > 1 ? " (" + std::to_string(note.count) + " times)" : "") << '\n';
}

std::string command_line_of(const std::vector<std::string>& words)
{
    std::string line;
    for (const std::string& word : words) {
        const bool plain = !word.empty() && word.find_first_of(" \t\n'\"*?$|<>;&()") == std::string::npos;
        line += (line.empty() ? "" : " ") + (plain ? word : '\'' + word + '\'');
    }
    return line;
}

LoadedScene load_scene(const std::string& name, const Streams& streams)
{
    LoadedScene loaded;
    SceneSource source{name.empty() || name == "-" ? "standard input" : name};
    if (name.empty() || name == "-")
        source.text = whole_stream(streams.in);
    else if (name[0] == '!')
        source.text = output_of(name.substr(1));
    else if (const auto found = find_in_library(name))
        source.name = found->string();
    else
        throw Fatal("cannot find octree \"" + name + "\"", system_status);
    if (source.text) {
        if (is_compiled_scene(*source.text))
            loaded.header = compiled_head(*source.text, source.name).header;
    } else if (const MappedFile mapped(source.name); is_compiled_scene(mapped.bytes())) {
        loaded.header = compiled_head(mapped.bytes(), source.name).header;
    }
    loaded.scene = read_radiance_sources({source}, loaded.report, {commands_permitted()}).scene;
    return loaded;
}

} // namespace lightwell::commands
