#include "importers/dxf/spline.h"

#include "importers/dxf/geometry.h"

#include <algorithm>

namespace lightwell::dxf {
namespace {

constexpr int highest_degree = 25; // CAD programs stop at 11 or 25
/// Some 24 megabytes: a curve of a drawing has a thousand.
constexpr std::size_t most_points = 1'000'000;

/// Angles that differ by less are equal, and a turn that lacks less is whole.
constexpr double rounding_rad = 1e-9;

/// A point times its weight, and the weight.
struct Weighted {
    Vec3 point;
    double weight;
};

/// Gives points of a spline, parameter by parameter.
/// Source  de Boor's algorithm on the weighted points
class SplineCurve {
public:
    explicit SplineCurve(const Spline& spline) : spline_(spline), row_(static_cast<std::size_t>(spline.degree) + 1) {}
    /// @param span  u lies between knots[span] and knots[span + 1], which differ
    Point at(double u, std::size_t span)
    {
        const auto degree = static_cast<std::size_t>(spline_.degree);
        for (std::size_t i = 0; i <= degree; ++i) {
            const std::size_t index = span - degree + i;
            const double weight = spline_.weights.empty() ? 1 : spline_.weights[index];
            row_[i] = {spline_.control[index] * weight, weight};
        }
        for (std::size_t level = 1; level <= degree; ++level)
            for (std::size_t i = degree; i >= level; --i) {
                const double low = spline_.knots[span - degree + i], high = spline_.knots[span + 1 + i - level];
                const double share = (u - low) / (high - low);
                row_[i] = {row_[i - 1].point * (1 - share) + row_[i].point * share,
                           row_[i - 1].weight * (1 - share) + row_[i].weight * share};
            }
        return row_[degree].point / row_[degree].weight;
    }

private:
    const Spline& spline_;
    std::vector<Weighted> row_;
};

double distance_from_chord(const Point& p, const Point& a, const Point& b)
{
    const Vec3 chord = b - a;
    const double size = dot(chord, chord);
    const double along = size > 0 ? std::clamp(dot(p - a, chord) / size, 0.0, 1.0) : 0;
    return length(p - a - chord * along);
}

class Flattener {
public:
    Flattener(const Spline& spline, double tolerance) : curve_(spline), tolerance_(tolerance) {}
    void add_start(double u, std::size_t span) { points.push_back(curve_.at(u, span)); }
    /// Points after u0 up to u1.
    void add(double u0, double u1, std::size_t span, int depth)
    {
        constexpr int deepest = 10;
        const Point from = points.back(), to = curve_.at(u1, span);
        double distance = 0;
        for (const double share : {0.25, 0.5, 0.75})
            distance = std::fmax(distance, distance_from_chord(curve_.at(u0 + (u1 - u0) * share, span), from, to));
        if (distance > tolerance_ && depth < deepest && points.size() < most_points) {
            const double middle = 0.5 * (u0 + u1);
            add(u0, middle, span, depth + 1);
            add(middle, u1, span, depth + 1);
            return;
        }
        largest_distance = std::fmax(largest_distance, distance);
        points.push_back(to);
    }

    std::vector<Point> points;
    double largest_distance = 0;

private:
    SplineCurve curve_;
    double tolerance_;
};

} // namespace

bool is_sound(const Spline& spline)
{
    const std::size_t count = spline.control.size();
    if (spline.degree < 1 || spline.degree > highest_degree || count <= static_cast<std::size_t>(spline.degree) ||
        spline.knots.size() != count + static_cast<std::size_t>(spline.degree) + 1 ||
        !std::is_sorted(spline.knots.begin(), spline.knots.end()))
        return false;
    return spline.weights.empty() ||
           (spline.weights.size() == count &&
            std::all_of(spline.weights.begin(), spline.weights.end(), [](double weight) { return weight > 0; }));
}

std::vector<Point> points_on(const Spline& spline, double chord_tolerance, Deviations& deviations)
{
    Flattener flattener{spline, chord_tolerance};
    for (auto span = static_cast<std::size_t>(spline.degree); span < spline.control.size(); ++span) {
        const double from = spline.knots[span], to = spline.knots[span + 1];
        if (!(to > from))
            continue;
        if (flattener.points.empty())
            flattener.add_start(from, span);
        flattener.add(from, to, span, 0);
    }
    if (spline.degree > 1 && flattener.points.size() > 1) {
        deviations.chords += flattener.points.size() - 1;
        deviations.chord_error = std::fmax(deviations.chord_error, flattener.largest_distance);
    }
    return std::move(flattener.points);
}

std::vector<Point> points_on_ellipse(const Point& centre, const Vec3& major, const Vec3& minor, double start_rad,
                                     double sweep_rad, double chord_tolerance, Deviations& deviations)
{
    // An ellipse is a flattened circle, and so are the gaps between its chords.
    const double radius = std::fmax(length(major), length(minor));
    if (!(radius > 0))
        return {};
    const int chords = chord_count(radius, sweep_rad, chord_tolerance);
    std::vector<Point> points;
    for (int i = 0; i <= chords; ++i) {
        const double t = start_rad + sweep_rad * i / chords;
        points.push_back(centre + major * std::cos(t) + minor * std::sin(t));
    }
    if (2 * pi - std::fabs(sweep_rad) < rounding_rad)
        points.back() = points.front();
    deviations.chords += static_cast<std::size_t>(chords);
    deviations.chord_error = std::fmax(deviations.chord_error, chord_error(radius, sweep_rad, chords));
    return points;
}

double sweep_between(double start_rad, double end_rad)
{
    const double sweep_rad = std::fmod(end_rad - start_rad, 2 * pi);
    return sweep_rad < rounding_rad ? sweep_rad + 2 * pi : sweep_rad;
}

} // namespace lightwell::dxf
