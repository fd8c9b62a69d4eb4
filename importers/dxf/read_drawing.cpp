#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/dxf/drawing_reader.h"

#include <fmt/format.h>

namespace lightwell::dxf {

std::uint32_t NameTable::find_or_add(std::string_view name, bool& fresh)
{
    fresh = false;
    if (last_ != no_index && name == last_name_)
        return last_;
    const auto [entry, added] = known_.try_emplace(lowercase_ascii(name), static_cast<std::uint32_t>(known_.size()));
    fresh = added;
    last_name_ = name;
    return last_ = entry->second;
}

DrawingReader::DrawingReader(std::string_view bytes, const std::string& file, Report& report)
    : tags_(bytes, file), report_(report)
{
    drawing_.files.push_back({file, tags_.is_binary()});
    layer_index("0");
}

bool DrawingReader::is(int code, std::string_view text) const
{
    return tag_.code == code && trimmed(tag_.text) == text;
}

void DrawingReader::advance(std::string_view inside)
{
    constexpr int comment = 999;
    do {
        if (!tags_.next(tag_))
            throw InputError{tags_.place(tag_.place), fmt::format("the file ends inside {}", inside),
                             "it is cut short: copy or save it again"};
    } while (tag_.code == comment);
}

void DrawingReader::skip_tags()
{
    do
        advance("an entity");
    while (tag_.code != 0);
}

Drawing DrawingReader::read()
{
    while (!has_ended_ && tags_.next(tag_)) {
        if (is(0, "EOF"))
            has_ended_ = true;
        else if (is(0, "SECTION"))
            read_section();
    }
    report_clips();
    if (!has_ended_)
        report_.add(Finding::repaired, tags_.place(tag_.place),
                    "the end mark (EOF) is missing; all sections are whole");
    return std::move(drawing_);
}

void DrawingReader::read_section()
{
    advance("a section");
    const std::string name{tag_.code == 2 ? trimmed(tag_.text) : std::string_view{}};
    advance("section " + name);
    if (name == "HEADER")
        read_header();
    else if (name == "TABLES")
        read_tables();
    else if (name == "BLOCKS")
        read_blocks();
    else if (name == "ENTITIES") {
        if (!drawing_.model.empty())
            report_.add(Finding::repaired, tags_.place(tag_.place), "one more section ENTITIES; all are read");
        drawing_.model.push_back(read_entities("ENDSEC"));
    }
    while (name == "OBJECTS" && !is(0, "ENDSEC"))
        if (is(0, "DICTIONARY") || is(0, "SPATIAL_FILTER"))
            read_object();
        else
            advance("section OBJECTS");
    while (!is(0, "ENDSEC"))
        advance("section " + name);
}

void DrawingReader::read_header()
{
    std::string variable;
    for (; tag_.code != 0; advance("section HEADER")) {
        if (tag_.code == 9)
            variable = trimmed(tag_.text);
        else
            read_header_variable(variable);
    }
}

void DrawingReader::read_header_variable(const std::string& variable)
{
    if (tag_.code == 70 && variable == "$INSUNITS")
        drawing_.insunits = integer("$INSUNITS");
    else if (tag_.code == 70 && variable == "$MEASUREMENT")
        drawing_.measurement = integer("$MEASUREMENT");
    else if (tag_.code == 70 && variable == "$LUNITS")
        drawing_.linear_format = integer("$LUNITS");
    else if (variable == "$INSBASE" && tag_.code >= 10 && tag_.code <= 30 && tag_.code % 10 == 0)
        drawing_.base[tag_.code / 10 - 1] = number("$INSBASE");
    else if (tag_.code == 3 && variable == "$DWGCODEPAGE") {
        code_page_ = CodePage{tag_.text};
        if (!code_page_.known())
            report_.add(Finding::assumed, tags_.place(tag_.place),
                        fmt::format("code page \"{}\" is unknown; names are read as Windows-1252", to_utf8(tag_.text)));
    }
}

void DrawingReader::read_blocks()
{
    while (!is(0, "ENDSEC")) {
        if (is(0, "BLOCK"))
            read_block();
        else
            advance("section BLOCKS");
    }
}

void DrawingReader::read_block()
{
    constexpr int external_flag = 4, overlay_flag = 8;
    Block block;
    block.place = tag_.place;
    std::uint32_t name = no_index;
    int flags = 0;
    for (advance("a block"); tag_.code != 0; advance("a block")) {
        if (tag_.code == 2)
            name = block_name_index(tag_.text);
        else if (tag_.code == 1)
            block.path = code_page_.decoded(trimmed(tag_.text));
        else if (tag_.code == 70)
            flags = integer("block");
        else if (tag_.code >= 10 && tag_.code <= 30 && tag_.code % 10 == 0)
            block.base[tag_.code / 10 - 1] = number("block");
    }
    if (flags & (external_flag | overlay_flag))
        block.source = flags & overlay_flag ? BlockSource::overlay : BlockSource::external;
    if (name == no_index)
        name = block_name_index("");
    block.entities = read_entities("ENDBLK");
    const std::string folded = lowercase_ascii(drawing_.block_names[name]);
    if (folded.starts_with("*paper_space") || folded.starts_with("$paper_space"))
        drawing_.paper.push_back(block.entities);
    if (drawing_.block_of_name[name] == no_index)
        drawing_.block_of_name[name] = static_cast<std::uint32_t>(drawing_.blocks.size());
    else
        report_.add(
            Finding::repaired, tags_.place(block.place),
            fmt::format("block \"{}\" is defined again; its first definition is used", drawing_.block_names[name]));
    drawing_.blocks.push_back(std::move(block));
}

std::uint32_t DrawingReader::layer_index(std::string_view name)
{
    name = trimmed(name);
    if (name.empty())
        name = "0";
    bool fresh = false;
    const std::uint32_t index = layer_names_.find_or_add(name, fresh);
    if (fresh)
        drawing_.layers.push_back({code_page_.decoded(name)});
    return index;
}

std::uint32_t DrawingReader::type_index(std::string_view name)
{
    bool fresh = false;
    const std::uint32_t index = type_names_.find_or_add(name, fresh);
    if (fresh)
        drawing_.types.push_back(to_utf8(name));
    return index;
}

std::uint32_t DrawingReader::block_name_index(std::string_view name)
{
    bool fresh = false;
    const std::uint32_t index = block_names_.find_or_add(trimmed(name), fresh);
    if (fresh) {
        drawing_.block_names.push_back(code_page_.decoded(trimmed(name)));
        drawing_.block_of_name.push_back(no_index);
    }
    return index;
}

std::string Drawing::place(std::uint64_t place) const
{
    const SourceFile& source = files.at(place >> file_bit);
    const std::uint64_t inside = place & (place_in_file(0, 1) - 1);
    return source.name + (source.is_binary ? ": byte " : ":") + std::to_string(inside);
}

std::string Drawing::place(const Entity& entity) const
{
    return fmt::format("{}: {} \"{}\" on layer \"{}\"", place(entity.place), types[entity.type], name(entity),
                       layers[entity.layer].name);
}

std::string Drawing::name(const Entity& entity) const
{
    const std::size_t file = entity.place >> file_bit;
    std::string name;
    if (entity.handle != 0)
        name = fmt::format("{:X}", entity.handle);
    else
        name =
            fmt::format("{}{}", files.at(file).is_binary ? "byte" : "line", entity.place & (place_in_file(0, 1) - 1));
    return file == 0 ? name : fmt::format("{}|{}", file, name); // handles are unique only inside one file
}

Drawing read_drawing(const std::filesystem::path& file, Report& report)
{
    const MappedFile mapped{file};
    if (!looks_like_dxf(mapped.bytes()))
        throw InputError{file.string() + ":1", "does not begin like a DXF file (0 / SECTION)",
                         "DWG files must be saved as DXF first"};
    return DrawingReader{mapped.bytes(), file.string(), report}.read();
}

} // namespace lightwell::dxf
