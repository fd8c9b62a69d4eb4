#include "materials/patterns/font.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/pictures/font.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Whole numbers of a text, one after the other.
class Wholes {
public:
    Wholes(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    bool at_end()
    {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '#')
                at_ = std::min(text_.find('\n', at_), text_.size() - 1);
            if (text_[at_] == '\n')
                ++line_;
            else if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r' && text_[at_] != '#')
                return false;
        }
        return true;
    }
    long next(const char* meaning, long least, long most)
    {
        const std::string place = at_end() ? file_ : file_ + ':' + std::to_string(line_);
        const std::size_t begin = at_;
        while (at_ < text_.size() && std::string_view(" \t\r\n#").find(text_[at_]) == std::string_view::npos)
            ++at_;
        const std::string_view token = text_.substr(begin, at_ - begin);
        const auto value = parse_integer(token);
        if (!value || *value < least || *value > most)
            throw InputError{place, std::string(meaning) + " is \"" + std::string(token.substr(0, 40)) +
                                        "\", expected a whole number from " + std::to_string(least) + " to " +
                                        std::to_string(most)};
        return static_cast<long>(*value);
    }

private:
    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0, line_ = 1;
};

/// A glyph from the cells of a bitmap: each run of cells is a rectangle, entered and left along the same line.
PolygonFont::Glyph glyph_of(const DisplayPicture& cells)
{
    // The bitmap's base line and capitals where other fonts have them.
    constexpr double cell_width = 34, left = 40, top = 222, cell_height = 25;
    PolygonFont::Glyph glyph;
    const auto inked = [&](int x, int y) {
        return x < cells.width && cells.rgb[static_cast<std::size_t>(3 * (y * cells.width + x))] > 127;
    };
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            if (!inked(x, y))
                continue;
            int end = x;
            while (inked(end, y))
                ++end;
            const double x0 = left + x * cell_width, x1 = left + end * cell_width;
            const double y1 = top - y * cell_height, y0 = y1 - cell_height;
            const UnitSquare corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
            glyph.corners.insert(glyph.corners.end(), std::begin(corners), std::end(corners));
            if (glyph.corners.size() > std::size(corners)) // back to where all begin
                glyph.corners.push_back(glyph.corners.front());
            x = end;
        }
    return glyph;
}

} // namespace

void PolygonFont::set(unsigned char code, Glyph glyph)
{
    const auto by_x = [](const UnitSquare& a, const UnitSquare& b) { return a.u < b.u; };
    if (!glyph.corners.empty()) {
        const auto [least, most] = std::minmax_element(glyph.corners.begin(), glyph.corners.end(), by_x);
        glyph.left = least->u;
        glyph.right = most->u;
    }
    glyphs_[code] = std::move(glyph);
    has_[code] = true;
}

PolygonFont PolygonFont::parse(std::string_view text, const std::string& file)
{
    PolygonFont font;
    constexpr long most_corners = 32767;
    for (Wholes numbers(text, file); !numbers.at_end();) {
        const long code = numbers.next("the code of a character", 0, 255);
        const long count = numbers.next("the number of its corners", 0, most_corners);
        Glyph glyph;
        for (long i = 0; i < count; ++i) {
            const long x = numbers.next("x of a corner", 0, 255), y = numbers.next("y of a corner", 0, 255);
            glyph.corners.push_back({static_cast<double>(x), static_cast<double>(y)});
        }
        font.set(static_cast<unsigned char>(code), std::move(glyph));
    }
    return font;
}

const PolygonFont& PolygonFont::own()
{
    static const PolygonFont font = [] {
        PolygonFont made;
        made.set(' ', {});
        for (char c = '!'; c <= '~'; ++c) {
            DisplayPicture cells{glyph_advance, glyph_height, {}};
            cells.rgb.assign(static_cast<std::size_t>(3 * glyph_advance * glyph_height), 0);
            draw_text(cells, 0, 0, std::string_view(&c, 1), 1, {255, 255, 255});
            made.set(static_cast<unsigned char>(c), glyph_of(cells));
        }
        return made;
    }();
    return font;
}

double PolygonFont::mean_width() const noexcept
{
    double sum = 0;
    int count = 0;
    for (const Glyph& glyph : glyphs_)
        if (!glyph.corners.empty()) {
            sum += glyph.right - glyph.left;
            ++count;
        }
    return count > 0 ? sum / count : square;
}

bool PolygonFont::covers(const Glyph& glyph, UnitSquare at) noexcept
{
    if (!(at.u >= glyph.left && at.u <= glyph.right))
        return false;
    bool inside = false;
    for (std::size_t i = 0, before = glyph.corners.size() - 1; i < glyph.corners.size(); before = i++) {
        const UnitSquare &a = glyph.corners[i], &b = glyph.corners[before];
        if ((a.v > at.v) != (b.v > at.v) && at.u < a.u + (b.u - a.u) * (at.v - a.v) / (b.v - a.v))
            inside = !inside;
    }
    return inside;
}

} // namespace lightwell
