#include "plugins/cli/luminaire_picture.h"

#include "engine/base/text.h"
#include "engine/pictures/font.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour paper{255, 255, 255}, ink{40, 40, 40}, faint{205, 205, 205}, plane_0{200, 60, 30},
    plane_90{30, 90, 200}, opening_colour{240, 190, 60};
constexpr int picture_width = 960, picture_height = 560;

struct Pixel {
    double x = 0, y = 0;
};

/// Lines with soft edges on a picture.
class Canvas {
public:
    Canvas() : picture_{picture_width, picture_height, {}}
    {
        picture_.rgb.assign(std::size_t{3} * picture_width * picture_height, paper[0]);
    }
    void line(const Pixel& a, const Pixel& b, const Colour& colour, double width = 1.2)
    {
        const double half = width / 2, reach = half + 1;
        const int left = static_cast<int>(std::floor(std::min(a.x, b.x) - reach));
        const int right = static_cast<int>(std::ceil(std::max(a.x, b.x) + reach));
        const int top = static_cast<int>(std::floor(std::min(a.y, b.y) - reach));
        const int bottom = static_cast<int>(std::ceil(std::max(a.y, b.y) + reach));
        const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
        for (int y = std::max(0, top); y <= std::min(picture_height - 1, bottom); ++y)
            for (int x = std::max(0, left); x <= std::min(picture_width - 1, right); ++x) {
                const double along = squared > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / squared : 0;
                const double t = std::clamp(along, 0.0, 1.0);
                mix(x, y, colour, half + 0.5 - std::hypot(x - a.x - t * dx, y - a.y - t * dy));
            }
    }
    void circle(const Pixel& centre, double radius, const Colour& colour)
    {
        constexpr int pieces = 120;
        for (int i = 0; i < pieces; ++i)
            line(on_circle(centre, radius, 2 * pi * i / pieces), on_circle(centre, radius, 2 * pi * (i + 1) / pieces),
                 colour, 1);
    }
    void arrow(const Pixel& from, const Pixel& to, const Colour& colour)
    {
        line(from, to, colour, 2);
        const double angle = std::atan2(from.y - to.y, from.x - to.x);
        constexpr double head = 10, spread = 0.45;
        if (std::hypot(from.x - to.x, from.y - to.y) > head)
            for (const double side : {-spread, spread})
                line(to, {to.x + head * std::cos(angle + side), to.y + head * std::sin(angle + side)}, colour, 2);
    }
    void text(const Pixel& at, const std::string& words, const Colour& colour, int scale = 2)
    {
        draw_text(picture_, static_cast<int>(at.x), static_cast<int>(at.y), words, scale, colour);
    }
    DisplayPicture take() { return std::move(picture_); }

private:
    static Pixel on_circle(const Pixel& centre, double radius, double angle)
    {
        return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
    }
    void mix(int x, int y, const Colour& colour, double share)
    {
        share = std::clamp(share, 0.0, 1.0);
        std::uint8_t* pixel =
            &picture_.rgb[3 * (static_cast<std::size_t>(y) * picture_width + static_cast<std::size_t>(x))];
        for (std::size_t i = 0; i < 3; ++i)
            pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + (colour[i] - pixel[i]) * share));
    }
    DisplayPicture picture_;
};

/// 1, 2 or 5 times a power of ten, at least the value.
double round_above(double value)
{
    if (!(value > 0))
        return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= value * (1 - 1e-9))
            return step * power;
    return 10 * power;
}

constexpr Pixel polar_centre{250, 290};
constexpr double polar_radius = 210;

void draw_grid(Canvas& canvas, double limit)
{
    constexpr int rings = 4;
    for (int ring = 1; ring <= rings; ++ring)
        canvas.circle(polar_centre, polar_radius * ring / rings, faint);
    for (int angle = 0; angle < 360; angle += 30) {
        const double a = angle * radians_per_degree;
        const Pixel end{polar_centre.x + polar_radius * std::sin(a), polar_centre.y + polar_radius * std::cos(a)};
        canvas.line(polar_centre, end, faint, 1);
        const int from_nadir = angle <= 180 ? angle : 360 - angle;
        const std::string words = std::to_string(from_nadir) + "\u00b0";
        canvas.text({polar_centre.x + (polar_radius + 20) * std::sin(a) - text_width(words, 1) / 2.0,
                     polar_centre.y + (polar_radius + 20) * std::cos(a) - 4},
                    words, ink, 1);
    }
    canvas.text({polar_centre.x - polar_radius, 520},
                "ring: " + shortest(limit / rings) + " cd, rim: " + shortest(limit) + " cd", ink, 1);
}

