#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/dxf/code_page.h"
#include "importers/dxf/drawing.h"
#include "importers/dxf/read_tags.h"

#include <fmt/format.h>

#include <charconv>
#include <unordered_map>

namespace lightwell::dxf {
namespace {

Kind kind_of(std::string_view type)
{
    static const std::unordered_map<std::string_view, Kind> kinds{
        {"LINE", Kind::line},         {"3DLINE", Kind::line},   {"LWPOLYLINE", Kind::lwpolyline},
        {"POLYLINE", Kind::polyline}, {"3DFACE", Kind::face},   {"SOLID", Kind::solid},
        {"TRACE", Kind::solid},       {"CIRCLE", Kind::circle}, {"ARC", Kind::arc},
        {"INSERT", Kind::insert},
    };
    const auto found = kinds.find(type);
    return found == kinds.end() ? Kind::other : found->second;
}

/// Groups that hold coordinates, sizes, flags and indices of the entities that are understood.
bool is_geometry(int code)
{
    return (code >= 10 && code <= 59) || (code >= 70 && code <= 79) || code == 210 || code == 220 || code == 230;
}

/// Numbers for names, in order of appearance; remembers the last one, since equal names come in runs.
class NameTable {
public:
    std::uint32_t find_or_add(std::string_view name, bool& fresh)
    {
        fresh = false;
        if (last_ != no_index && name == last_name_)
            return last_;
        const auto [entry, added] =
            known_.try_emplace(lowercase_ascii(name), static_cast<std::uint32_t>(known_.size()));
        fresh = added;
        last_name_ = name;
        return last_ = entry->second;
    }

private:
    std::unordered_map<std::string, std::uint32_t> known_; ///< names are the same in upper and lower case
    std::string last_name_;
    std::uint32_t last_ = no_index;
};

class DrawingReader {
public:
    DrawingReader(std::string_view bytes, const std::string& file, Report& report) : tags_(bytes, file), report_(report)
    {
        drawing_.file = file;
        drawing_.is_binary = tags_.is_binary();
        layer_index("0");
    }
    Drawing read();

private:
    void read_section();
    void read_header();
    void read_tables();
    void read_layer();
    void read_blocks();
    void read_block();
    EntityRange read_entities(std::string_view end);
    void read_entity();
    void read_entity_tag(Entity& entity, bool with_values);
    void read_vertices(Entity& entity);
    void read_attributes(const Entity& insert);
    void add_value(const Entity& entity);
    std::string described(const Entity& entity) const;
    int integer(const char* subject) const
    {
        return tags_.integer(tag_, [subject] { return std::string{subject}; });
    }
    void skip_tags();

    bool is(int code, std::string_view text) const { return tag_.code == code && trimmed(tag_.text) == text; }
    void advance(std::string_view inside);
    std::uint32_t layer_index(std::string_view name);
    std::uint32_t type_index(std::string_view name);
    std::uint32_t block_name_index(std::string_view name);

