#pragma once

#include "engine/base/report.h"
#include "engine/base/vector.h"
#include "importers/dxf/colours.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lightwell::dxf {

/// A number of an entity with its group code. In a POLYLINE each VERTEX begins with code 0, whose number is the
/// place of the vertex in the file.
struct Value {
    int code;
    double number;
};
inline constexpr int vertex_begins = 0;

/// The types that are understood; for the others only type and layer are kept, to be counted.
enum class Kind : std::uint8_t { line, lwpolyline, polyline, face, solid, circle, arc, insert, other };

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
    std::uint32_t value_count = 0;
    std::size_t first_value = 0; ///< into Drawing::values
    std::uint64_t handle = 0;    ///< 0: none
    std::uint64_t place = 0;     ///< line or byte offset
};

struct Layer {
    std::string name; ///< UTF-8, spelled as in the layer table
    std::int32_t colour = colour_white;
    std::int32_t true_colour = -1;
    bool is_frozen = false;
    bool is_off = false;
};

/// Entities that stand together in Drawing::entities.
struct EntityRange {
    std::size_t first = 0, count = 0;
};

struct Block {
    Point base;
    bool is_external = false; ///< drawn in another file
    std::uint64_t place = 0;
    EntityRange entities;
};

/// What a DXF file holds, each entity with its place; nothing is interpreted yet. Numbers are in drawing units.
struct Drawing {
    std::string file; ///< name for messages
    bool is_binary = false;
    std::optional<int> insunits;    ///< $INSUNITS
    std::optional<int> measurement; ///< $MEASUREMENT: 0 inches and feet, 1 metric
    std::vector<Layer> layers;      ///< layers[0] is "0"
    std::vector<std::string> types;
    std::vector<std::string> block_names; ///< UTF-8
    std::vector<Block> blocks;
    std::vector<std::uint32_t> block_of_name; ///< into blocks for each of block_names, or no_index
    std::vector<Entity> entities;
    std::vector<EntityRange> model; ///< the section ENTITIES; damaged files have several
    std::vector<Value> values;

    std::span<const Value> values_of(const Entity& entity) const
    {
        return {values.data() + entity.first_value, entity.value_count};
    }
    /// `room.dxf:214`, or `room.dxf: byte 214`.
    std::string place(std::uint64_t place) const
    {
        return file + (is_binary ? ": byte " : ":") + std::to_string(place);
    }
    /// `room.dxf:214: 3DFACE "2F" on layer "A-WALL"`.
    std::string place(const Entity& entity) const;
    /// The handle in hexadecimal, or "line214" where the file has none.
    std::string name(const Entity& entity) const;
};

/// Text or binary, any release from 2.5 to 2018.
/// @throws InputError with file, line, entity and layer: damaged tags, numbers, sections, or a file cut short
Drawing read_drawing(const std::filesystem::path& file, Report& report);

} // namespace lightwell::dxf
