#include "engine/scene/luminaire.h"

#include "engine/scene/light_distribution.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

using Opening = Photometry::Opening;

constexpr double point_radius_m = 0.01;
/// Between an opening and the body behind it, and between two openings back to back.
constexpr double gap_m = 0.0005;

/// The luminous opening on its way to surfaces.
class Builder {
public:
    Builder(Scene& scene, const Photometry& photometry, const LuminaireLook& look, Report& report)
        : scene_(scene), photometry_(photometry), look_(look), report_(report), opening_(photometry.opening)
    {
        part_.name = look.name;
        has_body_ = !(look.body == Vec3{});
    }
    Part part();

private:
    void simplify();
    void hold_body();
    void add_flat();
    void add_box();
    void add_ball();
    void add_cylinder(int axis);
    void add_disc_or_polygon(double z_m, bool down);
    void define(const EmittingBody& body);
    bool is_flat() const
    {
        return opening_.shape == Opening::Shape::rectangle || opening_.shape == Opening::Shape::ellipse;
    }

    Scene& scene_;
    const Photometry& photometry_;
    const LuminaireLook& look_;
    Report& report_;
    Opening opening_;
    bool has_body_ = false;
    double lower_m_ = 0, upper_m_ = 0; ///< heights of the flat faces
    ModifierId light_ = void_modifier;
    Part part_;
};

void Builder::define(const EmittingBody& body)
{
    const ModifierId pattern = scene_.add_modifier(
        {look_.name + ".distribution",
         Varying{Varying::Kind::pattern, light_distribution(photometry_, body, look_.share, look_.name)},
         void_modifier});
    const Material material = look_.seen ? Material{Light{look_.colour}} : Material{Illum{look_.colour, ""}};
    light_ = scene_.add_material(look_.name + ".light", material, pattern);
}

/// Shapes that have no surface of their own become the nearest that has one.
void Builder::simplify()
{
    using Shape = Opening::Shape;
    const bool round = std::fabs(opening_.x_m - opening_.y_m) <= 1e-6 * opening_.x_m;
    const Opening was = opening_;
    if (opening_.shape == Shape::ellipsoid || (opening_.shape == Shape::vertical_cylinder && !round))
        opening_.shape = Shape::box;
    const bool upright = opening_.shape == Shape::box || opening_.shape == Shape::vertical_cylinder;
    if (upright && !(photometry_.sends_up() && photometry_.sends_down())) {
        lower_m_ = -opening_.z_m / 2;
        upper_m_ = opening_.z_m / 2;
        opening_.shape = opening_.shape == Shape::box && was.shape == Shape::box ? Shape::rectangle : Shape::ellipse;
    } else if (opening_.shape != was.shape) {
        report_.add(Finding::approximated, look_.name,
                    std::string("luminous opening, a ") + to_text(was.shape) + " that is not round, is a box");
    }
}

/// What is before, or around, a body: it must not stand in its own light.
void Builder::hold_body()
{
    using Shape = Opening::Shape;
    const Vec3 body = look_.body + Vec3{gap_m, gap_m, gap_m};
    if (is_flat()) {
        lower_m_ = std::min(lower_m_, -body.z);
        upper_m_ = std::max(upper_m_, body.z);
        return;
    }
    const auto widen = [](double& size, double least) { size = std::max(size, least); };
    if (opening_.shape == Shape::box) {
        widen(opening_.x_m, 2 * body.x);
        widen(opening_.y_m, 2 * body.y);
        widen(opening_.z_m, 2 * body.z);
    } else if (opening_.shape == Shape::vertical_cylinder) {
        widen(opening_.x_m, 2 * std::hypot(body.x, body.y));
        widen(opening_.z_m, 2 * body.z);
    } else if (opening_.shape == Shape::cylinder_along_x) {
        widen(opening_.x_m, 2 * body.x);
        widen(opening_.z_m, 2 * std::hypot(body.y, body.z));
    } else if (opening_.shape == Shape::cylinder_along_y) {
        widen(opening_.y_m, 2 * body.y);
        widen(opening_.z_m, 2 * std::hypot(body.x, body.z));
    } else {
        opening_.shape = Shape::sphere;
        opening_.x_m = std::max({opening_.x_m, 2 * length(body), 2 * point_radius_m});
    }
}

