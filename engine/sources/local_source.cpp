#include "engine/sources/local_source.h"

#include "engine/base/frame.h"
#include "engine/sources/unoccluded.h"
#include "engine/sources/weighted_choice.h"
#include "materials/emission.h"

#include <algorithm>

namespace lightwell {
namespace {

/// More triangles than this are drawn by area: one solid angle for each would cost more than the noise it saves.
constexpr std::size_t most_spherical_triangles = 8;
/// Flat meshes of more triangles than this have no closed form: it would take longer than shadow rays.
constexpr std::size_t most_summed_triangles = 16;
/// Distance over radius from which on a source counts as a point: its irradiance is then right to 1e-8, where the sum
/// over a polygon's edges begins to lose as many digits.
constexpr double far_away = 1e4;

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

/// Seen smaller than this (size over distance), solid angle and area are nearly proportional over a flat piece, and a
/// sample by area is several times cheaper.
constexpr double least_spherical_size = 0.1;

bool by_solid_angle(const FlatEmitter& e, double seen_size)
{
    return seen_size >= least_spherical_size && (e.rectangle || e.summed_area.size() <= most_spherical_triangles);
}

SphericalTriangle seen_triangle(const FlatEmitter& e, std::size_t i, const Point& from)
{
    return {from, corner(e, i, 0), corner(e, i, 1), corner(e, i, 2)};
}

SphericalRectangle seen_rectangle(const FlatEmitter& e, const Point& from)
{
    return {from, e.corners[0], e.corners[1] - e.corners[0], e.corners[2] - e.corners[0]};
}

/// Distance along a direction to a plane.
double plane_distance(const Direction& normal, const Vec3& to_corner, const Direction& direction)
{
    return dot(normal, to_corner) / dot(normal, direction);
}

/// Chooses among triangles by solid angle.
WeightedChoice choose_triangle(const FlatEmitter& e, const Point& from, double u)
{
    double summed[most_spherical_triangles], total = 0;
    const std::size_t count = e.summed_area.size();
    for (std::size_t i = 0; i < count; ++i)
        summed[i] = total += seen_triangle(e, i, from).solid_angle_sr();
    return choose(summed, count, u);
}

PointOnSource point_by_area(const FlatEmitter& e, UnitSquare u)
{
    if (e.rectangle)
        return {corner(e, 0, 0) + (corner(e, 0, 1) - corner(e, 0, 0)) * u.u + (corner(e, 0, 2) - corner(e, 0, 0)) * u.v,
                flat_normal(e, 0)};
    const auto [at, share, left] = choose(e.summed_area.data(), e.summed_area.size(), u.u);
    return {triangle_by_area(corner(e, at, 0), corner(e, at, 1), corner(e, at, 2), {left, u.v}), flat_normal(e, at)};
}

PointOnSource point_by_area(const RingEmitter& e, const Frame& frame, UnitSquare u)
{
    const Ring& ring = e.ring;
    // Keeps neighbours together, which a straight edge of a shadow rewards.
    if (ring.inner_radius == 0 && ring.sector.is_whole()) {
        const DiscPoint p = uniform_disc(u);
        return {ring.centre + (frame.x * p.x + frame.y * p.y) * ring.outer_radius, ring.normal};
    }
    const double inner = ring.inner_radius * ring.inner_radius, outer = ring.outer_radius * ring.outer_radius;
    const double r = std::sqrt(inner + u.u * (outer - inner)), angle = ring.sector.sweep_rad * u.v;
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
    const Frame frame = sector_frame(cone.sector, axis / height);
    const double angle = cone.sector.sweep_rad * u.v;
    const Vec3 across = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    const Direction normal = normalized(across * height - frame.z * dr);
    return {cone.ends[0] + axis * s + across * (r0 + dr * s), e.inwards ? -normal : normal};
}

/// density per area -> density per solid angle.
double per_solid_angle(double area_m2, double distance_m, double cosine)
{
    return cosine > 0 ? distance_m * distance_m / (area_m2 * cosine) : 0;
}

SourceSample sphere_sample(const Sphere& sphere, const Point& from, UnitSquare u)
{
    const SampledDirection d = sphere_seen_from(from, sphere.centre, sphere.radius, u);
    // Nearest point of the ball along the direction; its foot point where rounding lets the ray miss.
    const Vec3 to_centre = sphere.centre - from;
    const double along = dot(to_centre, d.direction);
    const Vec3 foot = d.direction * along - to_centre;
    const double half = std::sqrt(std::fmax(0, sphere.radius * sphere.radius - dot(foot, foot)));
    // From inside, where the distance comes out negative, the front faces away.
    return {d.direction, along - half, along - half > 0 ? d.density_per_sr : 0, {}};
}

} // namespace

LocalSource::LocalSource(Shape shape, const Material& material, VariedLight varied)
    : shape_(std::move(shape)), material_(&material), varied_(std::move(varied)), radiance_(emitted_radiance(material)),
      strength_(photopic(radiance_))
{
    Box& box = box_;
    if ((beam_ = std::get_if<Spotlight>(&material)) != nullptr) {
        aim_ = normalized(beam_->aim);
        half_beam_rad_ = 0.5 * beam_->full_angle_deg * radians_per_degree;
        cos_half_beam_ = std::cos(half_beam_rad_);
        sin_half_beam_ = std::sin(half_beam_rad_);
    }
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
        if (r.sector.is_whole()) {
            const Vec3 reach = Vec3{1, 1, 1} * (r.outer_radius / std::sqrt(3.0));
            box.extend(r.centre - reach);
            box.extend(r.centre + reach);
        } else {
            extend_by_arc(box, r.centre, r.normal, r.outer_radius, r.sector);
            extend_by_arc(box, r.centre, r.normal, r.inner_radius, r.sector);
        }
        area_m2_ = pi * (r.outer_radius - r.inner_radius) * (r.outer_radius + r.inner_radius) * r.sector.share();
        facing_ = r.normal;
        flat_ = true;
    } else if (const auto* cone = std::get_if<ConeEmitter>(&shape_)) {
        const Cone& c = cone->cone;
        const double r = std::fmax(c.radii[0], c.radii[1]);
        const Vec3 axis = c.ends[1] - c.ends[0];
        for (int end = 0; end < 2; ++end) {
            if (!c.sector.is_whole()) {
                extend_by_arc(box, c.ends[end], normalized(axis), c.radii[end], c.sector);
                continue;
            }
            box.extend(c.ends[end] - Vec3{r, r, r});
            box.extend(c.ends[end] + Vec3{r, r, r});
        }
        area_m2_ =
            pi * (c.radii[0] + c.radii[1]) * std::hypot(length(axis), c.radii[1] - c.radii[0]) * c.sector.share();
    }
    const auto* flat_shape = std::get_if<FlatEmitter>(&shape_);
    closed_form_ = flat_shape != nullptr
                       ? flat_ && (flat_shape->rectangle || flat_shape->summed_area.size() <= most_summed_triangles)
                       : !std::holds_alternative<ConeEmitter>(shape_) && is_whole_ring();
    centre_ = box.centre();
    radius_m_ = 0.5 * box.diagonal();
    if (varied_.varied != nullptr)
        strength_ = mean_strength();
}

