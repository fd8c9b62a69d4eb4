#include "engine/sources/local_source.h"

#include "engine/base/frame.h"
#include "materials/emission.h"

#include <algorithm>

namespace lightwell {
namespace {

/// More triangles than this are drawn by area: one solid angle for each would cost more than the noise it saves.
constexpr std::size_t most_spherical_triangles = 8;

struct PointOnSource {
    Point point;
    Direction normal; ///< front side
};

Vec3 corner(const FlatEmitter& e, std::size_t triangle, std::size_t i)
{
    return e.corners[3 * triangle + i];
}

Vec3 flat_normal(const FlatEmitter& e, std::size_t triangle)
{
    const Point& a = corner(e, triangle, 0);
    return normalized(cross(corner(e, triangle, 1) - a, corner(e, triangle, 2) - a));
}

bool by_solid_angle(const FlatEmitter& e)
{
    return e.rectangle || e.summed_area.size() <= most_spherical_triangles;
}

SphericalTriangle seen_triangle(const FlatEmitter& e, std::size_t i, const Point& from)
{
    return {from, corner(e, i, 0), corner(e, i, 1), corner(e, i, 2)};
}

SphericalRectangle seen_rectangle(const FlatEmitter& e, const Point& from)
{
    return {from, e.corners[0], e.corners[1] - e.corners[0], e.corners[2] - e.corners[0]};
}

/// Distance along a direction to the plane of a triangle.
double plane_distance(const FlatEmitter& e, std::size_t triangle, const Point& from, const Direction& direction)
{
    const Vec3 n = flat_normal(e, triangle);
    return dot(n, corner(e, triangle, 0) - from) / dot(n, direction);
}

struct FlatChoice {
    std::size_t triangle;
    double share; ///< of the whole solid angle
    double u;     ///< what is left of the random number
};

/// Chooses among triangles by solid angle.
FlatChoice choose(const FlatEmitter& e, const Point& from, double u)
{
    double parts[most_spherical_triangles] = {}, total = 0;
    const std::size_t count = e.summed_area.size();
    for (std::size_t i = 0; i < count; ++i)
        total += parts[i] = seen_triangle(e, i, from).solid_angle_sr();
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool last = i + 1 == count;
        if (parts[i] > 0 && (u * total < before + parts[i] || last))
            return {i, parts[i] / total, std::clamp((u * total - before) / parts[i], 0.0, 0x1.fffffffffffffp-1)};
        before += parts[i];
    }
    return {0, 0, u};
}

PointOnSource point_by_area(const FlatEmitter& e, UnitSquare u)
{
    const double wanted = u.u * e.summed_area.back();
    const auto at = static_cast<std::size_t>(std::upper_bound(e.summed_area.begin(), e.summed_area.end() - 1, wanted) -
                                             e.summed_area.begin());
    const double before = at == 0 ? 0 : e.summed_area[at - 1];
    const double left = std::clamp((wanted - before) / (e.summed_area[at] - before), 0.0, 0x1.fffffffffffffp-1);
    return {triangle_by_area(corner(e, at, 0), corner(e, at, 1), corner(e, at, 2), {left, u.v}), flat_normal(e, at)};
}

PointOnSource point_by_area(const RingEmitter& e, UnitSquare u)
{
    const Ring& ring = e.ring;
    const double inner = ring.inner_radius * ring.inner_radius, outer = ring.outer_radius * ring.outer_radius;
    const double r = std::sqrt(inner + u.u * (outer - inner)), angle = 2 * pi * u.v;
    const Frame frame = frame_about(ring.normal);
    return {ring.centre + frame.x * (r * std::cos(angle)) + frame.y * (r * std::sin(angle)), ring.normal};
}

PointOnSource point_by_area(const ConeEmitter& e, UnitSquare u)
{
    const Cone& cone = e.cone;
    const Vec3 axis = cone.ends[1] - cone.ends[0];
    const double height = length(axis), r0 = cone.radii[0], dr = cone.radii[1] - r0;
    // The radius grows linearly, so the area up to s grows as r0 s + dr s^2 / 2.
    const double whole = r0 + 0.5 * dr;
    const double s = std::fabs(dr) < 1e-9 * whole
                         ? u.u
                         : 2 * u.u * whole / (r0 + std::sqrt(std::fmax(0, r0 * r0 + 2 * dr * u.u * whole)));
    const Frame frame = frame_about(axis / height);
    const double angle = 2 * pi * u.v;
    const Vec3 across = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    const Direction normal = normalized(across * height - frame.z * dr);
    return {cone.ends[0] + axis * s + across * (r0 + dr * s), e.inwards ? -normal : normal};
}

/// density per area -> density per solid angle.
double per_solid_angle(double area_m2, double distance_m, double cosine)
{
    return cosine > 0 ? distance_m * distance_m / (area_m2 * cosine) : 0;
}

} // namespace

