#include "importers/radiance/place_surface.h"

#include "engine/base/frame.h"
#include "engine/base/text.h"

#include <algorithm>

namespace lightwell::scene_text {
namespace {

/// Relative deviation up to which the image of a circle counts as a circle: rounding, not design.
constexpr double round_enough = 1e-12;

/// Facets of a full turn; the limits keep tiny things recognizable and large ones affordable.
constexpr int fewest_facets = 12, most_facets = 720;

/// So that the chords of a circle of this radius stay within the tolerance.
int facets_of_turn(double radius, double tolerance)
{
    if (!(radius > tolerance))
        return fewest_facets;
    const double facets = std::ceil(pi / std::acos(1 - tolerance / radius));
    return static_cast<int>(std::clamp<double>(facets, fewest_facets, most_facets));
}

bool perpendicular(const Vec3& a, const Vec3& b) noexcept
{
    return std::fabs(dot(a, b)) <= round_enough * length(a) * length(b);
}

/// The scale of the map on the plane across `axis`, when circles there stay circles; else 0.
double scale_across(const Affine& map, const Direction& axis) noexcept
{
    const Frame frame = frame_about(axis);
    const Vec3 u = map.vector(frame.x), v = map.vector(frame.y);
    const double size = length(u);
    const bool circle = std::fabs(length(v) - size) <= round_enough * size && perpendicular(u, v);
    return circle ? size : 0;
}

/// Adds facets of one round surface, numbered, with their fronts on the side of `front` at each facet.
class FacetMaker {
public:
    FacetMaker(Part& to, const Affine& map, ModifierId modifier, const std::string& name)
        : to_(to), map_(map), modifier_(modifier), name_(name)
    {
    }
    /// Corners counter-clockwise seen from the front, before the map.
    void add(std::vector<Point> corners)
    {
        for (Point& corner : corners)
            corner = map_.point(corner);
        if (map_.determinant() < 0)
            std::reverse(corners.begin(), corners.end());
        to_.add_polygon(corners, modifier_, name_ + '.' + std::to_string(++count_));
    }

private:
    Part& to_;
    const Affine& map_;
    ModifierId modifier_;
    const std::string& name_;
    int count_ = 0;
};

void add_facet(FacetMaker& facets, std::vector<Point> corners, bool inwards)
{
    if (inwards)
        std::reverse(corners.begin(), corners.end());
    facets.add(std::move(corners));
}

void add_faceted_sphere(FacetMaker& facets, const Sphere& sphere, bool inwards, int turn)
{
    const int levels = turn / 2;
    const auto at = [&](int level, int step) {
        const double polar = pi * level / levels, azimuth = 2 * pi * (step % turn) / turn;
        const Vec3 d{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
        return level == 0 || level == levels ? sphere.centre + Vec3{0, 0, level == 0 ? sphere.radius : -sphere.radius}
                                             : sphere.centre + d * sphere.radius;
    };
    for (int level = 0; level < levels; ++level)
        for (int step = 0; step < turn; ++step) {
            std::vector<Point> corners{at(level, step), at(level + 1, step)};
            if (level + 1 < levels)
                corners.push_back(at(level + 1, step + 1));
            if (level > 0)
                corners.push_back(at(level, step + 1));
            add_facet(facets, std::move(corners), inwards);
        }
}

/// Steps for the part of a turn that a surface covers.
int steps_of(const Sector& sector, int turn)
{
    return std::max(1, static_cast<int>(std::ceil(turn * sector.share())));
}

/// Angle from the start of the sector; a whole turn comes back to the bit.
double azimuth_of(const Sector& sector, int step, int steps)
{
    return sector.is_whole() ? 2 * pi * (step % steps) / steps : sector.sweep_rad * step / steps;
}

void add_faceted_cone(FacetMaker& facets, const Cone& cone, bool inwards, int turn)
{
    const Frame frame = sector_frame(cone.sector, normalized(cone.ends[1] - cone.ends[0]));
    const int steps = steps_of(cone.sector, turn);
    const auto at = [&](int end, int step) {
        const double azimuth = azimuth_of(cone.sector, step, steps);
        return cone.ends[end] + (frame.x * std::cos(azimuth) + frame.y * std::sin(azimuth)) * cone.radii[end];
    };
    for (int step = 0; step < steps; ++step) {
        std::vector<Point> corners{at(0, step)};
        if (cone.radii[0] > 0)
            corners.push_back(at(0, step + 1));
        corners.push_back(at(1, step + 1));
        if (cone.radii[1] > 0)
            corners.push_back(at(1, step));
        add_facet(facets, std::move(corners), inwards);
    }
}

void add_faceted_ring(FacetMaker& facets, const Ring& ring, int turn)
{
    const Frame frame = sector_frame(ring.sector, ring.normal);
    const int steps = steps_of(ring.sector, turn);
    const auto at = [&](double radius, int step) {
        const double azimuth = azimuth_of(ring.sector, step, steps);
        return ring.centre + (frame.x * std::cos(azimuth) + frame.y * std::sin(azimuth)) * radius;
    };
    std::vector<Point> corners;
    for (int step = 0; step < steps; ++step)
        corners.push_back(at(ring.outer_radius, step));
    if (ring.inner_radius > 0 || !ring.sector.is_whole())
        corners.push_back(at(ring.outer_radius, steps));
    if (ring.inner_radius > 0)
        for (int step = steps; step >= 0; --step)
            corners.push_back(at(ring.inner_radius, step));
    else if (!ring.sector.is_whole())
        corners.push_back(ring.centre);
    facets.add(std::move(corners));
}

double greatest_stretch(const Affine& map) noexcept
{
    // The Frobenius norm bounds the greatest singular value from above.
    return std::sqrt(dot(map.x, map.x) + dot(map.y, map.y) + dot(map.z, map.z));
}

} // namespace

void add_facets(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
                const std::string& name, double tolerance, Report& report)
{
    FacetMaker facets(to, map, modifier, name);
    const double stretch = greatest_stretch(map);
    // A sphere bends both ways, and each way spends half of the tolerance.
    const auto turn = [&](double radius, double share) { return facets_of_turn(radius * stretch, tolerance * share); };
    if (surface.shape == Shape::ring) {
        const Ring& ring = from.rings[surface.index];
        add_faceted_ring(facets, ring, turn(ring.outer_radius, 1));
    } else if (surface.shape == Shape::sphere || surface.shape == Shape::bubble) {
        const Sphere& sphere = from.spheres[surface.index];
        add_faceted_sphere(facets, sphere, surface.shape == Shape::bubble, (turn(sphere.radius, 0.5) + 1) / 2 * 2);
    } else {
        const Cone& cone = from.cones[surface.index];
        const bool inwards = surface.shape == Shape::cup || surface.shape == Shape::tube;
        add_faceted_cone(facets, cone, inwards, turn(std::max(cone.radii[0], cone.radii[1]), 1));
    }
    const char* const what = sector_of(from, surface).is_whole()
                                 ? "round shape under a map that is no similarity"
                                 : "part of a round shape, which the text has no word for";
    report.add(Finding::approximated, name,
               what + std::string{": written as flat facets within "} + shortest(tolerance) + " m");
}

namespace {

/// True when the image is again a sphere, cone or ring; it is then added.
bool add_round(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
               const std::string& name)
{
    if (surface.shape == Shape::sphere || surface.shape == Shape::bubble) {
        const Sphere& sphere = from.spheres[surface.index];
        const double scale = similarity_scale(map, round_enough);
        if (scale > 0)
            to.add_sphere({map.point(sphere.centre), sphere.radius * scale}, surface.shape, modifier, name);
        return scale > 0;
    }
    if (surface.shape == Shape::ring) {
        const Ring& ring = from.rings[surface.index];
        const double scale = scale_across(map, ring.normal);
        const Direction normal = transform_normal(map, ring.normal);
        if (scale > 0)
            to.add_ring({map.point(ring.centre), normal, ring.inner_radius * scale, ring.outer_radius * scale,
                         image_of(ring.sector, ring.normal, map, normal)},
                        modifier, name);
        return scale > 0;
    }
    const Cone& cone = from.cones[surface.index];
    const Direction axis = normalized(cone.ends[1] - cone.ends[0]);
    const double scale = scale_across(map, axis);
    const Frame frame = frame_about(axis);
    const Vec3 image = map.vector(axis);
    if (!(scale > 0) || !perpendicular(image, map.vector(frame.x)) || !perpendicular(image, map.vector(frame.y)))
        return false;
    to.add_cone({{map.point(cone.ends[0]), map.point(cone.ends[1])},
                 {cone.radii[0] * scale, cone.radii[1] * scale},
                 image_of(cone.sector, axis, map, normalized(image))},
                surface.shape, modifier, name);
    return true;
}

std::shared_ptr<const Mesh> image_of(const std::shared_ptr<const Mesh>& mesh, const Affine& map)
{
    if (map == Affine{})
        return mesh;
    auto image = std::make_shared<Mesh>(*mesh);
    for (Point& point : image->points)
        point = map.point(point);
    for (Direction& normal : image->normals)
        normal = transform_normal(map, normal);
    if (map.determinant() < 0)
        for (std::size_t i = 0; i + 2 < image->triangles.size(); i += 3)
            std::swap(image->triangles[i + 1], image->triangles[i + 2]);
    return image;
}

void add_polygon_image(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
                       const std::string& name)
{
    const Polygon& polygon = from.polygons[surface.index];
    const auto first = static_cast<std::uint32_t>(to.points.size());
    for (std::uint32_t i = 0; i < polygon.count; ++i)
        to.points.push_back(map.point(from.points[polygon.first + i]));
    if (map.determinant() < 0)
        std::reverse(to.points.begin() + first, to.points.end());
    to.surfaces.push_back({Shape::polygon, static_cast<std::uint32_t>(to.polygons.size()), modifier, name});
    to.polygons.push_back({first, polygon.count});
}

} // namespace

void add_image(Part& to, const Part& from, const Surface& surface, const Affine& map, ModifierId modifier,
               const std::string& name, double chord_tolerance_m, Report& report)
{
    switch (surface.shape) {
    case Shape::polygon:
        add_polygon_image(to, from, surface, map, modifier, name);
        break;
    case Shape::mesh:
        to.add_mesh(image_of(from.meshes[surface.index], map), modifier, name);
        break;
    case Shape::source: {
        const DistantSource& source = from.sources[surface.index];
        to.add_source({normalized(map.vector(source.to_source)), source.full_angle_deg}, modifier, name);
        break;
    }
    case Shape::instance: {
        Instance instance = from.instances[surface.index];
        instance.to_parent = compose(map, instance.to_parent);
        to.add_instance(std::move(instance), name);
        break;
    }
    default:
        if (!add_round(to, from, surface, map, modifier, name))
            add_facets(to, from, surface, map, modifier, name, chord_tolerance_m, report);
    }
}

bool is_translation(const Affine& map) noexcept
{
    const Affine identity;
    return map.x == identity.x && map.y == identity.y && map.z == identity.z;
}

} // namespace lightwell::scene_text