Spectrum LocalSource::varied_radiance(const Point& from, const Direction& to_light, double distance_m,
                                      const Direction& normal) const noexcept
{
    PatternPlace place;
    place.position = from + to_light * distance_m;
    place.direction = to_light;
    place.normal = normal;
    place.distance_m = distance_m;
    place.to_part = varied_.to_part ? &*varied_.to_part : nullptr;
    SeenMaterial seen;
    varied_.varied->look(varied_.modifier, place, seen);
    return seen.material != nullptr ? emitted_towards(*seen.material, -dot(normal, to_light), -to_light) : Spectrum{};
}

/// Photopic radiance of a source with patterns, about: what it sends to a few places all around.
double LocalSource::mean_strength() const noexcept
{
    constexpr int places = 64, bits = 6; // spread evenly over directions and over the source
    double sum = 0;
    int counted = 0;
    for (int i = 0; i < places; ++i) {
        const double u = (i + 0.5) / places;
        double v = 0;
        for (int bit = 0; bit < bits; ++bit)
            v += (i >> bit & 1) * std::ldexp(1.0, -1 - bit);
        const double z = 2 * u - 1, r = std::sqrt(1 - z * z), away = 10 * radius_m_;
        const Point from = centre_ + Vec3{r * std::cos(2 * pi * v), r * std::sin(2 * pi * v), z} * away;
        const SourceSample s = sample(from, {v, u});
        if (!(s.density_per_sr > 0))
            continue;
        sum += photopic(s.radiance);
        ++counted;
    }
    // Never nothing: a pattern may be bright just where no place was tried.
    constexpr double least_share = 1e-3;
    return std::fmax(counted > 0 ? sum / counted : 0, least_share * strength_);
}

