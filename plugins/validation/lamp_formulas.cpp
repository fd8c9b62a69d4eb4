#include "plugins/validation/lamp_formulas.h"

#include <algorithm>

namespace lightwell {
namespace {

double square(double x)
{
    return x * x;
}

} // namespace

std::vector<Vec3> front_part(const std::vector<Vec3>& corners, const Vec3& normal)
{
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const double ha = dot(a, normal), hb = dot(b, normal);
        if (ha >= 0)
            kept.push_back(a);
        if ((ha >= 0) != (hb >= 0))
            kept.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    return kept;
}

double polygon_illuminance(const std::vector<Point>& corners, double luminance, const Point& at,
                           const Direction& normal)
{
    std::vector<Vec3> seen;
    for (const Point& corner : corners)
        seen.push_back(corner - at);
    seen = front_part(seen, normal);
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Vec3 &a = seen[i], &b = seen[(i + 1) % seen.size()], c = cross(a, b);
        if (const double size = length(c); size > 0)
            sum += std::atan2(size, dot(a, b)) * dot(normal, c) / size;
    }
    return 0.5 * luminance * std::fabs(sum);
}

double disc_illuminance(double radius, double height, double aside, double luminance)
{
    const double a2 = aside * aside, h2 = height * height, r2 = radius * radius;
    // The difference of the textbook form, rewritten so that it does not cancel for small discs.
    const double root = std::sqrt(square(a2 + h2 + r2) - 4 * a2 * r2), numerator = a2 + h2 - r2;
    const double difference = 4 * h2 * r2 / (root * (root + numerator));
    return 0.5 * pi * luminance * (numerator > 0 ? difference : 1 - numerator / root);
}

double sphere_illuminance(double radius, double distance, double tilt_rad, double luminance)
{
    const double h = distance / radius, s = std::sqrt(h * h - 1), c = std::cos(tilt_rad);
    if (h * c >= 1)
        return pi * luminance * c / (h * h);
    if (h * c <= -1)
        return 0;
    const double part = 0.5 - std::asin(s / (h * std::sin(tilt_rad))) / pi +
                        (c * std::acos(-s * c / std::sin(tilt_rad)) - s * std::sqrt(1 - h * h * c * c)) / (pi * h * h);
    return pi * luminance * part;
}

double line_illuminance(double half_length, double height, double along, double strength)
{
    const auto primitive = [](double beta) { return beta + std::sin(beta) * std::cos(beta); };
    return strength / (2 * height) *
           (primitive(std::atan2(half_length - along, height)) - primitive(std::atan2(-half_length - along, height)));
}

double sun_illuminance(double half_angle_rad, double luminance)
{
    return pi * luminance * square(std::sin(half_angle_rad));
}

double free_part_of_disc(double edge)
{
    const double s = std::clamp(edge, -1.0, 1.0);
    return 1 - (std::acos(s) - s * std::sqrt(1 - s * s)) / pi;
}

double parallel_rectangles(double x, double y, double z)
{
    const double a = x / z, b = y / z, ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return 2 / (pi * a * b) *
           (std::log(ra * rb / std::sqrt(1 + a * a + b * b)) + a * rb * std::atan(a / rb) + b * ra * std::atan(b / ra) -
            a * std::atan(a) - b * std::atan(b));
}

double perpendicular_rectangles(double l, double w, double h)
{
    const double a = h / l, b = w / l, a2 = a * a, b2 = b * b, sum = a2 + b2;
    const double logs = std::log((1 + b2) * (1 + a2) / (1 + sum)) + b2 * std::log(b2 * (1 + sum) / ((1 + b2) * sum)) +
                        a2 * std::log(a2 * (1 + sum) / ((1 + a2) * sum));
    return (b * std::atan(1 / b) + a * std::atan(1 / a) - std::sqrt(sum) * std::atan(1 / std::sqrt(sum)) +
            0.25 * logs) /
           (pi * b);
}

double coaxial_discs(double r1, double r2, double h)
{
    const double a = r1 / h, b = r2 / h, x = 1 + (1 + b * b) / (a * a);
    return 2 * square(b / a) / (x + std::sqrt(x * x - 4 * square(b / a)));
}

} // namespace lightwell
