#include "engine/control/surface_charts.h"

#include "engine/base/errors.h"
#include "engine/base/frame.h"
#include "engine/base/text.h"
#include "engine/control/flat_chart.h"
#include "engine/scene/expansion.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Triangles whose normals differ by less than this (1 - cosine) lie in one plane.
constexpr double flat_slack = 1e-9;
/// Corners of the outline of a disc: its area is then right to 2e-4, and is set exactly afterwards.
constexpr int disc_corners = 180;

void scale_areas(SurfaceChart& chart, double area_m2)
{
    double sum = 0;
    for (const double a : chart.areas_m2)
        sum += a;
    for (double& a : chart.areas_m2)
        a *= sum > 0 ? area_m2 / sum : 0;
}

std::vector<Point> disc_outline(const Ring& ring, const Affine& to_world)
{
    const Frame frame = sector_frame(ring.sector, ring.normal);
    const bool whole = ring.sector.is_whole();
    std::vector<Point> corners;
    const auto add_circle = [&](double radius, bool backwards) {
        for (int i = 0; i <= disc_corners; ++i) {
            const int step = backwards ? disc_corners - i : i;
            const double angle = ring.sector.sweep_rad * (whole ? step % disc_corners : step) / disc_corners;
            corners.push_back(
                to_world.point(ring.centre + frame.to_world({radius * std::cos(angle), radius * std::sin(angle), 0})));
        }
    };
    add_circle(ring.outer_radius, false);
    if (ring.inner_radius > 0)
        add_circle(ring.inner_radius, true);
    else if (!whole)
        corners.push_back(to_world.point(ring.centre));
    return corners;
}

/// A surface of revolution by angle and height: `at(height)` in [0, 1] gives distance from and along the axis.
struct Profile {
    double radius, along;      ///< m, in the part's frame
    double normal_r, normal_z; ///< unit normal of the front, outwards and along the axis
    double weight;             ///< area of a texel here, relative
};

template <class At>
SurfaceChart round_chart(const Point& origin, const Direction& axis, const Sector& sector, double round_m,
                         double slant_m, double spacing_m, const Affine& to_world, const At& at)
{
    const double scale = std::cbrt(std::fabs(to_world.determinant()));
    SurfaceChart chart;
    chart.kind = SurfaceChart::Kind::round;
    chart.columns = std::max(3, texels_along(round_m * sector.share() * scale, spacing_m));
    chart.rows = texels_along(slant_m * scale, spacing_m);
    if (static_cast<double>(chart.columns) * chart.rows > most_texels)
        texels_along(round_m * sector.share() * slant_m * scale * scale, spacing_m * spacing_m);
    const Frame frame = sector_frame(sector, axis);
    for (int row = 0; row < chart.rows; ++row) {
        const Profile p = at((row + 0.5) / chart.rows);
        for (int column = 0; column < chart.columns; ++column) {
            const double angle = sector.sweep_rad * (column + 0.5) / chart.columns;
            const double c = std::cos(angle), s = std::sin(angle);
            const Point place = origin + frame.to_world({p.radius * c, p.radius * s, p.along});
            const Direction normal = normalized(frame.to_world({p.normal_r * c, p.normal_r * s, p.normal_z}));
            chart.cells.push_back(static_cast<int>(chart.sensors.size()));
            chart.sensors.push_back({to_world.point(place), transform_normal(to_world, normal)});
            chart.areas_m2.push_back(p.weight);
        }
    }
    return chart;
}

SurfaceChart sphere_chart(const Sphere& sphere, bool inwards, double spacing_m, const Affine& to_world)
{
    const double side = inwards ? -1 : 1;
    return round_chart(sphere.centre, {0, 0, 1}, {}, 2 * pi * sphere.radius, pi * sphere.radius, spacing_m, to_world,
                       [&](double h) {
                           const double z = -std::cos(pi * h), r = std::sin(pi * h);
                           return Profile{sphere.radius * r, sphere.radius * z, side * r, side * z, r};
                       });
}

SurfaceChart cone_chart(const Cone& cone, bool inwards, double spacing_m, const Affine& to_world)
{
    const Vec3 axis = cone.ends[1] - cone.ends[0];
    const double height = length(axis), widening = cone.radii[1] - cone.radii[0];
    const double slant = std::hypot(height, widening), side = inwards ? -1 : 1;
    return round_chart(cone.ends[0], normalized(axis), cone.sector, 2 * pi * std::max(cone.radii[0], cone.radii[1]),
                       slant, spacing_m, to_world, [&](double h) {
                           const double r = cone.radii[0] + widening * h;
                           return Profile{r, height * h, side * height / slant, -side * widening / slant, r};
                       });
}

struct Triangle {
    std::vector<Point> corners;
    Vec3 area;
};

SurfaceChart mesh_chart(const Mesh& mesh, const std::vector<std::uint32_t>& chosen, double spacing_m,
                        const Affine& to_world)
{
    const double turn = to_world.determinant() < 0 ? -0.5 : 0.5; // a mirrored map keeps the front where it was
    std::vector<Triangle> triangles;
    std::vector<std::vector<Point>> outlines;
    bool flat = true;
    Direction first{};
    const std::size_t count = chosen.empty() ? mesh.triangles.size() / 3 : chosen.size();
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = 3 * (chosen.empty() ? n : chosen[n]);
        Triangle t{{to_world.point(mesh.points[mesh.triangles[i]]), to_world.point(mesh.points[mesh.triangles[i + 1]]),
                    to_world.point(mesh.points[mesh.triangles[i + 2]])},
                   {}};
        t.area = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]) * turn;
        if (length(t.area) > 0) {
            const Direction normal = normalized(t.area);
            if (outlines.empty())
                first = normal;
            flat = flat && dot(normal, first) >= 1 - flat_slack;
            outlines.push_back(t.corners);
        }
        triangles.push_back(std::move(t));
    }
    if (flat)
        return flat_chart(outlines, first, spacing_m);
    SurfaceChart chart;
    chart.kind = SurfaceChart::Kind::triangles;
    chart.columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(triangles.size())))));
    chart.rows = (static_cast<int>(triangles.size()) + chart.columns - 1) / chart.columns;
    chart.cells.assign(static_cast<std::size_t>(chart.columns) * static_cast<std::size_t>(chart.rows), -1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        if (!(length(t.area) > 0))
            continue;
        chart.cells[i] = static_cast<int>(chart.sensors.size());
        const Vec3 middle = (t.corners[1] - t.corners[0]) / 3 + (t.corners[2] - t.corners[0]) / 3;
        chart.sensors.push_back({t.corners[0] + middle, normalized(t.area)});
        chart.areas_m2.push_back(length(t.area));
    }
    return chart;
}

