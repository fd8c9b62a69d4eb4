#include "plugins/validation/rectangle_factors.h"

namespace lightwell {
namespace {

double times_log(double factor, double square)
{
    return square > 0 ? factor * std::log(square) : 0;
}

double times_angle(double length, double across)
{
    return across > 0 ? length * across * std::atan(length / across) : 0;
}

/// Fourth integral of the kernel between parallel planes: dx, dy between two corners, z between the planes.
double parallel_corner(double dx, double dy, double z)
{
    return times_angle(dy, std::hypot(dx, z)) + times_angle(dx, std::hypot(dy, z)) -
           times_log(0.5 * z * z, dx * dx + dy * dy + z * z);
}

/// The same between perpendicular planes: dy along their common edge, r the distance of the corners across it.
double perpendicular_corner(double dy, double r)
{
    return times_angle(dy, r) - times_log(0.25 * (r * r - dy * dy), r * r + dy * dy);
}

/// Calls back for each pair of ends of two ranges with the sign of the pair in the integral.
template <typename Function>
double over_ends(double low1, double high1, double low2, double high2, const Function& function)
{
    return function(high1, high2) - function(low1, high2) - function(high1, low2) + function(low1, low2);
}

} // namespace

double exchange_area(const AxisRectangle& one, const AxisRectangle& other)
{
    const int a = one.axis, b = other.axis;
    double sum;
    if (a == b) {
        const int i = (a + 1) % 3, k = (a + 2) % 3;
        const double z = std::fabs(one.low[a] - other.low[a]);
        sum = over_ends(one.low[i], one.high[i], other.low[i], other.high[i], [&](double x, double u) {
            return over_ends(one.low[k], one.high[k], other.low[k], other.high[k],
                             [&](double y, double v) { return parallel_corner(x - u, y - v, z); });
        });
    } else {
        const int along = 3 - a - b;
        sum = over_ends(one.low[along], one.high[along], other.low[along], other.high[along], [&](double y, double v) {
            return over_ends(one.low[b], one.high[b], other.low[a], other.high[a], [&](double x, double u) {
                return perpendicular_corner(y - v, std::hypot(x - other.low[b], u - one.low[a]));
            });
        });
    }
    return std::fabs(sum) / (2 * pi); // the sign tells on which side of each other the rectangles lie
}

} // namespace lightwell