LocalSource::LocalSource(Shape shape, const Material& material)
    : shape_(std::move(shape)), material_(&material), strength_(photopic(emitted_radiance(material)))
{
    Box box;
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_)) {
        for (const Point& p : flat->corners)
            box.extend(p);
        if (flat->rectangle)
            box.extend(flat->corners[1] + flat->corners[2] - flat->corners[0]);
        area_m2_ = flat->summed_area.back();
        facing_ = flat_normal(*flat, 0);
        flat_ = true;
        for (std::size_t i = 1; !flat->rectangle && i < flat->summed_area.size(); ++i)
            flat_ = flat_ && dot(flat_normal(*flat, i), facing_) > 0.999999;
    } else if (const auto* ball = std::get_if<SphereEmitter>(&shape_)) {
        const Vec3 reach = Vec3{1, 1, 1} * (ball->sphere.radius / std::sqrt(3.0));
        box.extend(ball->sphere.centre - reach);
        box.extend(ball->sphere.centre + reach);
        area_m2_ = 4 * pi * ball->sphere.radius * ball->sphere.radius;
    } else if (const auto* ring = std::get_if<RingEmitter>(&shape_)) {
        const Ring& r = ring->ring;
        const Vec3 reach = Vec3{1, 1, 1} * (r.outer_radius / std::sqrt(3.0));
        box.extend(r.centre - reach);
        box.extend(r.centre + reach);
        area_m2_ = pi * (r.outer_radius - r.inner_radius) * (r.outer_radius + r.inner_radius);
        facing_ = r.normal;
        flat_ = true;
    } else if (const auto* cone = std::get_if<ConeEmitter>(&shape_)) {
        const Cone& c = cone->cone;
        const double r = std::fmax(c.radii[0], c.radii[1]);
        for (const Point& end : c.ends) {
            box.extend(end - Vec3{r, r, r});
            box.extend(end + Vec3{r, r, r});
        }
        area_m2_ = pi * (c.radii[0] + c.radii[1]) * std::hypot(length(c.ends[1] - c.ends[0]), c.radii[1] - c.radii[0]);
    }
    centre_ = box.centre();
    radius_m_ = 0.5 * box.diagonal();
}

double LocalSource::potential(const Point& at, const Direction& normal, bool transmits) const noexcept
{
    const Vec3 to_centre = centre_ - at;
    const double squared = dot(to_centre, to_centre), distance = std::sqrt(squared);
    double leaving = 1;
    if (flat_) {
        const double height = -dot(facing_, to_centre);
        if (height <= 0)
            return 0;
        leaving = 0.1 + 0.9 * height / std::fmax(distance, radius_m_); // the floor keeps a near, wide source findable
    }
    const double above = dot(normal, to_centre);
    if (!transmits && above + radius_m_ <= 0)
        return 0;
    const double arriving = std::fmin(1, (std::fabs(above) + radius_m_) / std::fmax(distance, radius_m_));
    // Not above what a source that fills the hemisphere would give.
    return strength_ * std::fmin(pi, arriving * leaving * area_m2_ / std::fmax(squared, 1e-300));
}

SourceSample LocalSource::sample(const Point& from, UnitSquare u) const noexcept
{
    SourceSample s;
    double cosine = 1; // at the source; by solid angle only its sign counts
    const auto by_area = [&](const PointOnSource& p) {
        const Vec3 way = p.point - from;
        s.distance_m = length(way);
        s.to_light = normalized(way);
        cosine = -dot(p.normal, s.to_light);
        s.density_per_sr = per_solid_angle(area_m2_, s.distance_m, cosine);
    };
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_)) {
        if (by_solid_angle(*flat)) {
            const FlatChoice pick = flat->rectangle ? FlatChoice{0, 1, u.u} : choose(*flat, from, u.u);
            const SampledDirection d = flat->rectangle
                                           ? seen_rectangle(*flat, from).sample(u)
                                           : seen_triangle(*flat, pick.triangle, from).sample({pick.u, u.v});
            s.to_light = d.direction;
            s.density_per_sr = d.density_per_sr * pick.share;
            s.distance_m = plane_distance(*flat, pick.triangle, from, d.direction);
            cosine = -dot(flat_normal(*flat, pick.triangle), d.direction);
        } else {
            by_area(point_by_area(*flat, u));
        }
    } else if (const auto* ball = std::get_if<SphereEmitter>(&shape_)) {
        const SampledDirection d = sphere_seen_from(from, centre_, ball->sphere.radius, u);
        s.to_light = d.direction;
        s.density_per_sr = d.density_per_sr;
        // Nearest point of the ball along the direction; its foot point where rounding lets the ray miss.
        const Vec3 to_centre = centre_ - from;
        const double along = dot(to_centre, d.direction);
        const Vec3 foot = d.direction * along - to_centre;
        const double half = std::sqrt(std::fmax(0, ball->sphere.radius * ball->sphere.radius - dot(foot, foot)));
        s.distance_m = along - half;
        if (!(s.distance_m > 0))
            s.density_per_sr = 0; // inside: the front faces away
    } else if (const auto* ring = std::get_if<RingEmitter>(&shape_)) {
        by_area(point_by_area(*ring, u));
    } else if (const auto* cone = std::get_if<ConeEmitter>(&shape_)) {
        by_area(point_by_area(*cone, u));
    }
    if (!(s.density_per_sr > 0) || !(cosine > 0) || !(s.distance_m > 0)) {
        s.density_per_sr = 0;
        return s;
    }
    s.radiance = emitted_towards(*material_, cosine, -s.to_light);
    return s;
}

double LocalSource::density_per_sr(const Point& from, const Direction& direction, const Hit& hit) const noexcept
{
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_); flat && by_solid_angle(*flat)) {
        if (flat->rectangle)
            return seen_rectangle(*flat, from).density_per_sr(direction);
        double total = 0;
        for (std::size_t i = 0; i < flat->summed_area.size(); ++i)
            total += seen_triangle(*flat, i, from).solid_angle_sr();
        return total > 0 ? 1 / total : 0;
    }
    if (std::holds_alternative<SphereEmitter>(shape_)) {
        const double solid_angle = sphere_solid_angle_sr(from, centre_, std::get<SphereEmitter>(shape_).sphere.radius);
        return solid_angle > 0 ? 1 / solid_angle : 0;
    }
    return per_solid_angle(area_m2_, length(hit.position - from), std::fabs(dot(hit.normal, direction)));
}

} // namespace lightwell
