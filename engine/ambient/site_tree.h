#pragma once

#include "engine/ambient/site.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Finds the sites near a place: an octree whose leaves list the sites that reach into them.
/// Sites are visited in the order of their indices, whatever thread asks.
class SiteTree {
public:
    /// Of all the sites; earlier ones are forgotten.
    void build(const std::vector<AmbientSite>& sites);

    /// Calls visit(index) for every site whose reach may cover the place, and some more.
    template <class Visit>
    void near(const Point& at, const Visit& visit) const
    {
        if (nodes_.empty())
            return;
        const Vec3 offset = at - centre_;
        if (!(max_abs(offset) <= half_m_))
            return;
        const Node* node = nodes_.data();
        Vec3 middle{0, 0, 0};
        double half = half_m_;
        while (node->child != 0) {
            half *= 0.5;
            const int x = offset.x >= middle.x, y = offset.y >= middle.y, z = offset.z >= middle.z;
            middle += Vec3{x ? half : -half, y ? half : -half, z ? half : -half};
            node = &nodes_[node->child + static_cast<std::uint32_t>(x + 2 * y + 4 * z)];
        }
        for (std::uint32_t i = 0; i < node->count; ++i)
            visit(entries_[node->first + i]);
    }

private:
    struct Node {
        std::uint32_t child = 0; ///< first of eight; 0: a leaf
        std::uint32_t first = 0, count = 0;
    };
    struct Reaching {
        std::uint32_t site;
        Vec3 low, high; ///< from the centre
    };
    void split(std::uint32_t node, const Vec3& middle, double half, const std::vector<Reaching>& reaching, int depth);

    Point centre_;
    double half_m_ = 0;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> entries_;
};

} // namespace lightwell
