#include "engine/scene/view.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <vector>

namespace lightwell {
namespace {

double half_extent(View::Kind kind, double full)
{
    switch (kind) {
    case View::Kind::perspective:
        return std::tan(0.5 * full * radians_per_degree);
    case View::Kind::hemispherical:
        return std::sin(0.5 * full * radians_per_degree);
    case View::Kind::angular:
        return 0.5 * full * radians_per_degree;
    case View::Kind::parallel:
        return 0.5 * full;
    }
    return 0;
}

void check_extent(const View& view, double full, const char* word)
{
    const double limit = view.kind == View::Kind::perspective     ? 180
                         : view.kind == View::Kind::hemispherical ? 180.0000001
                         : view.kind == View::Kind::angular       ? 360.0000001
                                                                  : infinity;
    if (!(full > 0 && full < limit))
        throw InputError{"view " + view.name, fmt::format("{} is {}, expected between 0 and {}", word, full, limit),
                         "give a smaller field of view or another view type"};
}

} // namespace

Camera::Camera(const View& view) : view_(view)
{
    const std::string place = "view " + view.name;
    if (!is_finite(view.position) || !is_finite(view.direction) || !is_finite(view.up) || !std::isfinite(view.shift) ||
        !std::isfinite(view.lift) || !(view.fore_m >= 0) || !(view.aft_m >= 0) ||
        (view.aft_m > 0 && view.aft_m <= view.fore_m))
        throw InputError{place, "a number is not finite, or the clipping distances are not 0 <= fore < aft",
                         "check the view's words"};
    check_extent(view, view.horizontal, "-vh");
    check_extent(view, view.vertical, "-vv");
    view_.direction = normalized(view.direction);
    if (length(view_.direction) == 0)
        throw InputError{place, "the view direction is zero", "give -vd a direction"};
    const Vec3 right = cross(view_.direction, normalized(view.up));
    // Below this sine the digits of the up vector no longer tell where up is.
    constexpr double smallest_sine = 1e-9;
    if (!(length(right) > smallest_sine))
        throw InputError{
            place, fmt::format("up ({}, {}, {}) is parallel to the view direction", view.up.x, view.up.y, view.up.z),
            "give -vu another direction, e.g. 0 1 0 when looking straight down"};
    const double width = half_extent(view.kind, view.horizontal), height = half_extent(view.kind, view.vertical);
    const Direction unit_right = normalized(right);
    right_ = unit_right * width;
    up_ = cross(unit_right, view_.direction) * height;
    aspect_ = width / height;
}

bool Camera::ray(double x, double y, ViewRay& ray) const noexcept
{
    const double sx = 2 * (x - 0.5 + view_.shift), sy = 2 * (y - 0.5 + view_.lift);
    ray.origin = view_.position;
    ray.direction = view_.direction;
    const Vec3 aside = right_ * sx + up_ * sy;
    switch (view_.kind) {
    case View::Kind::perspective:
        ray.direction = normalized(view_.direction + aside);
        break;
    case View::Kind::parallel:
        ray.origin += aside;
        break;
    case View::Kind::hemispherical: {
        const double squared = dot(aside, aside);
        if (squared > 1)
            return false;
        ray.direction = normalized(view_.direction * std::sqrt(1 - squared) + aside);
        break;
    }
    case View::Kind::angular: {
        const double angle = length(aside);
        if (angle > pi)
            return false;
        if (angle > 0)
            ray.direction = normalized(view_.direction * std::cos(angle) + aside * (std::sin(angle) / angle));
        break;
    }
    }
    ray.origin += ray.direction * view_.fore_m;
    return true;
}

double Camera::pixel_solid_angle_sr(double x, double y, int width, int height) const noexcept
{
    const double sx = 2 * (x - 0.5 + view_.shift), sy = 2 * (y - 0.5 + view_.lift);
    const Vec3 aside = right_ * sx + up_ * sy;
    const double element = 4 * length(right_) * length(up_) / (static_cast<double>(width) * height);
    const double squared = dot(aside, aside);
    switch (view_.kind) {
    case View::Kind::perspective:
        return element / std::pow(1 + squared, 1.5);
    case View::Kind::parallel:
        return 0;
    case View::Kind::hemispherical:
        return squared >= 1 ? 0 : element / std::sqrt(1 - squared);
    case View::Kind::angular: {
        const double angle = std::sqrt(squared);
        return angle > pi ? 0 : angle > 0 ? element * std::sin(angle) / angle : element;
    }
    }
    return 0;
}

namespace {

class ViewWords {
public:
    ViewWords(const std::string& text, std::string place) : words_(split(text, " \t\r\n")), place_(std::move(place)) {}
    bool done() const { return next_ == words_.size(); }
    std::string_view word() { return words_[next_++]; }
    double number(std::string_view after)
    {
        const auto value = done() ? std::nullopt : parse_double(words_[next_]);
        if (!value || !std::isfinite(*value))
            throw InputError{place_, fmt::format("{} is followed by \"{}\", expected a finite number", after,
                                                 done() ? "nothing" : words_[next_])};
        ++next_;
        return *value;
    }
    Vec3 vector(std::string_view after)
    {
        const double x = number(after), y = number(after);
        return {x, y, number(after)};
    }

private:
    std::vector<std::string_view> words_;
    std::string place_;
    std::size_t next_ = 0;
};

View::Kind view_kind(std::string_view word, const std::string& place)
{
    for (const View::Kind kind :
         {View::Kind::perspective, View::Kind::parallel, View::Kind::hemispherical, View::Kind::angular})
        if (word.size() == 4 && word[3] == static_cast<char>(kind))
            return kind;
    throw InputError{place, fmt::format("view type \"{}\" is not known", word),
                     "use -vtv perspective, -vtl parallel, -vth hemispherical or -vta angular fisheye"};
}

} // namespace

View parse_view(const std::string& text, const std::string& place)
{
    View view;
    ViewWords words(text, place);
    while (!words.done()) {
        std::string_view word = words.word();
        if (word.starts_with("VIEW="))
            word.remove_prefix(5);
        if (word.empty() || word == "rvu" || word == "rview" || word == "rpict")
            continue;
        if (word.starts_with("-vt"))
            view.kind = view_kind(word, place);
        else if (word == "-vp")
            view.position = words.vector(word);
        else if (word == "-vd")
            view.direction = words.vector(word);
        else if (word == "-vu")
            view.up = words.vector(word);
        else if (word == "-vh")
            view.horizontal = words.number(word);
        else if (word == "-vv")
            view.vertical = words.number(word);
        else if (word == "-vs")
            view.shift = words.number(word);
        else if (word == "-vl")
            view.lift = words.number(word);
        else if (word == "-vo")
            view.fore_m = words.number(word);
        else if (word == "-va")
            view.aft_m = words.number(word);
        else
            throw InputError{place, fmt::format("\"{}\" is not a word of a view", word),
                             "use -vt -vp -vd -vu -vh -vv -vs -vl -vo -va"};
    }
    return view;
}

std::string to_text(const View& view)
{
    const auto triple = [](const Vec3& v) { return shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z); };
    return fmt::format("-vt{} -vp {} -vd {} -vu {} -vh {} -vv {} -vs {} -vl {} -vo {} -va {}",
                       static_cast<char>(view.kind), triple(view.position), triple(view.direction), triple(view.up),
                       shortest(view.horizontal), shortest(view.vertical), shortest(view.shift), shortest(view.lift),
                       shortest(view.fore_m), shortest(view.aft_m));
}

} // namespace lightwell
