#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/compiled_scene.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"
#include "plugins/commands/scene_files.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace lightwell::commands {
namespace {

struct Wish {
    bool frozen = false, warnings = true;
    std::string base; ///< the compiled scene that is added to
    std::optional<Box> cube;
    std::vector<std::string> files;
};

double number(const std::vector<std::string>& words, std::size_t at)
{
    const auto value = at < words.size() ? parse_double(words[at]) : std::nullopt;
    if (!value || !std::isfinite(*value))
        throw Fatal("bad number in option '" + words[at < words.size() ? at : words.size() - 1] + "'");
    return *value;
}

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    std::size_t i = 1;
    for (; i < words.size() && words[i].size() > 1 && words[i][0] == '-'; ++i) {
        const std::string& word = words[i];
        if (word == "-f") {
            wish.frozen = true;
        } else if (word == "-w") {
            wish.warnings = false;
        } else if (word == "-i" && i + 1 < words.size()) {
            wish.base = words[++i];
        } else if (word == "-b") {
            const Vec3 low{number(words, i + 1), number(words, i + 2), number(words, i + 3)};
            const double size = number(words, i + 4);
            if (!(size > 0))
                throw Fatal("illegal size of the cube after '-b'");
            wish.cube = Box{low, low + Vec3{size, size, size}};
            i += 4;
        } else if (word == "-n" || word == "-r") {
            number(words, ++i); // how finely Radiance divides space; there is no such division here
        } else {
            throw Fatal("unknown option: '" + word + "'");
        }
    }
    for (; i < words.size(); ++i)
        wish.files.push_back(words[i]);
    return wish;
}

std::vector<SceneSource> sources_of(const Wish& wish, const Streams& streams)
{
    std::vector<SceneSource> sources;
    if (!wish.base.empty())
        sources.push_back({wish.base});
    for (const std::string& file : wish.files)
        sources.push_back(file == "-" ? SceneSource{"standard input", whole_stream(streams.in)} : SceneSource{file});
    for (SceneSource& source : sources) {
        const auto found = source.text ? std::nullopt : find_in_library(source.name);
        constexpr int system_status = 2;
        if (!source.text && !found)
            throw Fatal("cannot open scene file \"" + source.name + "\": not found", system_status);
        if (found)
            source.name = found->string();
    }
    return sources;
}

} // namespace

/// oconv: scene text in, a compiled scene out. Nothing is written before everything has been read.
int oconv(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    const std::vector<SceneSource> sources = sources_of(wish, streams);
    Report report;
    const NamedScene named = read_radiance_sources(sources, report, {commands_permitted()});
    if (wish.warnings)
        write_warnings(words[0], report, streams.err);
    CompileOptions options;
    options.cube = wish.cube;
    // What came by standard input cannot be read again.
    const bool from_input =
        std::any_of(sources.begin(), sources.end(), [](const SceneSource& s) { return s.text.has_value(); });
    options.frozen = wish.frozen || from_input;
    for (const SceneSource& source : sources)
        options.inputs.push_back(source.name);
    if (!wish.base.empty()) {
        const MappedFile base(sources.front().name);
        if (!is_compiled_scene(base.bytes()))
            throw Fatal("(" + wish.base + "): not an octree");
        options.header = compiled_head(base.bytes(), wish.base).header;
    }
    options.header.push_back(command_line_of(words));
    const Box around = bounds(named.scene);
    const auto inside = [&](const Vec3& p) {
        return p.x >= wish.cube->low.x && p.y >= wish.cube->low.y && p.z >= wish.cube->low.z &&
               p.x <= wish.cube->high.x && p.y <= wish.cube->high.y && p.z <= wish.cube->high.z;
    };
    if (wish.cube && !named.scene.root.surfaces.empty() && !(inside(around.low) && inside(around.high)))
        throw Fatal("boundary does not encompass scene");
    write_compiled(named, options, streams.out);
    return 0;
}

} // namespace lightwell::commands