/// The curve of one plane and of the plane opposite to it.
void draw_curve(Canvas& canvas, const Photometry& photometry, double plane_deg, double limit, const Colour& colour)
{
    const double turn = plane_deg * radians_per_degree;
    Pixel last{};
    for (int angle = -180; angle <= 180; ++angle) {
        const double a = angle * radians_per_degree, across = std::sin(a);
        const double candela =
            photometry.candela_towards({across * std::cos(turn), across * std::sin(turn), -std::cos(a)});
        const double radius = polar_radius * candela / limit;
        const Pixel here{polar_centre.x + radius * std::sin(a), polar_centre.y + radius * std::cos(a)};
        if (angle > -180)
            canvas.line(last, here, colour, 2);
        last = here;
    }
}

/// Edges of the luminous opening, in its frame.
std::vector<std::pair<Point, Point>> edges_of(const Photometry::Opening& opening)
{
    using Shape = Photometry::Opening::Shape;
    const double x = std::max(opening.x_m, 0.02) / 2, y = std::max(opening.y_m, 0.02) / 2, z = opening.z_m / 2;
    const bool round = opening.shape != Shape::rectangle && opening.shape != Shape::box;
    const int sides = round ? 36 : 4;
    const double start = round ? 0 : pi / 4, stretch = round ? 1 : std::sqrt(2.0);
    std::vector<std::pair<Point, Point>> edges;
    const auto corner = [&](int i, double height) {
        const double a = start + 2 * pi * i / sides;
        return Point{x * stretch * std::cos(a), y * stretch * std::sin(a), height};
    };
    for (int i = 0; i < sides; ++i) {
        edges.emplace_back(corner(i, -z), corner(i + 1, -z));
        if (z > 0)
            edges.emplace_back(corner(i, z), corner(i + 1, z));
        if (z > 0 && i % (sides / 4) == 0)
            edges.emplace_back(corner(i, -z), corner(i, z));
    }
    return edges;
}

/// The opening, its aim and plane 0, seen along an axis of the scene.
void draw_view(Canvas& canvas, const Photometry& photometry, const Affine& frame, const Pixel& centre, bool from_above)
{
    constexpr double room = 80, arrow_length = 95;
    const Photometry::Opening& o = photometry.opening;
    const double size = std::max({o.x_m, o.y_m, o.z_m, 0.02}), scale = room / size;
    const auto seen = [&](const Vec3& v, double by) {
        return Pixel{centre.x + v.x * by, centre.y - (from_above ? v.y : v.z) * by};
    };
    for (const auto& [a, b] : edges_of(o))
        canvas.line(seen(frame.vector(a), scale), seen(frame.vector(b), scale), opening_colour, 3);
    canvas.arrow(centre, seen(-frame.z, arrow_length), ink);
    canvas.arrow(centre, seen(frame.x, arrow_length), plane_0);
    canvas.arrow(centre, seen(frame.y, arrow_length), plane_90);
    canvas.text({centre.x - 130, centre.y - 125},
                from_above ? "from above: x right, y up" : "from the side: x right, z up", ink, 1);
}

} // namespace

Affine luminaire_frame(const Vec3& aim, double turn_deg)
{
    const Direction up = -normalized(aim);
    Vec3 x = Vec3{1, 0, 0} - up * up.x;
    if (length(x) < 1e-6)
        x = Vec3{0, 1, 0} - up * up.y;
    x = normalized(x);
    const double turn = turn_deg * radians_per_degree;
    const Direction first = x * std::cos(turn) + cross(up, x) * std::sin(turn);
    return {first, cross(up, first), up, {}};
}

DisplayPicture luminaire_picture(const Photometry& photometry, const Affine& frame)
{
    Canvas canvas;
    const double limit = round_above(photometry.greatest_candela());
    draw_grid(canvas, limit);
    draw_curve(canvas, photometry, 0, limit, plane_0);
    draw_curve(canvas, photometry, 90, limit, plane_90);
    canvas.text({20, 14}, photometry.name.substr(0, 70), ink);
    canvas.text({330, 508}, "plane 0-180", plane_0, 1);
    canvas.text({330, 522}, "plane 90-270", plane_90, 1);
    draw_view(canvas, photometry, frame, {720, 170}, false);
    draw_view(canvas, photometry, frame, {720, 410}, true);
    canvas.text({590, 522}, "black: aim; red: plane 0; blue: plane 90", ink, 1);
    return canvas.take();
}

} // namespace lightwell
