#include "materials/patterns/lettering.h"

#include "engine/base/errors.h"

#include <cmath>

namespace lightwell {

Lettering::Lettering(std::shared_ptr<const PolygonFont> font, const std::vector<std::string>& lines,
                     const Layout& layout, const std::string& place)
    : font_(std::move(font)), origin_(layout.origin)
{
    // The reciprocal vectors, so that right and down need not be square to each other.
    const Vec3 across = cross(layout.right, layout.down);
    const double area = dot(across, across);
    if (!(area > 0) || !std::isfinite(area))
        throw InputError{place, "the vectors to the right and down have no length or the same direction",
                         "the first goes along a line by one character, the second down by one line"};
    across_ = cross(layout.down, across) / area;
    downwards_ = cross(across, layout.right) / area;
    const double gap = std::fabs(layout.spacing) * PolygonFont::square;
    units_per_character_ = layout.spacing == 0 ? PolygonFont::square : font_->mean_width() + gap;
    for (const std::string& line : lines)
        lines_.push_back(set_line(line, layout.spacing));
}

Lettering::Line Lettering::set_line(const std::string& text, double spacing) const
{
    const double gap = std::fabs(spacing) * PolygonFont::square;
    Line line;
    double x = 0;
    for (const char c : text) {
        const PolygonFont::Glyph* glyph = font_->glyph(static_cast<unsigned char>(c));
        if (glyph == nullptr)
            continue;
        if (spacing == 0) {
            line.push_back({glyph, x});
            x += PolygonFont::square;
        } else if (glyph->corners.empty()) {
            line.push_back({glyph, x});
            x += font_->mean_width();
        } else {
            line.push_back({glyph, x + gap - glyph->left});
            x += glyph->right - glyph->left + gap;
        }
    }
    const auto count = static_cast<double>(line.size());
    if (spacing > 0)
        for (std::size_t i = 0; i < line.size(); ++i)
            line[i].begin += static_cast<double>(i) * (units_per_character_ - x / count);
    return line;
}

bool Lettering::covers(const Point& point) const noexcept
{
    const Vec3 offset = point - origin_;
    const double row = dot(downwards_, offset), line = std::floor(row);
    if (!(line >= 0 && line < static_cast<double>(lines_.size())))
        return false;
    const double x = dot(across_, offset) * units_per_character_;
    const double y = (1 - (row - line)) * PolygonFont::square;
    for (const Placed& placed : lines_[static_cast<std::size_t>(line)])
        if (!placed.glyph->corners.empty() && PolygonFont::covers(*placed.glyph, {x - placed.begin, y}))
            return true;
    return false;
}

} // namespace lightwell
