#include "importers/dxf/views.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/dxf/geometry.h"
#include "importers/dxf/shapes.h"

#include <algorithm>

namespace lightwell::dxf {
namespace {

enum ViewMode { perspective = 1, front_clipped = 2, back_clipped = 4, front_not_at_eye = 16 };

/// The numbers of both tables under one name, in drawing units.
struct ViewNumbers {
    double centre_x, centre_y; ///< of the picture, from the target in the picture plane
    Vec3 backward;             ///< from the target to the eye
    Point target;
    double width, height; ///< in the plane of the target
    double lens_mm, front, back, twist_deg;
    int mode;
};

ViewNumbers numbers_of(const TableView& view)
{
    const Fields fields{view.values};
    ViewNumbers n{};
    const int centre = view.is_viewport ? 12 : 10, backward = view.is_viewport ? 16 : 11;
    n.centre_x = fields.get(centre);
    n.centre_y = fields.get(centre + 10);
    n.backward = fields.point(backward, {0, 0, 1});
    n.target = fields.point(view.is_viewport ? 17 : 12);
    n.height = fields.get(40, 1);
    n.width = view.is_viewport ? n.height * fields.get(41, 1) : fields.get(41, 1);
    n.lens_mm = fields.get(42, 50);
    n.front = fields.get(43);
    n.back = fields.get(44);
    n.twist_deg = fields.get(view.is_viewport ? 51 : 50);
    n.mode = fields.flags(71);
    return n;
}

/// Axes of the picture: x to the right, y upwards, z towards the eye. A twist turns what is seen counter-clockwise.
Affine picture_axes(const ViewNumbers& n)
{
    const Direction z = normalized(n.backward);
    constexpr double upright_within = 1e-12; // then y is up in the picture, from above and from below
    const bool upright = std::fabs(z.x) + std::fabs(z.y) < upright_within;
    const Direction x = normalized(cross(upright ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, z));
    const Affine level{x, cross(z, x), z, {}};
    return compose(level, Affine::rotate(2, -n.twist_deg * radians_per_degree));
}

/// Distance behind the eye at which all of the scene lies in front of a plane.
double reach_behind(const Box& box, const Point& eye, const Direction& backward)
{
    if (box.empty())
        return 0;
    const Point middle = (box.low + box.high) * 0.5;
    const Vec3 half = (box.high - box.low) * 0.5;
    return dot(middle - eye, backward) + std::fabs(half.x * backward.x) + std::fabs(half.y * backward.y) +
           std::fabs(half.z * backward.z);
}

View view_of(const ViewNumbers& n, const Affine& to_metres, const Box& box)
{
    constexpr double film_diagonal_mm = 42, margin = 1.01;
    const Affine axes = picture_axes(n);
    const double metres = length(to_metres.x), distance_m = length(n.backward) * metres;
    View view;
    view.up = normalized(to_metres.vector(axes.y));
    const Direction backward = normalized(to_metres.vector(axes.z));
    view.direction = -backward;
    const Point target = to_metres.point(n.target + axes.x * n.centre_x + axes.y * n.centre_y);
    view.position = target + backward * distance_m;
    if (n.mode & perspective) {
        const double share = 0.5 * film_diagonal_mm / n.lens_mm / std::hypot(n.width, n.height);
        view.horizontal = 2 * std::atan(share * n.width) / radians_per_degree;
        view.vertical = 2 * std::atan(share * n.height) / radians_per_degree;
    } else {
        view.kind = View::Kind::parallel;
        view.horizontal = n.width * metres;
        view.vertical = n.height * metres;
        const double behind = reach_behind(box, view.position, backward);
        if (behind > 0)
            view.position += backward * (margin * behind);
    }
    const double eye_m = dot(view.position - target, backward);
    const bool front_by_number = !(n.mode & perspective) || (n.mode & front_not_at_eye);
    if ((n.mode & front_clipped) && front_by_number)
        view.fore_m = std::fmax(0.0, eye_m - n.front * metres);
    if (n.mode & back_clipped)
        view.aft_m = std::fmax(0.0, eye_m - n.back * metres);
    return view;
}

/// "*Active" is the window on the screen, and there can be several.
std::string name_of(const TableView& view, const std::vector<View>& views)
{
    const std::string plain = lowercase_ascii(view.name) == "*active" ? "active" : view.name;
    const std::string base = plain.empty() ? "view" : plain;
    std::string name = base;
    const auto is_taken = [&] {
        return std::any_of(views.begin(), views.end(), [&](const View& other) { return other.name == name; });
    };
    for (int number = 2; is_taken(); ++number)
        name = base + " " + std::to_string(number);
    return name;
}

} // namespace

void add_views(const Drawing& drawing, const Affine& to_metres, Imported& imported)
{
    constexpr int of_paper = 1, flags = 70;
    constexpr std::size_t most_views = 1000; // names are compared with each other
    const Box box = bounds(imported.scene);
    for (const TableView& entry : drawing.views) {
        const std::string place = drawing.place(entry.place);
        if (imported.scene.views.size() == most_views) {
            imported.report.add(Finding::ignored, place, "views beyond the first 1000");
            continue;
        }
        if (!entry.is_viewport && (Fields{entry.values}.flags(flags) & of_paper)) {
            imported.report.add(Finding::ignored, place, "a view of a layout, not of the model");
            continue;
        }
        try {
            View view = view_of(numbers_of(entry), to_metres, box);
            view.name = name_of(entry, imported.scene.views);
            Camera check{view};
            imported.scene.views.push_back(std::move(view));
        } catch (const InputError& error) {
            imported.report.add(Finding::ignored, place,
                                "view \"" + entry.name + "\" is left out: " + std::string{error.what()});
        }
    }
}

} // namespace lightwell::dxf
