#include "engine/pictures/false_colour.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/pictures/colour_map.h"
#include "engine/pictures/font.h"
#include "engine/pictures/legend.h"
#include "engine/pictures/limits.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour paper{255, 255, 255}, ink{32, 32, 32}, frame{128, 128, 128}, background{222, 222, 222};

// Layout in pixels. Text at twice its size stays readable when the picture is shown at half size.
constexpr int text_scale = 2;
constexpr int line_height = (glyph_height + 3) * text_scale;
constexpr int margin = 16, gap = 16;
constexpr int least_map_width = 240, least_map_height = 160;
constexpr int bar_width = 28, tick = 6, tick_gap = 6;
constexpr int swatch = 20, swatch_gap = 14; // the gap keeps the word clear of the number at the end of the bar
constexpr int most_text_lines = 8;
constexpr int pixels_per_number = 34;

struct Layout {
    std::vector<std::string> title, caption;
    std::vector<std::string> numbers;
    std::vector<double> values; ///< of the numbers
    int map_width = 0, map_height = 0;
    int map_x = 0, map_y = 0;
    int bar_x = 0, bar_y = 0, bar_height = 0;
    int caption_y = 0;
    int width = 0, height = 0;
};

std::vector<std::string> limited_lines(const std::string& text, int width)
{
    std::vector<std::string> lines = wrapped(text, width, text_scale);
    if (static_cast<int>(lines.size()) > most_text_lines) {
        lines.resize(most_text_lines);
        lines.back().replace(lines.back().size() - std::min<std::size_t>(3, lines.back().size()), std::string::npos,
                             "...");
    }
    return lines;
}

/// Widest text of the legend, in pixels.
int legend_text_width(const std::vector<std::string>& numbers, const Scale& scale)
{
    int widest = 0;
    for (const std::string& number : numbers)
        widest = std::max(widest, text_width(number, text_scale));
    if (scale.has_more || scale.has_less)
        widest = std::max(widest, text_width("above", text_scale));
    if (scale.has_none)
        widest = std::max(widest, text_width("no value", text_scale));
    return widest;
}

Layout lay_out(const Scale& scale, const FalseColour& options, int map_width, int map_height)
{
    Layout l;
    l.map_width = map_width;
    l.map_height = map_height;
    const int field_width = std::max(map_width, least_map_width), field_height = std::max(map_height, least_map_height);
    const int below = (scale.has_less ? swatch + swatch_gap : 0) + (scale.has_none ? swatch + swatch_gap : 0);
    const int above = line_height + (scale.has_more ? swatch + swatch_gap : 0);
    l.bar_height = std::max(field_height, least_map_height + above + below) - above - below;
    l.values = legend_numbers(scale, std::max(2, l.bar_height / pixels_per_number));
    for (const double value : l.values)
        l.numbers.push_back(number_text(value));
    const int legend_width = std::max(bar_width + tick + tick_gap + legend_text_width(l.numbers, scale),
                                      text_width(options.unit, text_scale));
    const int content_width = field_width + gap + legend_width;
    l.title = limited_lines(options.title, content_width);
    l.caption = limited_lines(options.caption, content_width);

    const int top = margin + static_cast<int>(l.title.size()) * line_height + (l.title.empty() ? 0 : gap / 2);
    const int content_height = std::max(field_height, above + l.bar_height + below);
    l.map_x = margin + (field_width - map_width) / 2;
    l.map_y = top + (content_height - map_height) / 2;
    l.bar_x = margin + field_width + gap;
    l.bar_y = top + above;
    l.caption_y = top + content_height + gap;
    l.width = content_width + 2 * margin;
    l.height =
        l.caption_y + static_cast<int>(l.caption.size()) * line_height + (l.caption.empty() ? 0 : margin - gap / 2);
    return l;
}

void draw_lines(DisplayPicture& picture, const std::vector<std::string>& lines, int y)
{
    for (const std::string& line : lines) {
        draw_text(picture, margin, y, line, text_scale, ink);
        y += line_height;
    }
}

