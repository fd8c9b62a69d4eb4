#include "importers/radiance/inline_commands.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"

#include <ostream>

namespace lightwell::commands {
namespace {

GeneratorInput input_of(const Streams& streams)
{
    return {find_in_library, [&streams] { return whole_stream(streams.in); }};
}

int written(const GeneratorAnswer& answer, const Streams& streams)
{
    streams.out << answer.text;
    streams.err << answer.messages;
    return answer.status;
}

} // namespace

/// gensky, genbox and the like: scene text from words.
int generate(const std::vector<std::string>& words, const Streams& streams)
{
    return written(find_generator(words[0])(words, input_of(streams)), streams);
}

/// xform and replmarks: scene text from scene text.
int transform(const std::vector<std::string>& words, const Streams& streams)
{
    const auto command = words[0] == "xform" ? scene_text::xform : scene_text::replmarks;
    return written(command(words, input_of(streams), {commands_permitted()}, 0), streams);
}

} // namespace lightwell::commands
