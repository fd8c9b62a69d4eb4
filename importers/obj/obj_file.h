#pragma once

#include "engine/base/report.h"
#include "engine/base/vector.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// One corner of a face: zero-based indices into the lists of ObjFile; -1 where the file names none.
struct ObjCorner {
    std::int32_t point = -1, texture = -1, normal = -1;
    bool operator==(const ObjCorner&) const noexcept = default;
};

/// A polygon of any size, as written. Corners index existing, finite points.
struct ObjFace {
    std::uint32_t first; ///< into ObjFile::corners
    std::uint32_t count; ///< >= 3
    std::uint32_t state; ///< into ObjFile::states
    std::uint32_t line;
    std::uint32_t number;    ///< 1 for the first `f` statement of the file, used or not
    std::uint32_t smoothing; ///< group of `s`; 0: none
};

/// The names that were in force when a face was written.
struct ObjState {
    std::string object;              ///< of `o`, with its blanks
    std::vector<std::string> groups; ///< of `g`
    std::string material;            ///< of `usemtl`, with its blanks
    bool operator==(const ObjState&) const noexcept = default;
};

/// How often something odd was met, and in which line first.
struct ObjTally {
    std::size_t count = 0, line = 0;
    void add(std::size_t at_line)
    {
        if (count++ == 0)
            line = at_line;
    }
};

/// What an OBJ file says, in its own units and axes.
struct ObjFile {
    std::string name; ///< for places in messages: the file's name without its folder
    std::vector<Point> points;
    std::vector<float> colours;  ///< empty, or r, g, b as written for each point; NaN where there is none
    std::vector<double> texture; ///< u, v for each `vt`
    std::vector<Vec3> normals;
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;
    std::vector<ObjState> states;
    std::vector<std::string> libraries; ///< `mtllib`, each the rest of its line
    std::string unit;                   ///< of a comment such as `# unit: mm`; empty when there is none
    std::string up;                     ///< of a comment such as `# up: z`
    std::string written_by;             ///< "FreeCAD" or empty: a program whose habit is known
    std::size_t unknown_statements = 0;
    Ledger ledger; ///< what was skipped while reading
    Report report;
};

/// The first group name that means something, else the object, else the material, else "default".
std::string layer_of(const ObjState& state);

/// @param text  UTF-8, Windows-1252 or UTF-16 with a byte order mark
/// @throws InputError when the text holds neither a vertex nor a face
ObjFile read_obj(std::string_view text, const std::string& name);

} // namespace lightwell
