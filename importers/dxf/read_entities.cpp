#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/dxf/drawing_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <unordered_map>

namespace lightwell::dxf {
namespace {

Kind kind_of(std::string_view type)
{
    static const std::unordered_map<std::string_view, Kind> kinds{
        {"LINE", Kind::line},         {"3DLINE", Kind::line},     {"LWPOLYLINE", Kind::lwpolyline},
        {"POLYLINE", Kind::polyline}, {"MLINE", Kind::multiline}, {"3DFACE", Kind::face},
        {"SOLID", Kind::solid},       {"TRACE", Kind::solid},     {"CIRCLE", Kind::circle},
        {"ARC", Kind::arc},           {"ELLIPSE", Kind::ellipse}, {"SPLINE", Kind::spline},
        {"HATCH", Kind::hatch},       {"MPOLYGON", Kind::hatch},  {"MESH", Kind::mesh},
        {"LIGHT", Kind::light},       {"INSERT", Kind::insert},
    };
    const auto found = kinds.find(type);
    return found == kinds.end() ? Kind::other : found->second;
}

/// Groups that hold coordinates, sizes, flags, counts and indices of the entities that are understood.
bool is_geometry(int code)
{
    constexpr int crease = 140, is_on = 290;
    return (code >= 10 && code <= 59) || (code >= 70 && code <= 79) || (code >= 90 && code <= 99) || code == 210 ||
           code == 220 || code == 230 || code == crease || code == is_on;
}

/// True for types whose own groups can only be told by their order from those that all entities have in front.
bool begins_at_subclass(Kind kind)
{
    return kind == Kind::hatch || kind == Kind::mesh || kind == Kind::light;
}

} // namespace

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
    drawing_.values.begin();
    bool own = true;
    for (advance(type); tag_.code != 0; advance(type)) {
        own = own && tag_.code != embedded_object;
        if (own)
            read_entity_tag(entity);
    }
    if (entity.kind == Kind::polyline)
        read_vertices(entity);
    entity.values = drawing_.values.taken();
    if (entity.kind == Kind::insert)
        read_attributes(entity);
    drawing_.entities.push_back(entity);
}

void DrawingReader::read_entity_tag(Entity& entity)
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
    case 100:
        if (begins_at_subclass(entity.kind))
            drawing_.values.drop();
        return;
    case 420:
        entity.true_colour = tags_.integer(tag_, subject) & 0xFFFFFF;
        return;
    default:
        if (entity.kind != Kind::other && is_geometry(tag_.code))
            add_value(entity);
    }
}

void DrawingReader::add_value(const Entity& entity)
{
    drawing_.values.add({tag_.code, tags_.number(tag_, [&] { return described(entity); })});
}

std::string DrawingReader::described(const Entity& entity) const
{
    return fmt::format("{} on layer \"{}\"", drawing_.types[entity.type], drawing_.layers[entity.layer].name);
}

void DrawingReader::read_vertices(const Entity& entity)
{
    while (is(0, "VERTEX")) {
        drawing_.values.add({vertex_begins, static_cast<double>(tag_.place)});
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
    for (; is(0, "ATTRIB"); ++count) {
        Attribute attribute;
        attribute.insert = drawing_.entities.size();
        attribute.layer = insert.layer;
        read_attribute(attribute);
        drawing_.attributes.push_back(std::move(attribute));
    }
    if (is(0, "SEQEND"))
        skip_tags();
}

void DrawingReader::read_attribute(Attribute& attribute)
{
    constexpr int embedded_object = 101; // the same text again, with its formatting
    bool own = true;
    for (advance("ATTRIB"); tag_.code != 0; advance("ATTRIB")) {
        own = own && tag_.code != embedded_object;
        if (!own)
            continue;
        if (tag_.code == 8)
            attribute.layer = layer_index(tag_.text);
        else if (tag_.code == 1)
            attribute.text = code_page_.decoded(trimmed(tag_.text));
        else if (tag_.code == 2)
            attribute.tag = code_page_.decoded(trimmed(tag_.text));
    }
}

} // namespace lightwell::dxf
