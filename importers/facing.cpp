#include "importers/facing.h"

#include <algorithm>

namespace lightwell {

void Facing::add(const Part& part, const Surface& surface, const Affine& to_world)
{
    if (surface.shape == Shape::polygon) {
        const Polygon& polygon = part.polygons[surface.index];
        add(&part.points[polygon.first], polygon.count, to_world);
    } else if (surface.shape == Shape::mesh) {
        const Mesh& mesh = *part.meshes[surface.index];
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const Point corners[] = {mesh.points[mesh.triangles[i]], mesh.points[mesh.triangles[i + 1]],
                                     mesh.points[mesh.triangles[i + 2]]};
            add(corners, 3, to_world);
        }
    } else {
        round_ = true;
    }
}

void Facing::add(const Point* points, std::size_t count, const Affine& to_world)
{
    std::vector<Point> corners;
    for (std::size_t i = 0; i < count; ++i)
        corners.push_back(to_world.point(points[i]));
    const Vec3 own = polygon_area_vector(corners.data(), corners.size());
    area_ += own;
    total_m2_ += length(own);
    for (std::size_t i = 0; i < count; ++i)
        edges_.push_back(corners[(i + 1) % count] - corners[i]);
    points_.insert(points_.end(), corners.begin(), corners.end());
}

bool Facing::is_flat() const
{
    constexpr double all_but = 1 - 1e-6;
    return !round_ && length(area_) > all_but * total_m2_ && total_m2_ > 0;
}

Direction Facing::aim() const
{
    constexpr double hardly = 0.1;
    const Direction normal = normalized(area_);
    return normal.z > hardly ? -normal : normal;
}

Vec3 Facing::along() const
{
    constexpr std::size_t most_edges = 500; // of a luminaire the first few tell
    Vec3 best{1, 0, 0};
    double least = infinity;
    for (std::size_t i = 0; i < std::min(edges_.size(), most_edges); ++i) {
        if (!(length(edges_[i]) > 0))
            continue;
        const Direction first = normalized(edges_[i]), second = normalized(cross(area_, first));
        const double a = extent(first), b = extent(second);
        if (a * b < least * (1 - 1e-9)) {
            least = a * b;
            best = a >= b ? first : second;
        }
    }
    return best;
}

double Facing::extent(const Direction& direction) const
{
    double low = infinity, high = -infinity;
    for (const Point& point : points_) {
        low = std::min(low, dot(point, direction));
        high = std::max(high, dot(point, direction));
    }
    return high - low;
}

} // namespace lightwell
