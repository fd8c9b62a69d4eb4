#pragma once

#include "importers/dxf/code_page.h"
#include "importers/dxf/drawing.h"
#include "importers/dxf/read_tags.h"

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lightwell::dxf {

/// Numbers for names, in order of appearance; remembers the last one, since equal names come in runs.
class NameTable {
public:
    std::uint32_t find_or_add(std::string_view name, bool& fresh);

private:
    std::unordered_map<std::string, std::uint32_t> known_; ///< names are the same in upper and lower case
    std::string last_name_;
    std::uint32_t last_ = no_index;
};

/// Sorts the tags of one file into a Drawing. Sections stand in read_drawing.cpp, what the tables hold in
/// read_tables.cpp, entities in read_entities.cpp.
class DrawingReader {
public:
    /// @param bytes  needed only while reading
    DrawingReader(std::string_view bytes, const std::string& file, Report& report);
    Drawing read();

private:
    void read_section();
    void read_header();
    void read_header_variable(const std::string& variable);
    void read_blocks();
    void read_block();
    void read_object();
    void report_clips();

    void read_tables();
    void read_layer();
    void read_view(bool is_viewport);

    EntityRange read_entities(std::string_view end);
    void read_entity();
    void read_entity_tag(Entity& entity);
    void read_vertices(const Entity& entity);
    void read_attributes(const Entity& insert);
    void read_attribute(Attribute& attribute);
    void add_value(const Entity& entity);
    std::string described(const Entity& entity) const;

    bool is(int code, std::string_view text) const;
    /// The next tag; a file may not end inside a section, since what is missing would be missing in the picture.
    void advance(std::string_view inside);
    void skip_tags();
    int integer(const char* subject) const
    {
        return tags_.integer(tag_, [subject] { return std::string{subject}; });
    }
    double number(const char* subject) const
    {
        return tags_.number(tag_, [subject] { return std::string{subject}; });
    }
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
    struct Clip {
        std::uint64_t owner, place;
    };
    std::vector<Clip> clips_;
    std::map<std::uint64_t, std::uint64_t> owner_of_dictionary_;
};

} // namespace lightwell::dxf
