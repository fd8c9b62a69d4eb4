#include "importers/obj/triangulate.h"

#include "engine/scene/surface.h"

#include <cmath>
#include <utility>

namespace lightwell {
namespace {

/// Cutting ears takes time that grows with the cube of the corners at worst: 1024 corners take about a second.
constexpr std::size_t most_corners_for_ears = 1024;

struct Flat {
    double x = 0, y = 0;
};

/// Twice the signed area of a triangle.
double turn(const Flat& a, const Flat& b, const Flat& c) noexcept
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The outline seen along its area vector, counter-clockwise: the two axes other than the largest component.
std::vector<Flat> flattened(const std::vector<Point>& corners)
{
    const Vec3 front = polygon_area_vector(corners.data(), corners.size());
    const Vec3 size{std::fabs(front.x), std::fabs(front.y), std::fabs(front.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int first = (axis + 1) % 3, second = (axis + 2) % 3;
    if (front[axis] < 0)
        std::swap(first, second);
    std::vector<Flat> flat;
    flat.reserve(corners.size());
    for (const Point& corner : corners)
        flat.push_back({(corner - corners[0])[first], (corner - corners[0])[second]});
    return flat;
}

std::vector<std::uint32_t> fan(std::size_t count)
{
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
    return triangles;
}

/// True when the corner at `at` of what is left sticks out and no other corner lies in its triangle.
bool is_ear(const std::vector<Flat>& flat, const std::vector<std::uint32_t>& left, std::size_t at)
{
    const std::size_t count = left.size(), before = (at + count - 1) % count, after = (at + 1) % count;
    const Flat &a = flat[left[before]], &b = flat[left[at]], &c = flat[left[after]];
    if (!(turn(a, b, c) > 0))
        return false;
    for (std::size_t i = 0; i < count; ++i) {
        if (i == before || i == at || i == after)
            continue;
        const Flat& p = flat[left[i]];
        if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
            return false;
    }
    return true;
}

} // namespace

std::vector<std::uint32_t> triangulate(const std::vector<Point>& corners)
{
    if (corners.size() <= 3 || corners.size() > most_corners_for_ears)
        return fan(corners.size());
    const std::vector<Flat> flat = flattened(corners);
    std::vector<std::uint32_t> left(corners.size()), triangles;
    for (std::uint32_t i = 0; i < left.size(); ++i)
        left[i] = i;
    std::size_t at = 1, tried = 0;
    while (left.size() > 3 && tried < left.size()) {
        at %= left.size();
        if (!is_ear(flat, left, at)) {
            ++at;
            ++tried;
            continue;
        }
        const std::size_t count = left.size();
        triangles.insert(triangles.end(), {left[(at + count - 1) % count], left[at], left[(at + 1) % count]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
        tried = 0;
    }
    if (left.size() > 3) // no ear: the outline crosses itself
        return fan(corners.size());
    triangles.insert(triangles.end(), left.begin(), left.end());
    return triangles;
}

} // namespace lightwell
