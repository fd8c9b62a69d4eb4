#pragma once

#include "engine/base/spectrum.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell::commands {

/// A kind of lamp: CIE 1931 chromaticity of its light, and how much of it is left on average over its life.
struct LampKind {
    double x = 1 / 3.0, y = 1 / 3.0, depreciation = 1;
    /// Colour whose photopic value is the depreciation; nothing below 0.
    Spectrum colour() const;
};

/// Kinds of lamps by patterns in their names; the first that is found in a name counts.
/// A line of a table is `/PATTERN/ X Y DEPRECIATION` or `/PATTERN/ (NAME OF ANOTHER LINE)`; `#` begins a comment. The
/// pattern stands between two equal characters; upper and lower case are the same; `\<` and `\>` are ends of words.
class LampTable {
public:
    /// @throws InputError with file and line
    static LampTable parsed(std::string_view text, const std::string& file_name);
    /// The table named, from RAYPATH; when there is no `lamp.tab`, the table that the program brings.
    /// @return nothing when another file is not found
    static std::optional<LampTable> loaded(const std::string& name);
    std::optional<LampKind> find(const std::string& name) const;

private:
    struct Line {
        std::string pattern;
        LampKind kind;
        std::string alias; ///< looked for in place of `kind` when it is not empty
    };
    const Line* line_of(const std::string& name) const;
    std::vector<Line> lines_;
};

} // namespace lightwell::commands
