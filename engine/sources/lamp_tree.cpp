#include "engine/sources/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

/// What is turned almost away is still found now and then: the cosines are those of the middle.
constexpr float least_cosine = 0.05f, least_share = 0.2f;
/// Rounding of the cosines by which nodes are left out, and of places in units of the tree.
constexpr float rounding = 1e-5f;
/// A group that is seen smaller than this (radius over distance) and faces one way gives about the same light from
/// each of its lamps: they are told apart by strength alone, without walking down to them.
constexpr float compact_size = 0.1f;
constexpr float compact_spread = 0.995f;
/// (sqrt(5) - 1) / 2: its multiples are spread evenly over [0, 1).
constexpr double golden = 0.6180339887498949;

/// Cosine of the difference of two angles, at least 0 rad.
float cos_difference(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a >= cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}

float sine_of(float cosine)
{
    return std::sqrt(std::max(0.0f, 1 - cosine * cosine));
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
    double whole; ///< strength of all

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
            middles.extend(reach[tree.order_[i]].box.centre());
        const Vec3 extent = middles.high - middles.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto begin = tree.order_.begin() + static_cast<std::ptrdiff_t>(first);
        // Lamps at the same place keep the order of the scene, so that the tree is the same everywhere.
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                         begin + static_cast<std::ptrdiff_t>(count), [&](std::uint32_t a, std::uint32_t b) {
                             const double pa = reach[a].box.centre()[axis], pb = reach[b].box.centre()[axis];
                             return pa < pb || (pa == pb && a < b);
                         });
    }
    Bounds build(std::uint32_t here, std::size_t first, std::size_t count)
    {
        Bounds bounds;
        if (count == 1) {
            bounds = bounds_of(reach[tree.order_[first]]);
            tree.leaf_of_[tree.order_[first]] = here;
        } else {
            split(first, count);
            const auto child = static_cast<std::uint32_t>(tree.nodes_.size());
            tree.nodes_.resize(tree.nodes_.size() + 2);
            tree.nodes_[here].child = child;
            tree.nodes_[child].parent = tree.nodes_[child + 1].parent = here;
            const Bounds left = build(child, first, count / 2);
            bounds = both(left, build(child + 1, first + count / 2, count - count / 2));
        }
        fill(tree.nodes_[here], bounds);
        tree.nodes_[here].first = static_cast<std::uint32_t>(first);
        tree.nodes_[here].count = static_cast<std::uint32_t>(count);
        return bounds;
    }
    void fill(Node& node, const Bounds& bounds) const
    {
        const Vec3 centre = (bounds.box.centre() - tree.middle_) / tree.unit_m_;
        node.x = static_cast<float>(centre.x);
        node.y = static_cast<float>(centre.y);
        node.z = static_cast<float>(centre.z);
        node.radius = static_cast<float>(0.5 * bounds.box.diagonal() / tree.unit_m_) + rounding * 0.1f;
        node.axis_x = static_cast<float>(bounds.axes.axis.x);
        node.axis_y = static_cast<float>(bounds.axes.axis.y);
        node.axis_z = static_cast<float>(bounds.axes.axis.z);
        node.cos_spread = static_cast<float>(std::cos(bounds.axes.half_rad));
        node.sin_spread = static_cast<float>(std::sin(bounds.axes.half_rad));
        node.cos_emission = static_cast<float>(std::cos(bounds.emission_rad));
        node.strength = static_cast<float>(bounds.strength / whole);
    }
};

LampTree::LampTree(const std::vector<LocalSource>& lamps) : order_(lamps.size()), leaf_of_(lamps.size())
{
    if (lamps.empty())
        return;
    Builder builder{*this, {}, 0};
    Box box;
    for (const LocalSource& lamp : lamps) {
        builder.reach.push_back(lamp.reach());
        builder.whole += builder.reach.back().strength_W_per_sr;
        box.extend(builder.reach.back().box);
    }
    middle_ = box.centre();
    unit_m_ = 0.5 * box.diagonal();
    if (!(unit_m_ > 0 && builder.whole > 0))
        return;
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(2 * lamps.size());
    nodes_.resize(1);
    builder.build(0, 0, lamps.size());
    double sum = 0;
    for (const std::uint32_t lamp : order_)
        summed_strength_.push_back(sum += builder.reach[lamp].strength_W_per_sr / builder.whole);
}

LampTree::Seen LampTree::seen_from(const Receiver& receiver) const noexcept
{
    const Vec3 at = (receiver.at - middle_) / unit_m_;
    return {static_cast<float>(at.x),
            static_cast<float>(at.y),
            static_cast<float>(at.z),
            static_cast<float>(receiver.normal.x),
            static_cast<float>(receiver.normal.y),
            static_cast<float>(receiver.normal.z),
            receiver.transmits};
}

