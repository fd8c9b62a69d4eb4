#include "engine/base/files.h"
#include "importers/radiance/compiled_scene.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <ostream>
#include <sstream>

namespace lightwell::commands {
namespace {

/// Header and body of a file of Radiance: lines up to an empty one.
struct Split {
    std::vector<std::string> lines;
    std::string_view body;
};

Split split_file(std::string_view bytes)
{
    if (!bytes.starts_with("#?"))
        throw Fatal("bad header");
    Split split;
    for (;;) {
        const std::size_t end = bytes.find('\n');
        if (end == std::string_view::npos)
            throw Fatal("bad header: the file ends within it");
        const std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(end + 1);
        if (line.empty())
            break;
        split.lines.emplace_back(line);
    }
    split.body = bytes;
    return split;
}

std::string header_text(const Split& split, const std::string& indent)
{
    std::string text;
    for (const std::string& line : split.lines)
        text += indent + line + '\n';
    return text + indent + '\n';
}

/// The cube around a compiled scene, or the resolution line of a picture.
std::string dimensions(std::string_view bytes, const Split& split)
{
    if (is_compiled_scene(bytes)) {
        const Box cube = compiled_head(bytes, "file").cube;
        const Vec3 size = cube.high - cube.low;
        // A hair more than what is in it, as octrees are.
        constexpr double margin = 1e-5;
        const double side = std::max(0.0, max_abs(size)) * (1 + 2 * margin);
        const double skirt = side * margin / (1 + 2 * margin);
        if (split.lines.empty() || !(side > 0) || !std::isfinite(side))
            return "0 0 0 0";
        return fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}", cube.low.x - skirt, cube.low.y - skirt, cube.low.z - skirt,
                           side);
    }
    const std::size_t end = split.body.find('\n');
    const std::string_view line = split.body.substr(0, end);
    if (end == std::string_view::npos || line.size() > 80 || line.empty() || (line[0] != '-' && line[0] != '+'))
        throw Fatal("unknown dimensions");
    return std::string(line);
}

int show_files(const std::vector<std::string>& words, std::size_t first, char mode, const Streams& streams)
{
    for (std::size_t i = first; i < words.size(); ++i) {
        const MappedFile file(words[i]);
        const Split split = split_file(file.bytes());
        if (mode == '-')
            streams.out << words[i] << ": " << dimensions(file.bytes(), split) << '\n';
        else
            streams.out << words[i] << ":\n" << header_text(split, "\t");
        if (mode == '+')
            streams.out << '\t' << dimensions(file.bytes(), split) << "\n\n";
    }
    return 0;
}

/// `-a` adds lines, `-r` replaces those that set the same.
int change_header(const std::vector<std::string>& words, const Streams& streams)
{
    const std::string input = whole_stream(streams.in);
    Split split = split_file(input);
    std::vector<std::string> kept;
    for (const std::string& line : split.lines) {
        bool replaced = false;
        for (std::size_t i = 2; i < words.size() && words[1] == "-r"; ++i) {
            const std::string name = words[i].substr(0, words[i].find_first_of("= \t", 1));
            replaced = replaced || line.rfind(name + '=', 0) == 0 || line.rfind(name + ' ', 0) == 0;
        }
        if (!replaced)
            kept.push_back(line);
    }
    // FORMAT stays last, where readers expect it.
    const bool format = !kept.empty() && kept.back().rfind("FORMAT=", 0) == 0;
    const std::string last = format ? kept.back() : "";
    if (format)
        kept.pop_back();
    for (std::size_t i = 2; i < words.size(); ++i)
        if (words[1] == "-a" || words[i].find_first_of("= \t") != std::string::npos)
            kept.push_back(words[i]);
    if (format)
        kept.push_back(last);
    split.lines = kept;
    streams.out << header_text(split, "") << split.body;
    return 0;
}

/// `-c COMMAND`: the command works on the body; its words are added to the header.
int filter_body(const std::vector<std::string>& words, std::size_t first, char mode, const Streams& streams)
{
    const std::string input = whole_stream(streams.in);
    Split split = split_file(input);
    std::string command, shown;
    for (std::size_t i = first; i < words.size(); ++i) {
        shown += (shown.empty() ? "" : " ") + words[i];
        command += '\'';
        for (const char c : words[i])
            command += c == '\'' ? std::string("'\\''") : std::string(1, c);
        command += "' ";
    }
    split.lines.push_back(shown);
    streams.out << header_text(split, "");
    if (mode != 'h') {
        const std::string line = dimensions(input, split);
        if (mode == '+')
            streams.out << line << '\n';
        split.body.remove_prefix(line.size() + 1);
    }
    streams.out.flush();
    std::FILE* const pipe = popen(command.c_str(), "w");
    if (pipe == nullptr)
        throw Fatal("cannot start the command");
    std::fwrite(split.body.data(), 1, split.body.size(), pipe);
    return pclose(pipe) == 0 ? 0 : 1;
}

} // namespace

/// getinfo: headers of compiled scenes, pictures and other files that begin with `#?`.
int getinfo(const std::vector<std::string>& words, const Streams& streams)
{
    std::size_t i = 1;
    char mode = 'h';
    if (i < words.size() && (words[i] == "-d" || words[i] == "+d"))
        mode = words[i++][0];
    if (i < words.size() && (words[i] == "-a" || words[i] == "-r") && mode == 'h')
        return change_header(words, streams);
    if (i + 1 < words.size() && words[i] == "-c")
        return filter_body(words, i + 1, mode, streams);
    if (i < words.size() && words[i] != "-")
        return show_files(words, i, mode, streams);
    const std::string input = whole_stream(streams.in);
    const Split split = split_file(input);
    if (i == words.size()) {
        if (mode != '-')
            streams.out << header_text(split, "");
        if (mode != 'h')
            streams.out << dimensions(input, split) << '\n';
        return 0;
    }
    std::string_view body = split.body;
    if (mode == '-')
        body.remove_prefix(dimensions(input, split).size() + 1);
    streams.out << body;
    return 0;
}

} // namespace lightwell::commands
