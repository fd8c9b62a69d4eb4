#pragma once

#include "engine/base/report.h"
#include "engine/base/vector.h"
#include "importers/dxf/colours.h"
#include "importers/dxf/values.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lightwell::dxf {

/// The types that are understood; for the others only type and layer are kept, to be counted.
enum class Kind : std::uint8_t {
    line,
    lwpolyline,
    polyline,
    multiline,
    face,
    solid,
    circle,
    arc,
    ellipse,
    spline,
    hatch,
    mesh,
    light,
    insert,
    other
};

inline constexpr std::uint32_t no_index = 0xFFFFFFFF;

struct Entity {
    Kind kind = Kind::other;
    bool in_paper_space = false;
    bool is_invisible = false;
    std::uint32_t type = 0;                ///< into Drawing::types
    std::uint32_t layer = 0;               ///< into Drawing::layers
    std::uint32_t block_name = no_index;   ///< of an INSERT, into Drawing::block_names
    std::int32_t colour = colour_by_layer; ///< palette index, colour_by_block or colour_by_layer
    std::int32_t true_colour = -1;         ///< 0xRRGGBB, or -1: `colour` counts
    Values values;                         ///< in Drawing::values
    std::uint64_t handle = 0;              ///< 0: none
    std::uint64_t place = 0;               ///< see Drawing::place()
};

struct Layer {
    std::string name; ///< UTF-8, spelled as in the layer table
    std::int32_t colour = colour_white;
    std::int32_t true_colour = -1;
    bool is_frozen = false;
    bool is_off = false;
    bool is_plotted = true;
    bool is_defined = false; ///< it stands in the layer table
};

/// Entities that stand together in Drawing::entities.
struct EntityRange {
    std::size_t first = 0, count = 0;
};

/// Where the entities of a block come from.
enum class BlockSource : std::uint8_t {
    drawing,  ///< this drawing, or another file that has been read
    external, ///< another file that is not there, or cannot be read
    overlay   ///< another file that only the drawing that names it shows
};

struct Block {
    Point base;
    BlockSource source = BlockSource::drawing;
    std::string path; ///< of the other file, as the drawing writes it
    double scale = 1; ///< units of the drawing for one unit of the block
    std::uint64_t place = 0;
    EntityRange entities;
};

/// A text that an INSERT carries (ATTRIB).
struct Attribute {
    std::size_t insert = 0;  ///< into Drawing::entities
    std::uint32_t layer = 0; ///< into Drawing::layers
    std::string tag, text;   ///< UTF-8
};

/// An entry of the tables VIEW and VPORT, not yet interpreted.
struct TableView {
    std::string name;
    bool is_viewport = false;
    std::vector<Value> values;
    std::uint64_t place = 0;
};

/// One file of a drawing: the first is the drawing itself, the others are those that it refers to.
struct SourceFile {
    std::string name; ///< for messages
    bool is_binary = false;
};

/// What a DXF file holds, each entity with its place; nothing is interpreted yet. Numbers are in drawing units.
struct Drawing {
    std::vector<SourceFile> files;
    std::optional<int> insunits;      ///< $INSUNITS
    std::optional<int> measurement;   ///< $MEASUREMENT: 0 inches and feet, 1 metric
    std::optional<int> linear_format; ///< $LUNITS: 3 and 4 write feet and inches
    Point base;                       ///< $INSBASE: the point that is placed when another drawing refers to this one
    std::vector<Layer> layers;        ///< layers[0] is "0"
    std::vector<std::string> types;
    std::vector<std::string> block_names; ///< UTF-8
    std::vector<Block> blocks;
    std::vector<std::uint32_t> block_of_name; ///< into blocks for each of block_names, or no_index
    std::deque<Entity> entities;
    std::vector<EntityRange> model; ///< the section ENTITIES; damaged files have several
    std::vector<EntityRange> paper; ///< what layouts hold beside that
    std::vector<Attribute> attributes;
    std::vector<TableView> views;
    ValueStore values;

    const std::string& file() const { return files.front().name; }
    /// `room.dxf:214`, or `room.dxf: byte 214`.
    /// @param place  line or offset in bytes, with the index of its file in front (place_in_file)
    std::string place(std::uint64_t place) const;
    /// `room.dxf:214: 3DFACE "2F" on layer "A-WALL"`.
    std::string place(const Entity& entity) const;
    /// The handle in hexadecimal, or "line214" where the file has none.
    std::string name(const Entity& entity) const;
};

/// A place keeps the index of its file above this bit, so that it still fits the digits of a double.
inline constexpr int file_bit = 40;
inline constexpr std::uint64_t place_in_file(std::uint64_t place, std::size_t file)
{
    return place | static_cast<std::uint64_t>(file) << file_bit;
}

/// Text or binary, any release from 2.5 to 2018; external references are not followed.
/// @throws InputError with file, line, entity and layer: damaged tags, numbers, sections, or a file cut short
Drawing read_drawing(const std::filesystem::path& file, Report& report);

} // namespace lightwell::dxf
