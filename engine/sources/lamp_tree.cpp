#include "engine/sources/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

/// What is turned almost away is still found now and then: the cosines are those of the middle.
constexpr double least_cosine = 0.05;
/// Rounding of the cosines by which nodes are left out.
constexpr double rounding = 1e-9;
/// (sqrt(5) - 1) / 2: its multiples are spread evenly over [0, 1).
constexpr double golden = 0.6180339887498949;

/// Cosine of the difference of two angles, at least 0 rad.
double cos_difference(double cos_a, double sin_a, double cos_b, double sin_b)
{
    return cos_a >= cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}

double sine_of(double cosine)
{
    return std::sqrt(std::fmax(0, 1 - cosine * cosine));
}

/// Directions within an angle of an axis.
struct DirectionCone {
    Direction axis;
    double half_rad;
};

/// The smallest cone about both, or all directions.
DirectionCone merged(DirectionCone a, DirectionCone b)
{
    if (a.half_rad < b.half_rad)
        std::swap(a, b);
    const double between = std::atan2(length(cross(a.axis, b.axis)), dot(a.axis, b.axis));
    if (between + b.half_rad <= a.half_rad)
        return a;
    const double half = 0.5 * (a.half_rad + between + b.half_rad);
    const Vec3 across = b.axis - a.axis * dot(a.axis, b.axis);
    if (half >= pi || !(length(across) > 0))
        return {a.axis, pi};
    const double turn = half - a.half_rad;
    return {normalized(a.axis * std::cos(turn) + normalized(across) * std::sin(turn)), half};
}

} // namespace

struct LampTree::Builder {
    LampTree& tree;
    std::vector<LocalSource::Reach> reach;
    std::vector<int> order;

    /// What a finished subtree hands to its parent.
    struct Bounds {
        Box box;
        DirectionCone axes;
        double emission_rad;
        double strength;
    };
    Bounds bounds_of(const LocalSource::Reach& r) const
    {
        const bool to_all_sides = r.half_angle_rad >= pi;
        const Direction axis = to_all_sides ? Direction{0, 0, 1} : r.axis;
        return {r.box, {axis, to_all_sides ? pi : 0}, std::fmin(r.half_angle_rad, pi), r.strength_W_per_sr};
    }
    static Bounds both(const Bounds& a, const Bounds& b)
    {
        Box box = a.box;
        box.extend(b.box);
        return {box, merged(a.axes, b.axes), std::fmax(a.emission_rad, b.emission_rad), a.strength + b.strength};
    }
    void split(std::size_t first, std::size_t count)
    {
        Box middles;
        for (std::size_t i = first; i < first + count; ++i)
            middles.extend(reach[static_cast<std::size_t>(order[i])].box.centre());
        const Vec3 extent = middles.high - middles.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        // Lamps at the same place keep the order of the scene, so that the tree is the same everywhere.
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                         begin + static_cast<std::ptrdiff_t>(count), [&](int a, int b) {
                             const double pa = reach[static_cast<std::size_t>(a)].box.centre()[axis];
                             const double pb = reach[static_cast<std::size_t>(b)].box.centre()[axis];
                             return pa < pb || (pa == pb && a < b);
                         });
    }
    Bounds build(std::size_t first, std::size_t count, std::uint32_t parent)
    {
        const auto here = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_.push_back({});
        Bounds bounds;
        if (count == 1) {
            const int lamp = order[first];
            bounds = bounds_of(reach[static_cast<std::size_t>(lamp)]);
            tree.nodes_[here].lamp = lamp;
            tree.leaf_of_[static_cast<std::size_t>(lamp)] = here;
        } else {
            split(first, count);
            const Bounds left = build(first, count / 2, here);
            const auto right_node = static_cast<std::uint32_t>(tree.nodes_.size());
            bounds = both(left, build(first + count / 2, count - count / 2, here));
            tree.nodes_[here].right = right_node;
            tree.nodes_[here].lamp = -1;
        }
        Node& node = tree.nodes_[here];
        node.parent = parent;
        node.centre = bounds.box.centre();
        node.radius_m = 0.5 * bounds.box.diagonal();
        node.axis = bounds.axes.axis;
        node.cos_spread = std::cos(bounds.axes.half_rad);
        node.sin_spread = std::sin(bounds.axes.half_rad);
        node.cos_emission = std::cos(bounds.emission_rad);
        node.strength = bounds.strength;
        return bounds;
    }
};