SurfaceChart polygon_chart(const Part& part, const Polygon& polygon, double spacing_m, const Affine& to_world)
{
    std::vector<Point> corners;
    for (std::uint32_t i = 0; i < polygon.count; ++i)
        corners.push_back(to_world.point(part.points[polygon.first + i]));
    const Vec3 area = polygon_area_vector(corners.data(), corners.size());
    if (!(length(area) > 0))
        return {};
    const Direction normal = normalized(area) * (to_world.determinant() < 0 ? -1.0 : 1.0);
    return flat_chart({corners}, normal, spacing_m);
}

class Walk {
public:
    Walk(const Scene& scene, const std::string& layer, double spacing_m)
        : scene_(scene), layer_(layer), split_layer_(layer + "/*"), spacing_m_(spacing_m)
    {
    }
    struct Place {
        const Place* outer;
        const std::vector<Binding>* bindings;
    };
    void walk(const Part& part, const Affine& to_world, const std::string& path, const Place* place)
    {
        for (const Surface& surface : part.surfaces) {
            if (surface.shape == Shape::instance) {
                const Instance& instance = part.instances[surface.index];
                const Place inner{place, &instance.bindings};
                walk(scene_.prototypes[instance.prototype], compose(to_world, instance.to_parent),
                     path + surface.name + "/", &inner);
                continue;
            }
            ModifierId modifier = surface.modifier;
            for (const Place* p = place; p != nullptr; p = p->outer)
                modifier = bound_modifier(scene_, modifier, *p->bindings);
            add(part, surface, to_world, path, modifier);
        }
    }
    std::vector<SurfaceChart> charts;

private:
    void add(const Part& part, const Surface& surface, const Affine& to_world, const std::string& path,
             ModifierId modifier)
    {
        if (modifier == void_modifier || surface.shape == Shape::source)
            return;
        const std::string& name = scene_.modifiers[static_cast<std::size_t>(modifier)].name;
        if (!matches(layer_, name) && !matches(split_layer_, name))
            return;
        SurfaceChart chart = surface_chart(part, surface, to_world, spacing_m_);
        if (chart.sensors.empty())
            return; // no area, no light
        texels_ += static_cast<double>(chart.sensors.size());
        if (texels_ > most_texels)
            throw InputError("layer " + layer_,
                             "has more than " + shortest(most_texels) + " texels at a spacing of " +
                                 shortest(spacing_m_) + " m",
                             "use a wider spacing, or bake fewer layers at a time");
        chart.id = path + surface.name;
        chart.layer = name;
        charts.push_back(std::move(chart));
    }

    const Scene& scene_;
    std::string layer_, split_layer_;
    double spacing_m_, texels_ = 0;
};

} // namespace

SurfaceChart surface_chart(const Part& part, const Surface& surface, const Affine& to_world, double spacing_m,
                           const std::vector<std::uint32_t>& triangles)
{
    const auto scaled = [&](SurfaceChart chart) {
        const double scale = std::cbrt(std::fabs(to_world.determinant()));
        scale_areas(chart, surface_area_m2(part, surface) * scale * scale);
        return chart;
    };
    switch (surface.shape) {
    case Shape::polygon:
        return polygon_chart(part, part.polygons[surface.index], spacing_m, to_world);
    case Shape::mesh:
        return mesh_chart(*part.meshes[surface.index], triangles, spacing_m, to_world);
    case Shape::ring: {
        const Ring& ring = part.rings[surface.index];
        return scaled(flat_chart({disc_outline(ring, to_world)}, transform_normal(to_world, ring.normal), spacing_m));
    }
    case Shape::sphere:
    case Shape::bubble:
        return scaled(sphere_chart(part.spheres[surface.index], surface.shape == Shape::bubble, spacing_m, to_world));
    case Shape::cone:
    case Shape::cylinder:
    case Shape::cup:
    case Shape::tube:
        return scaled(cone_chart(part.cones[surface.index], surface.shape == Shape::cup || surface.shape == Shape::tube,
                                 spacing_m, to_world));
    case Shape::source:
    case Shape::instance:
        break;
    }
    return {};
}

std::vector<SurfaceChart> surface_charts(const Scene& scene, const std::string& layer, double spacing_m)
{
    if (!(spacing_m > 0) || !std::isfinite(spacing_m))
        throw InputError("bake", "spacing is " + shortest(spacing_m) + ", expected > 0 m", "for example 0.1");
    Walk walk(scene, layer, spacing_m);
    walk.walk(scene.root, Affine{}, {}, nullptr);
    if (walk.charts.empty())
        throw InputError("layer \"" + layer + "\"", "has no surface with an area",
                         "list the layers with `lightwell layers`, or bake all with --all");
    return std::move(walk.charts);
}

} // namespace lightwell