void draw_map(DisplayPicture& picture, const Layout& l, const std::vector<float>& values, int width, int cell,
              const Scale& scale)
{
    fill(picture, l.map_x - 1, l.map_y - 1, l.map_width + 2, l.map_height + 2, frame);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int x = static_cast<int>(i) % width * cell, y = static_cast<int>(i) / width * cell;
        const auto value = static_cast<double>(values[i]);
        fill(picture, l.map_x + x, l.map_y + y, cell, cell,
             std::isnan(value) ? background : map_colour(scale.place(value)));
    }
}

/// A framed square of one colour with a word beside it.
void draw_swatch(DisplayPicture& picture, int x, int y, Colour colour, const char* word)
{
    fill(picture, x - 1, y - 1, bar_width + 2, swatch + 2, frame);
    fill(picture, x, y, bar_width, swatch, colour);
    draw_text(picture, x + bar_width + tick + tick_gap, y + (swatch - cap_height * text_scale) / 2, word, text_scale,
              ink);
}

void draw_legend(DisplayPicture& picture, const Layout& l, const Scale& scale, const std::string& unit)
{
    const int top = l.bar_y - line_height - (scale.has_more ? swatch + swatch_gap : 0);
    draw_text(picture, l.bar_x, top, unit, text_scale, ink);
    if (scale.has_more)
        draw_swatch(picture, l.bar_x, l.bar_y - swatch - swatch_gap, map_colour(1), "above");
    fill(picture, l.bar_x - 1, l.bar_y - 1, bar_width + 2, l.bar_height + 2, frame);
    for (int row = 0; row < l.bar_height; ++row)
        fill(picture, l.bar_x, l.bar_y + row, bar_width, 1, map_colour(1 - (row + 0.5) / l.bar_height));
    int y = l.bar_y + l.bar_height;
    for (std::size_t i = 0; i < l.values.size(); ++i) {
        const int at = y - static_cast<int>(std::lround(scale.place(l.values[i]) * l.bar_height));
        fill(picture, l.bar_x + bar_width, std::clamp(at - 1, l.bar_y, y - 2), tick, 2, ink);
        draw_text(picture, l.bar_x + bar_width + tick + tick_gap, at - cap_height * text_scale / 2, l.numbers[i],
                  text_scale, ink);
    }
    if (scale.has_less) {
        draw_swatch(picture, l.bar_x, y + swatch_gap, map_colour(0), "below");
        y += swatch + swatch_gap;
    }
    if (scale.has_none)
        draw_swatch(picture, l.bar_x, y + swatch_gap, background, "no value");
}

void check_field(const std::vector<float>& values, int width, int height, int cell_pixels)
{
    constexpr const char* place = "false colour";
    check_layout_size(place, width, height);
    if (values.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw InputError{place, "field has " + std::to_string(values.size()) + " values, expected " +
                                    std::to_string(width) + " x " + std::to_string(height)};
    const double pixels = static_cast<double>(cell_pixels) * cell_pixels * width * height;
    if (!(cell_pixels >= 1 && pixels <= static_cast<double>(most_pixels)))
        throw InputError{
            place, "a cell is " + std::to_string(cell_pixels) + " pixels wide, which makes the map too large or empty",
            "expected at least 1 and at most " + std::to_string(most_pixels) + " pixels in all"};
}

} // namespace

DisplayPicture false_colour(const std::vector<float>& values, int width, int height, const FalseColour& options,
                            int cell_pixels)
{
    check_field(values, width, height, cell_pixels);
    const int cell = std::max(cell_pixels, std::min(least_map_width / width, least_map_height / height));
    const Scale scale = choose_scale(values, options);
    const Layout l = lay_out(scale, options, width * cell, height * cell);
    DisplayPicture picture{l.width, l.height, {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(l.width) * static_cast<std::size_t>(l.height));
    fill(picture, 0, 0, l.width, l.height, paper);
    draw_lines(picture, l.title, margin);
    draw_map(picture, l, values, width, cell, scale);
    draw_legend(picture, l, scale, options.unit);
    draw_lines(picture, l.caption, l.caption_y);
    return picture;
}

} // namespace lightwell