LampTree::LampTree(const std::vector<LocalSource>& lamps) : leaf_of_(lamps.size())
{
    Builder builder{*this, {}, std::vector<int>(lamps.size())};
    for (const LocalSource& lamp : lamps)
        builder.reach.push_back(lamp.reach());
    std::iota(builder.order.begin(), builder.order.end(), 0);
    nodes_.reserve(2 * lamps.size());
    if (!lamps.empty())
        builder.build(0, lamps.size(), 0);
}

double LampTree::importance(const Node& node, const Receiver& receiver) const noexcept
{
    const Vec3 to_centre = node.centre - receiver.at;
    const double squared = dot(to_centre, to_centre), radius2 = node.radius_m * node.radius_m;
    if (!(squared > radius2))
        return node.strength / std::fmax(radius2, 1e-300);
    const double distance = std::sqrt(squared);
    // Seen from the receiver, the node fills a cone of this half-angle: every angle below may be smaller by as much.
    const double sine = node.radius_m / distance, cosine = sine_of(sine);
    double arriving = dot(receiver.normal, to_centre) / distance;
    if (receiver.transmits)
        arriving = std::fabs(arriving);
    arriving = cos_difference(arriving, sine_of(arriving), cosine, sine);
    if (arriving <= -rounding)
        return 0;
    const double leaving = -dot(node.axis, to_centre) / distance;
    const double within = cos_difference(leaving, sine_of(leaving), node.cos_spread, node.sin_spread);
    const double nearest = cos_difference(within, sine_of(within), cosine, sine);
    if (nearest <= node.cos_emission - rounding)
        return 0;
    return node.strength * std::fmax(arriving, least_cosine) * std::fmax(nearest, least_cosine) / squared;
}

LampTree::Chosen LampTree::descend(std::uint32_t from, const Receiver& receiver, double u) const noexcept
{
    if (nodes_.empty())
        return {};
    double probability = 1;
    std::uint32_t at = from;
    while (nodes_[at].right != 0) {
        const double left = importance(nodes_[at + 1], receiver),
                     right = importance(nodes_[nodes_[at].right], receiver);
        if (!(left + right > 0))
            return {};
        const double share = left / (left + right);
        const bool to_left = u < share;
        u = to_left ? u / share : (u - share) / (1 - share);
        u = std::clamp(u, 0.0, 0x1.fffffffffffffp-1);
        probability *= to_left ? share : right / (left + right);
        at = to_left ? at + 1 : nodes_[at].right;
    }
    return {nodes_[at].lamp, probability};
}

double LampTree::probability(int lamp, const Receiver& receiver) const noexcept
{
    double probability = 1;
    std::uint32_t at = leaf_of_[static_cast<std::size_t>(lamp)];
    while (at != 0 && probability > 0) {
        const std::uint32_t above = nodes_[at].parent;
        const double left = importance(nodes_[above + 1], receiver);
        const double right = importance(nodes_[nodes_[above].right], receiver);
        const double own = at == above + 1 ? left : right;
        probability *= own > 0 ? own / (left + right) : 0;
        at = above;
    }
    return probability;
}

void LampTree::cut(const Receiver& receiver, std::size_t most, double u, std::vector<Representative>& found) const
{
    found.clear();
    if (nodes_.empty())
        return;
    struct Group {
        double importance;
        std::uint32_t node;
    };
    const auto weaker = [](const Group& a, const Group& b) {
        return a.importance < b.importance || (a.importance == b.importance && a.node > b.node);
    };
    thread_local std::vector<Group> groups;
    groups.clear();
    const auto add = [&](std::uint32_t node) {
        const double weight = importance(nodes_[node], receiver);
        if (!(weight > 0))
            return;
        if (nodes_[node].right == 0) {
            found.push_back({nodes_[node].lamp, 1});
            return;
        }
        groups.push_back({weight, node});
        std::push_heap(groups.begin(), groups.end(), weaker);
    };
    add(0);
    while (!groups.empty() && groups.size() + found.size() < most) {
        std::pop_heap(groups.begin(), groups.end(), weaker);
        const std::uint32_t node = groups.back().node;
        groups.pop_back();
        add(node + 1);
        add(nodes_[node].right);
    }
    for (const Group& group : groups) {
        u += golden;
        u -= std::floor(u);
        const Chosen chosen = descend(group.node, receiver, u);
        if (chosen.lamp >= 0)
            found.push_back({chosen.lamp, chosen.probability});
    }
}

} // namespace lightwell
