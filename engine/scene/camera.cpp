#include "engine/base/errors.h"
#include "engine/sampling/warps.h"
#include "engine/scene/view.h"

#include <fmt/format.h>

namespace lightwell {
namespace {

/// Half a picture's side in the picture plane of its projection, from its angle in degrees (or its metres).
struct Extents {
    double width, height;
};

Extents half_extents(const View& view)
{
    const double h = 0.5 * view.horizontal * radians_per_degree, v = 0.5 * view.vertical * radians_per_degree;
    switch (view.kind) {
    case View::Kind::perspective:
        return {std::tan(h), std::tan(v)};
    case View::Kind::parallel:
        return {0.5 * view.horizontal, 0.5 * view.vertical};
    case View::Kind::cylindrical:
        return {h, std::tan(v)};
    case View::Kind::hemispherical:
        return {std::sin(h), std::sin(v)};
    case View::Kind::angular:
        return {h, v};
    case View::Kind::planisphere:
        return {std::tan(0.5 * h), std::tan(0.5 * v)};
    }
    return {1, 1};
}

struct Limits {
    double horizontal, vertical;
};

/// Angles stay below these; those that may be reached exactly have a hair added.
Limits limits_of(View::Kind kind)
{
    constexpr double half_turn = 180, turn = 360, hair = 1e-7;
    switch (kind) {
    case View::Kind::perspective:
        return {half_turn, half_turn};
    case View::Kind::parallel:
        return {infinity, infinity};
    case View::Kind::cylindrical:
        return {turn + hair, half_turn};
    case View::Kind::hemispherical:
        return {half_turn + hair, half_turn + hair};
    case View::Kind::angular:
        return {turn + hair, turn + hair};
    case View::Kind::planisphere:
        return {turn, turn};
    }
    return {0, 0};
}

void check_extent(const View& view, double full, double limit, const char* word)
{
    if (!(full > 0 && full < limit))
        throw InputError{"view " + view.name, fmt::format("{} is {}, expected between 0 and {:.6g}", word, full, limit),
                         "give a smaller field of view or another view type"};
}

void check_numbers(const View& view)
{
    const std::string place = "view " + view.name;
    for (const double number : {view.shift, view.lift, view.fore_m, view.aft_m, view.lens_m, view.focus_m})
        if (!std::isfinite(number))
            throw InputError{place, "shift, lift, a distance or the lens is not finite", "check the view's words"};
    if (!is_finite(view.position) || !is_finite(view.direction) || !is_finite(view.up))
        throw InputError{place, "position, direction or up is not finite", "check the view's words"};
    if (!(view.aft_m == 0 || view.aft_m > std::fmax(view.fore_m, 0)))
        throw InputError{place,
                         fmt::format("the aft clipping distance is {} and the fore one {}", view.aft_m, view.fore_m),
                         "give -va more than -vo, or 0 for none"};
    if (!(view.lens_m >= 0 && view.focus_m >= 0))
        throw InputError{place, fmt::format("the lens is {} m wide, in focus at {} m", view.lens_m, view.focus_m),
                         "give both zero or more"};
}

} // namespace

Camera::Camera(const View& view) : view_(view)
{
    const std::string place = "view " + view.name;
    check_numbers(view);
    const Limits limits = limits_of(view.kind);
    check_extent(view, view.horizontal, limits.horizontal, "-vh");
    check_extent(view, view.vertical, limits.vertical, "-vv");
    focus_m_ = view.focus_m > 0 ? view.focus_m : length(view.direction);
    view_.direction = normalized(view.direction);
    if (length(view_.direction) == 0)
        throw InputError{place, "the view direction is zero", "give -vd a direction"};
    right_ = cross(view_.direction, normalized(view.up));
    // Below this sine the digits of the up vector no longer tell where up is.
    constexpr double smallest_sine = 1e-9;
    if (!(length(right_) > smallest_sine))
        throw InputError{
            place, fmt::format("up ({}, {}, {}) is parallel to the view direction", view.up.x, view.up.y, view.up.z),
            "give -vu another direction, e.g. 0 1 0 when looking straight down"};
    right_ = normalized(right_);
    up_ = cross(right_, view_.direction);
    const Extents half = half_extents(view);
    half_width_ = half.width;
    half_height_ = half.height;
}

/// @param across, upwards  in the picture plane of the projection
bool Camera::sight(double across, double upwards, Sight& sight) const noexcept
{
    const Vec3 aside = right_ * across + up_ * upwards;
    const double squared = across * across + upwards * upwards;
    sight = {view_.position, view_.direction, view_.direction};
    switch (view_.kind) {
    case View::Kind::perspective:
        sight.way = normalized(view_.direction + aside);
        return true;
    case View::Kind::parallel:
        sight.origin += aside;
        return true;
    case View::Kind::cylindrical:
        sight.outward = view_.direction * std::cos(across) + right_ * std::sin(across);
        sight.way = normalized(sight.outward + up_ * upwards);
        return true;
    case View::Kind::hemispherical:
        if (squared > 1)
            return false;
        sight.way = normalized(view_.direction * std::sqrt(1 - squared) + aside);
        break;
    case View::Kind::angular: {
        const double angle = std::sqrt(squared);
        if (angle > pi)
            return false;
        if (angle > 0)
            sight.way = normalized(view_.direction * std::cos(angle) + aside * (std::sin(angle) / angle));
        break;
    }
    case View::Kind::planisphere: // seen from the point of the unit sphere opposite to the view direction
        sight.way = normalized(view_.direction * (1 - squared) + aside * 2);
        break;
    }
    sight.outward = sight.way;
    return true;
}

void Camera::move_into_lens(UnitSquare lens, Sight& sight) const noexcept
{
    Direction right = right_, up = up_;
    if (view_.kind != View::Kind::perspective && view_.kind != View::Kind::parallel) {
        // Across the ray: the axis of the picture that is less along it, made perpendicular.
        const Direction& guide = std::fabs(dot(sight.way, up_)) < std::fabs(dot(sight.way, right_)) ? up_ : right_;
        right = normalized(cross(sight.way, guide));
        up = cross(right, sight.way);
    }
    const DiscPoint point = uniform_disc(lens);
    const Vec3 aside = (right * point.x + up * point.y) * (0.5 * view_.lens_m);
    const double to_focus_m = focus_m_ / dot(sight.way, sight.outward);
    sight.way = normalized(sight.way * to_focus_m - aside);
    sight.origin += aside;
}

bool Camera::ray(double x, double y, UnitSquare lens, ViewRay& ray) const noexcept
{
    Sight sight;
    if (!this->sight(2 * (x - 0.5 + view_.shift) * half_width_, 2 * (y - 0.5 + view_.lift) * half_height_, sight))
        return false;
    if (has_lens())
        move_into_lens(lens, sight);
    const double outward = dot(sight.way, sight.outward);
    ray.origin = sight.origin + sight.way * (view_.fore_m / outward);
    ray.direction = sight.way;
    ray.reach_m = view_.aft_m > 0 ? (view_.aft_m - view_.fore_m) / outward : infinity;
    return true;
}

double Camera::pixel_solid_angle_sr(double x, double y, int width, int height) const noexcept
{
    const double across = 2 * (x - 0.5 + view_.shift) * half_width_,
                 upwards = 2 * (y - 0.5 + view_.lift) * half_height_;
    const double element = 4 * half_width_ * half_height_ / (static_cast<double>(width) * height);
    const double squared = across * across + upwards * upwards;
    switch (view_.kind) {
    case View::Kind::perspective:
        return element / std::pow(1 + squared, 1.5);
    case View::Kind::parallel:
        return 0;
    case View::Kind::cylindrical:
        return std::fabs(across) > pi ? 0 : element / std::pow(1 + upwards * upwards, 1.5);
    case View::Kind::hemispherical:
        return squared >= 1 ? 0 : element / std::sqrt(1 - squared);
    case View::Kind::angular: {
        const double angle = std::sqrt(squared);
        return angle > pi ? 0 : angle > 0 ? element * std::sin(angle) / angle : element;
    }
    case View::Kind::planisphere:
        return 4 * element / ((1 + squared) * (1 + squared));
    }
    return 0;
}

} // namespace lightwell