float LampTree::importance(const Node& node, const Seen& from) noexcept
{
    const float x = node.x - from.x, y = node.y - from.y, z = node.z - from.z;
    const float squared = x * x + y * y + z * z, radius2 = node.radius * node.radius;
    if (!(squared > radius2))
        return node.strength / radius2;
    const float per_distance = 1 / std::sqrt(squared);
    // Seen from the receiver, the node fills a cone of this half-angle: every angle below may be smaller by as much.
    const float sine = node.radius * per_distance, cosine = sine_of(sine);
    float arriving = (from.normal_x * x + from.normal_y * y + from.normal_z * z) * per_distance;
    if (from.transmits)
        arriving = std::fabs(arriving);
    const float most_arriving = cos_difference(arriving, sine_of(arriving), cosine, sine);
    if (most_arriving <= -rounding)
        return 0;
    const float leaving = -(node.axis_x * x + node.axis_y * y + node.axis_z * z) * per_distance;
    const float within = cos_difference(leaving, sine_of(leaving), node.cos_spread, node.sin_spread);
    const float nearest = cos_difference(within, sine_of(within), cosine, sine);
    if (nearest <= node.cos_emission - rounding)
        return 0;
    // The bounds decide what is left out; the cosines of the middle say better what the rest gives.
    return node.strength * std::max(arriving, least_share * most_arriving + least_cosine) *
           std::max(within, least_share * nearest + least_cosine) / squared;
}

bool LampTree::compact(const Node& node, const Seen& from) noexcept
{
    const float x = node.x - from.x, y = node.y - from.y, z = node.z - from.z;
    const bool one_way = node.cos_spread > compact_spread ? node.cos_emission <= rounding : node.cos_spread < -0.999f;
    return one_way && node.radius * node.radius < compact_size * compact_size * (x * x + y * y + z * z);
}

LampTree::Chosen LampTree::within(const Node& node, double u) const noexcept
{
    const double before = node.first == 0 ? 0 : summed_strength_[node.first - 1];
    const double wanted = before + u * (summed_strength_[node.first + node.count - 1] - before);
    const auto begin = summed_strength_.begin() + node.first;
    const auto at =
        static_cast<std::size_t>(std::upper_bound(begin, begin + (node.count - 1), wanted) - summed_strength_.begin());
    return {static_cast<int>(order_[at]), share_within(node, at)};
}

double LampTree::share_within(const Node& node, std::size_t place) const noexcept
{
    const double before = node.first == 0 ? 0 : summed_strength_[node.first - 1];
    const double own = summed_strength_[place] - (place == 0 ? 0 : summed_strength_[place - 1]);
    return own / (summed_strength_[node.first + node.count - 1] - before);
}

LampTree::Chosen LampTree::choose(const Receiver& receiver, double u) const noexcept
{
    return nodes_.empty() ? Chosen{} : descend(0, seen_from(receiver), u);
}

LampTree::Chosen LampTree::descend(std::uint32_t from, const Seen& seen, double u) const noexcept
{
    double probability = 1;
    std::uint32_t at = from;
    while (nodes_[at].child != 0 && !compact(nodes_[at], seen)) {
        const std::uint32_t child = nodes_[at].child;
        const double left = importance(nodes_[child], seen), right = importance(nodes_[child + 1], seen);
        if (!(left + right > 0))
            return {};
        const double share = left / (left + right);
        const bool to_left = u < share;
        u = std::clamp(to_left ? u / share : (u - share) / (1 - share), 0.0, 0x1.fffffffffffffp-1);
        probability *= to_left ? share : right / (left + right);
        at = to_left ? child : child + 1;
    }
    const Chosen last = within(nodes_[at], u);
    return {last.lamp, last.probability * probability};
}

double LampTree::probability(int lamp, const Receiver& receiver) const noexcept
{
    if (nodes_.empty())
        return 0;
    const Seen seen = seen_from(receiver);
    const std::uint32_t leaf = leaf_of_[static_cast<std::size_t>(lamp)];
    double probability = 1;
    for (std::uint32_t at = leaf; at != 0; at = nodes_[at].parent) {
        const std::uint32_t above = nodes_[at].parent, child = nodes_[above].child;
        if (compact(nodes_[above], seen)) { // the way down ended here, or above
            probability = share_within(nodes_[above], nodes_[leaf].first);
            continue;
        }
        const double left = importance(nodes_[child], seen), right = importance(nodes_[child + 1], seen);
        const double own = at == child ? left : right;
        probability *= own > 0 ? own / (left + right) : 0;
    }
    return probability;
}

void LampTree::cut(const Receiver& receiver, std::size_t most, double u, std::vector<Representative>& found) const
{
    found.clear();
    if (nodes_.empty())
        return;
    struct Group {
        float importance;
        std::uint32_t node;
    };
    const auto weaker = [](const Group& a, const Group& b) {
        return a.importance < b.importance || (a.importance == b.importance && a.node > b.node);
    };
    thread_local std::vector<Group> groups;
    groups.clear();
    const Seen seen = seen_from(receiver);
    const auto add = [&](std::uint32_t node) {
        const float weight = importance(nodes_[node], seen);
        if (!(weight > 0))
            return;
        if (nodes_[node].child == 0) {
            found.push_back({static_cast<int>(order_[nodes_[node].first]), 1});
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
        add(nodes_[node].child);
        add(nodes_[node].child + 1);
    }
    for (const Group& group : groups) {
        u += golden;
        u -= std::floor(u);
        const Chosen chosen = descend(group.node, seen, u);
        if (chosen.lamp >= 0)
            found.push_back({chosen.lamp, chosen.probability});
    }
}

} // namespace lightwell