Spectrum LocalSource::typical_radiance(const Point& towards) const noexcept
{
    if (varied_.varied == nullptr)
        return radiance_;
    constexpr double least_share = 0.1; // of the mean: the middle may be dark where the rest is bright
    const Vec3 way = centre_ - towards;
    const double distance = length(way);
    const Direction to_light = distance > 0 ? way / distance : -facing_;
    const Spectrum middle = varied_radiance(towards, to_light, distance, flat_ ? facing_ : -to_light);
    const double level = photopic(middle), least = least_share * strength_;
    return level >= least ? middle : middle + Spectrum::grey(least - level);
}

double LocalSource::potential(const Point& at, const Direction& normal, bool transmits) const noexcept
{
    const Vec3 to_centre = centre_ - at;
    const double squared = dot(to_centre, to_centre), distance = std::sqrt(squared);
    if (beam_ != nullptr && !in_beam(to_centre, distance, 1))
        return 0;
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

/// Whether -to_centre lies in the beam when its cone is made wider, or narrower, by the size of the source.
/// @param widened  1: some point of the source may send its beam there; -1: every point does
bool LocalSource::in_beam(const Vec3& to_centre, double distance, int widened) const noexcept
{
    if (!(distance > radius_m_))
        return widened > 0;
    const double sine = widened * radius_m_ / distance, cosine = std::sqrt(1 - sine * sine);
    const double sine_sum = sin_half_beam_ * cosine + cos_half_beam_ * sine;
    const double least = cos_half_beam_ * cosine - sin_half_beam_ * sine;
    if (sine_sum <= 0) // beyond pi, or below 0
        return widened > 0;
    constexpr double rounding = 1e-12;
    return -dot(aim_, to_centre) >= distance * (least - widened * rounding);
}

bool LocalSource::crosses_horizon(const Point& at, const Direction& normal) const noexcept
{
    const double middle = dot(normal, centre_ - at);
    if (std::fabs(middle) > radius_m_)
        return false;
    if (const auto* ball = std::get_if<SphereEmitter>(&shape_))
        return std::fabs(middle) < ball->sphere.radius;
    if (const auto* ring = std::get_if<RingEmitter>(&shape_); ring && is_whole_ring()) {
        const double sine = std::sqrt(std::fmax(0, 1 - std::pow(dot(normal, facing_), 2)));
        return std::fabs(middle) < ring->ring.outer_radius * sine;
    }
    const auto* flat = std::get_if<FlatEmitter>(&shape_);
    if (flat == nullptr)
        return true;
    double low = middle, high = middle;
    const auto reach = [&](const Point& corner) {
        low = std::fmin(low, dot(normal, corner - at));
        high = std::fmax(high, dot(normal, corner - at));
    };
    for (const Point& corner : flat->corners)
        reach(corner);
    if (flat->rectangle)
        reach(flat->corners[1] + flat->corners[2] - flat->corners[0]);
    return low < 0 && high > 0;
}

std::optional<double> LocalSource::projected_solid_angle_sr(const Point& at, const Direction& normal) const noexcept
{
    if (beam_ != nullptr || !closed_form_)
        return {};
    const Vec3 to_centre = centre_ - at;
    if (flat_ && dot(facing_, to_centre) >= 0)
        return 0.0;
    if (const auto* ball = std::get_if<SphereEmitter>(&shape_))
        return sphere_irradiance(to_centre, ball->sphere.radius, normal);
    if (const auto* ring = std::get_if<RingEmitter>(&shape_)) {
        const double sine = std::sqrt(std::fmax(0, 1 - std::pow(dot(normal, facing_), 2)));
        if (dot(normal, to_centre) < ring->ring.outer_radius * sine)
            return {};
        return disc_irradiance(to_centre, facing_, ring->ring.outer_radius, normal) -
               disc_irradiance(to_centre, facing_, ring->ring.inner_radius, normal);
    }
    const double distance = length(to_centre);
    if (distance > far_away * radius_m_ && dot(normal, to_centre) > radius_m_)
        return middle_solid_angle_sr(at, normal);
    const auto& flat = std::get<FlatEmitter>(shape_);
    const Vec3* c = flat.corners.data();
    if (flat.rectangle) {
        const Vec3 around[4] = {c[0] - at, c[1] - at, c[1] + c[2] - c[0] - at, c[2] - at};
        return polygon_irradiance(around, 4, normal);
    }
    double sum = 0;
    for (std::size_t i = 0; i < flat.corners.size(); i += 3) {
        const Vec3 around[3] = {c[i] - at, c[i + 1] - at, c[i + 2] - at};
        sum += polygon_irradiance(around, 3, normal);
    }
    return sum;
}

double LocalSource::middle_solid_angle_sr(const Point& at, const Direction& normal) const noexcept
{
    const Vec3 to_centre = centre_ - at;
    const double squared = std::fmax(dot(to_centre, to_centre), 1e-300), distance = std::sqrt(squared);
    const double arriving = std::fmax(0, dot(normal, to_centre) / distance);
    if (beam_ != nullptr && !(dot(aim_, to_centre) < -distance * cos_half_beam_))
        return 0;
    // All but flat shapes are taken for round ones, which show a quarter of their surface to every side.
    const double shown = flat_ ? std::fmax(0, -dot(facing_, to_centre) / distance) : 0.25;
    return std::fmin(pi, arriving * shown * area_m2_ / squared) * beam_share(*material_, distance);
}

double LocalSource::seen_size(const Point& at) const noexcept
{
    return 2 * radius_m_ / std::fmax(length(centre_ - at) - radius_m_, radius_m_);
}

LocalSource::Reach LocalSource::reach() const noexcept
{
    // A beam leaves about its aim; a flat shape's half space holds it too, but one cone a lamp is enough.
    const bool narrow = beam_ != nullptr && (!flat_ || half_beam_rad_ < pi / 2);
    Box box = box_;
    box.extend(centre_ - Vec3{1, 1, 1} * (round() ? radius_m_ : 0));
    box.extend(centre_ + Vec3{1, 1, 1} * (round() ? radius_m_ : 0));
    return {box, narrow ? aim_ : facing_, narrow ? half_beam_rad_ : flat_ ? pi / 2 : pi, strength_ * area_m2_};
}

/// How the source is seen from one point, worked out once for all its samples.
struct LocalSource::Seen {
    std::optional<SphericalRectangle> rectangle;
    Frame frame;             ///< of flat shapes
    double size = 0;         ///< over distance
    bool whole_beam = false; ///< no point of the source lies outside of its beam
};

SourceSample LocalSource::sample(const Point& from, UnitSquare u) const noexcept
{
    SourceSample s;
    sample(from, &u, 1, &s);
    return s;
}

void LocalSource::sample(const Point& from, const UnitSquare* u, int count, SourceSample* samples) const noexcept
{
    Seen seen;
    if (flat_)
        seen.frame =
            is_whole_ring() ? frame_about(facing_) : sector_frame(std::get<RingEmitter>(shape_).ring.sector, facing_);
    seen.size = seen_size(from);
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_);
        flat != nullptr && flat->rectangle && by_solid_angle(*flat, seen.size))
        seen.rectangle.emplace(seen_rectangle(*flat, from));
    seen.whole_beam = beam_ == nullptr || in_beam(centre_ - from, length(centre_ - from), -1);
    for (int i = 0; i < count; ++i)
        samples[i] = sample_seen(seen, from, u[i]);
}

