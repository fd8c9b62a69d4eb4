#pragma once

#include "engine/base/vector.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A font of polygons: one outline a character, within a square of 255 units, x to the right, y up.
class PolygonFont {
public:
    struct Glyph {
        std::vector<UnitSquare> corners; ///< outline; edges that run twice join its pieces and holes; empty: a blank
        double left = 0, right = 0;      ///< extent in x
    };
    static constexpr double square = 255;

    /// For each character its code, the number of its corners, then x and y of each, 0 to 255. `#` begins a comment.
    /// @throws InputError with file and line: a code above 255, a number of corners without end, truncated
    static PolygonFont parse(std::string_view text, const std::string& file);
    /// A plain font of strokes, for scenes that name a font which is not there.
    static const PolygonFont& own();

    /// nullptr for a character that the font does not have.
    const Glyph* glyph(unsigned char code) const noexcept
    {
        return code < glyphs_.size() && has_[code] ? &glyphs_[code] : nullptr;
    }
    double mean_width() const noexcept; ///< of the characters that are not blank
    /// Whether a point of the square is inside the character.
    static bool covers(const Glyph& glyph, UnitSquare at) noexcept;

private:
    void set(unsigned char code, Glyph glyph);

    std::vector<Glyph> glyphs_ = std::vector<Glyph>(256);
    std::vector<bool> has_ = std::vector<bool>(256);
};

} // namespace lightwell