void Builder::add_disc_or_polygon(double z_m, bool down)
{
    const double x = opening_.x_m / 2, y = opening_.y_m / 2;
    const std::string name = look_.name + (down ? ".down" : ".up");
    if (opening_.shape == Opening::Shape::ellipse && std::fabs(x - y) <= 1e-6 * x)
        return part_.add_ring({{0, 0, z_m}, {0, 0, down ? -1.0 : 1.0}, 0, x}, light_, name);
    std::vector<Point> corners{{-x, -y, z_m}, {x, -y, z_m}, {x, y, z_m}, {-x, y, z_m}};
    if (opening_.shape == Opening::Shape::ellipse) {
        constexpr int sides = 32;
        const double stretch = std::sqrt(2 * pi / (sides * std::sin(2 * pi / sides))); // keeps the area
        corners.clear();
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * pi * i / sides;
            corners.push_back({x * stretch * std::cos(angle), y * stretch * std::sin(angle), z_m});
        }
    }
    if (down)
        std::reverse(corners.begin(), corners.end());
    part_.add_polygon(corners, light_, name);
}

void Builder::add_flat()
{
    const bool ellipse = opening_.shape == Opening::Shape::ellipse;
    const double area = opening_.x_m * opening_.y_m * (ellipse ? pi / 4 : 1);
    define({EmittingBody::Kind::flat, area});
    const bool both = photometry_.sends_up() && photometry_.sends_down();
    if (both && upper_m_ - lower_m_ < gap_m) {
        lower_m_ -= gap_m / 2;
        upper_m_ += gap_m / 2;
    }
    if (photometry_.sends_down() || !photometry_.sends_up())
        add_disc_or_polygon(lower_m_, true);
    if (photometry_.sends_up())
        add_disc_or_polygon(upper_m_, false);
}

void Builder::add_box()
{
    const double x = opening_.x_m / 2, y = opening_.y_m / 2, z = opening_.z_m / 2;
    define({EmittingBody::Kind::box, 0, 2 * x, 2 * y, 2 * z});
    const Point corner[8] = {{-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z},
                             {-x, -y, z},  {x, -y, z},  {x, y, z},  {-x, y, z}};
    constexpr int faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (int face = 0; face < 6; ++face) {
        std::vector<Point> corners;
        for (const int i : faces[face])
            corners.push_back(corner[i]);
        part_.add_polygon(corners, light_, look_.name + '.' + std::to_string(face));
    }
}

void Builder::add_ball()
{
    const double radius = opening_.shape == Opening::Shape::sphere ? opening_.x_m / 2 : point_radius_m;
    define({EmittingBody::Kind::ball, pi * radius * radius});
    part_.add_sphere({{0, 0, 0}, radius}, Shape::sphere, light_, look_.name + ".ball");
}

void Builder::add_cylinder(int axis)
{
    const double diameter = axis == 2 ? opening_.x_m : opening_.z_m;
    const double length = axis == 0 ? opening_.x_m : axis == 1 ? opening_.y_m : opening_.z_m;
    define({EmittingBody::Kind::cylinder, 0, diameter, diameter, length, axis});
    Vec3 along{};
    along[axis] = 1;
    const Point ends[2] = {along * (-length / 2), along * (length / 2)};
    part_.add_cone({{ends[0], ends[1]}, {diameter / 2, diameter / 2}}, Shape::cylinder, light_, look_.name + ".side");
    for (int end = 0; end < 2; ++end)
        part_.add_ring({ends[end], end == 0 ? -along : along, 0, diameter / 2}, light_,
                       look_.name + ".end" + std::to_string(end));
}

Part Builder::part()
{
    using Shape = Opening::Shape;
    simplify();
    if (has_body_)
        hold_body();
    if (is_flat())
        add_flat();
    else if (opening_.shape == Shape::box)
        add_box();
    else if (opening_.shape == Shape::vertical_cylinder)
        add_cylinder(2);
    else if (opening_.shape == Shape::cylinder_along_x)
        add_cylinder(0);
    else if (opening_.shape == Shape::cylinder_along_y)
        add_cylinder(1);
    else
        add_ball();
    return std::move(part_);
}

} // namespace

Part luminaire_part(Scene& scene, const Photometry& photometry, const LuminaireLook& look, Report& report)
{
    return Builder(scene, photometry, look, report).part();
}

} // namespace lightwell