    TagReader tags_;
    Tag tag_;
    Report& report_;
    Drawing drawing_;
    CodePage code_page_;
    NameTable layer_names_, type_names_, block_names_;
    bool has_ended_ = false;
};

/// The next tag; a file may not end inside a section, since what is missing would be missing in the picture.
void DrawingReader::advance(std::string_view inside)
{
    do {
        if (!tags_.next(tag_))
            throw InputError{tags_.place(tag_.place), fmt::format("the file ends inside {}", inside),
                             "it is cut short: copy or save it again"};
    } while (tag_.code == 999);
}

Drawing DrawingReader::read()
{
    while (!has_ended_ && tags_.next(tag_)) {
        if (is(0, "EOF"))
            has_ended_ = true;
        else if (is(0, "SECTION"))
            read_section();
    }
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
    for (; !is(0, "ENDSEC"); advance("section " + name))
        if (is(0, "SPATIAL_FILTER"))
            report_.add(Finding::unsupported, tags_.place(tag_.place),
                        "an insert is clipped (XCLIP); the whole block is shown");
}

void DrawingReader::read_header()
{
    std::string variable;
    for (; tag_.code != 0; advance("section HEADER")) {
        if (tag_.code == 9)
            variable = trimmed(tag_.text);
        else if (variable == "$INSUNITS" && tag_.code == 70)
            drawing_.insunits = integer("$INSUNITS");
        else if (variable == "$MEASUREMENT" && tag_.code == 70)
            drawing_.measurement = integer("$MEASUREMENT");
        else if (variable == "$DWGCODEPAGE" && tag_.code == 3) {
            code_page_ = CodePage{tag_.text};
            if (!code_page_.known())
                report_.add(
                    Finding::assumed, tags_.place(tag_.place),
                    fmt::format("code page \"{}\" is unknown; names are read as Windows-1252", to_utf8(tag_.text)));
        }
    }
}

void DrawingReader::read_tables()
{
    while (!is(0, "ENDSEC")) {
        if (is(0, "LAYER"))
            read_layer();
        else
            advance("section TABLES");
    }
}

void DrawingReader::read_layer()
{
    constexpr int frozen_flag = 1;
    Layer layer;
    for (advance("table LAYER"); tag_.code != 0; advance("table LAYER")) {
        if (tag_.code == 2)
            layer.name = trimmed(tag_.text);
        else if (tag_.code == 70)
            layer.is_frozen = integer("layer table") & frozen_flag;
        else if (tag_.code == 62)
            layer.colour = integer("layer table");
        else if (tag_.code == 420)
            layer.true_colour = integer("layer table");
    }
    layer.is_off = layer.colour < 0;
    layer.colour = std::abs(layer.colour);
    const std::uint32_t index = layer_index(layer.name);
    layer.name = drawing_.layers[index].name;
    drawing_.layers[index] = std::move(layer);
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
    constexpr int external_flags = 4 | 8; // external reference, overlaid or not
    Block block;
    block.place = tag_.place;
    std::uint32_t name = no_index;
    for (advance("a block"); tag_.code != 0; advance("a block")) {
        if (tag_.code == 2)
            name = block_name_index(tag_.text);
        else if (tag_.code == 70)
            block.is_external = integer("block") & external_flags;
        else if (tag_.code >= 10 && tag_.code <= 30 && tag_.code % 10 == 0)
            block.base[tag_.code / 10 - 1] = tags_.number(tag_, [] { return std::string{"block"}; });
    }
    if (name == no_index)
        name = block_name_index("");
    block.entities = read_entities("ENDBLK");
    if (drawing_.block_of_name[name] == no_index)
        drawing_.block_of_name[name] = static_cast<std::uint32_t>(drawing_.blocks.size());
    else
        report_.add(
            Finding::repaired, tags_.place(block.place),
            fmt::format("block \"{}\" is defined again; its first definition is used", drawing_.block_names[name]));
    drawing_.blocks.push_back(block);
}

EntityRange DrawingReader::read_entities(std::string_view end)
{
    const std::size_t first = drawing_.entities.size();
    while (!is(0, end)) {
        if (is(0, "ENDSEC"))
            throw InputError{tags_.place(tag_.place), fmt::format("section ends, expected {} first", end),
                             "the file is damaged: copy or save it again"};
        if (tag_.code == 0 && !is(0, "SEQEND"))
            read_entity();
        else
            advance(end == "ENDBLK" ? "a block" : "section ENTITIES");
    }
    return {first, drawing_.entities.size() - first};
}

void DrawingReader::read_entity()
{
    constexpr int embedded_object = 101; // what follows describes something else with the same group codes
    Entity entity;
    entity.place = tag_.place;
    const std::string_view type = trimmed(tag_.text);
    entity.type = type_index(type);
    entity.kind = kind_of(type);
    entity.first_value = drawing_.values.size();
    const bool with_values = entity.kind != Kind::other;
    bool own = true;
    for (advance(type); tag_.code != 0; advance(type)) {
        own = own && tag_.code != embedded_object;
        if (own)
            read_entity_tag(entity, with_values);
    }
    if (entity.kind == Kind::polyline)
        read_vertices(entity);
    else if (entity.kind == Kind::insert)
        read_attributes(entity);
    entity.value_count = static_cast<std::uint32_t>(drawing_.values.size() - entity.first_value);
    drawing_.entities.push_back(entity);
}

void DrawingReader::read_entity_tag(Entity& entity, bool with_values)
{
    const auto subject = [&] { return described(entity); };
    switch (tag_.code) {
    case 8:
        entity.layer = layer_index(tag_.text);
        return;
    case 5: {
        const std::string_view text = trimmed(tag_.text);
        std::from_chars(text.data(), text.data() + text.size(), entity.handle, 16);
        return;
    }
    case 2:
        if (entity.kind == Kind::insert)
            entity.block_name = block_name_index(tag_.text);
        return;
    case 60:
        entity.is_invisible = tags_.integer(tag_, subject) != 0;
        return;
    case 62:
        entity.colour = tags_.integer(tag_, subject);
        return;
    case 67:
        entity.in_paper_space = tags_.integer(tag_, subject) != 0;
        return;
    case 420:
        entity.true_colour = tags_.integer(tag_, subject) & 0xFFFFFF;
        return;
    default:
        if (with_values && is_geometry(tag_.code))
            add_value(entity);
    }
}

void DrawingReader::add_value(const Entity& entity)
{
    drawing_.values.push_back({tag_.code, tags_.number(tag_, [&] { return described(entity); })});
}

std::string DrawingReader::described(const Entity& entity) const
{
    return fmt::format("{} on layer \"{}\"", drawing_.types[entity.type], drawing_.layers[entity.layer].name);
}

void DrawingReader::read_vertices(Entity& entity)
{
    while (is(0, "VERTEX")) {
        drawing_.values.push_back({vertex_begins, static_cast<double>(tag_.place)});
        for (advance("VERTEX"); tag_.code != 0; advance("VERTEX"))
            if (is_geometry(tag_.code))
                add_value(entity);
    }
    if (is(0, "SEQEND"))
        skip_tags();
    else
        report_.add(Finding::repaired, tags_.place(entity.place),
                    "POLYLINE without SEQEND; its vertices end where the next entity begins");
}

void DrawingReader::read_attributes(const Entity& insert)
{
    std::size_t count = 0;
    for (; is(0, "ATTRIB"); ++count)
        skip_tags();
    if (count > 0)
        report_.add(Finding::ignored, tags_.place(insert.place), "attributes of inserts are text", count);
    if (is(0, "SEQEND"))
        skip_tags();
}

void DrawingReader::skip_tags()
{
    do
        advance("an entity");
    while (tag_.code != 0);
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

} // namespace

std::string Drawing::place(const Entity& entity) const
{
    return fmt::format("{}: {} \"{}\" on layer \"{}\"", place(entity.place), types[entity.type], name(entity),
                       layers[entity.layer].name);
}

std::string Drawing::name(const Entity& entity) const
{
    return entity.handle != 0 ? fmt::format("{:X}", entity.handle)
                              : fmt::format("{}{}", is_binary ? "byte" : "line", entity.place);
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
