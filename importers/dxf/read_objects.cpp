#include "engine/base/text.h"
#include "importers/dxf/drawing_reader.h"

#include <fmt/format.h>

#include <charconv>

namespace lightwell::dxf {
namespace {

std::uint64_t handle_of(std::string_view text)
{
    text = trimmed(text);
    std::uint64_t handle = 0;
    std::from_chars(text.data(), text.data() + text.size(), handle, 16);
    return handle;
}

} // namespace

/// One object: dictionaries and clips are kept with their owners.
void DrawingReader::read_object()
{
    const bool is_dictionary = is(0, "DICTIONARY"), is_clip = is(0, "SPATIAL_FILTER");
    const std::uint64_t place = tag_.place;
    std::uint64_t handle = 0, owner = 0;
    bool in_group = false; // of other programs or reactors, between { and }
    for (advance("section OBJECTS"); tag_.code != 0; advance("section OBJECTS")) {
        if (tag_.code == 102)
            in_group = trimmed(tag_.text).starts_with('{');
        else if (tag_.code == 5)
            handle = handle_of(tag_.text);
        else if (tag_.code == 330 && !in_group && owner == 0)
            owner = handle_of(tag_.text);
    }
    if (is_dictionary)
        owner_of_dictionary_[handle] = owner;
    else if (is_clip)
        clips_.push_back({owner, place});
}

/// Names the inserts that are clipped, block by block: a clip belongs to a dictionary in the dictionary of its insert.
void DrawingReader::report_clips()
{
    constexpr int deepest = 4; // two dictionaries; a circle of owners ends the search
    std::map<std::uint64_t, const Entity*> inserts;
    if (!clips_.empty())
        for (const Entity& entity : drawing_.entities)
            if (entity.kind == Kind::insert && entity.handle != 0)
                inserts.emplace(entity.handle, &entity);
    for (const Clip& clip : clips_) {
        std::uint64_t owner = clip.owner;
        for (int step = 0; step < deepest && !inserts.contains(owner); ++step)
            if (const auto next = owner_of_dictionary_.find(owner); next != owner_of_dictionary_.end())
                owner = next->second;
        const auto insert = inserts.find(owner);
        if (insert == inserts.end() || insert->second->block_name == no_index)
            report_.add(Finding::unsupported, tags_.place(clip.place),
                        "an insert is clipped (XCLIP); the whole block is shown");
        else
            report_.add(Finding::unsupported, drawing_.place(*insert->second),
                        fmt::format("an insert is clipped (XCLIP); the whole block \"{}\" is shown",
                                    drawing_.block_names[insert->second->block_name]));
    }
}

} // namespace lightwell::dxf