SourceSample LocalSource::sample_seen(const Seen& seen, const Point& from, UnitSquare u) const noexcept
{
    SourceSample s;
    double cosine = 1; // at the source; by solid angle only its sign counts
    Direction front = facing_;
    const auto by_area = [&](const PointOnSource& p) {
        const Vec3 way = p.point - from;
        s.distance_m = length(way);
        s.to_light = way / s.distance_m;
        cosine = -dot(p.normal, s.to_light);
        front = p.normal;
        s.density_per_sr = per_solid_angle(area_m2_, s.distance_m, cosine);
    };
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_)) {
        if (seen.rectangle) {
            const SampledDirection d = seen.rectangle->sample(u);
            s = {d.direction, plane_distance(facing_, corner(*flat, 0, 0) - from, d.direction), d.density_per_sr, {}};
            cosine = -dot(facing_, d.direction);
        } else if (!flat->rectangle && by_solid_angle(*flat, seen.size)) {
            const WeightedChoice pick = choose_triangle(*flat, from, u.u);
            const SampledDirection d = seen_triangle(*flat, pick.index, from).sample({pick.left, u.v});
            const Direction normal = flat_normal(*flat, pick.index);
            s = {d.direction,
                 plane_distance(normal, corner(*flat, pick.index, 0) - from, d.direction),
                 d.density_per_sr * pick.share,
                 {}};
            cosine = -dot(normal, d.direction);
            front = normal;
        } else {
            by_area(point_by_area(*flat, u));
        }
    } else if (const auto* ball = std::get_if<SphereEmitter>(&shape_)) {
        s = sphere_sample(ball->sphere, from, u);
        if (varied_.varied != nullptr)
            front = normalized(from + s.to_light * s.distance_m - ball->sphere.centre);
    } else if (const auto* ring = std::get_if<RingEmitter>(&shape_)) {
        by_area(point_by_area(*ring, seen.frame, u));
    } else if (const auto* cone = std::get_if<ConeEmitter>(&shape_)) {
        by_area(point_by_area(*cone, u));
    }
    if (!(s.density_per_sr > 0) || !(cosine > 0) || !(s.distance_m > 0)) {
        s.density_per_sr = 0;
        return s;
    }
    if (varied_.varied != nullptr)
        s.radiance = varied_radiance(from, s.to_light, s.distance_m, front) * beam_share(*material_, s.distance_m);
    else if (beam_ == nullptr)
        s.radiance = radiance_;
    else if (seen.whole_beam || !emitted_towards(*material_, cosine, -s.to_light).is_black())
        s.radiance = radiance_ * beam_share(*material_, s.distance_m);
    return s;
}

double LocalSource::density_per_sr(const Point& from, const Direction& direction, const Hit& hit) const noexcept
{
    if (const auto* flat = std::get_if<FlatEmitter>(&shape_); flat && by_solid_angle(*flat, seen_size(from))) {
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
