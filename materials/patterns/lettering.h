#pragma once

#include "engine/base/vector.h"
#include "materials/patterns/font.h"

#include <memory>
#include <string>
#include <vector>

namespace lightwell {

/// Lines of text on a plane, seen from wherever: a point is mapped to the plane first.
class Lettering {
public:
    struct Layout {
        Point origin;     ///< upper left corner of the first character
        Vec3 right, down; ///< one character across, one line down
        /// 0: all characters as wide. Else that much between their outlines, as a share of the square, and all scaled
        /// so that a mean one is as wide as before; above 0 each line is stretched to the length it would have with
        /// even characters, below 0 it is not.
        double spacing = 0;
    };
    /// @throws InputError when right and down do not span a plane
    Lettering(std::shared_ptr<const PolygonFont> font, const std::vector<std::string>& lines, const Layout& layout,
              const std::string& place);

    bool covers(const Point& point) const noexcept;

private:
    struct Placed {
        const PolygonFont::Glyph* glyph;
        double begin; ///< where x = 0 of its square lies along the line, in units of the font
    };
    using Line = std::vector<Placed>;
    Line set_line(const std::string& text, double spacing) const;

    std::shared_ptr<const PolygonFont> font_;
    std::vector<Line> lines_;
    Point origin_;
    Vec3 across_, downwards_; ///< a point's place along and across the lines is its product with these
    double units_per_character_;
};

} // namespace lightwell
