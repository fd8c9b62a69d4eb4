#pragma once

#include "engine/sources/local_source.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Where light is gathered, for choosing among sources.
struct Receiver {
    Point at;
    Direction normal;
    bool transmits = false; ///< light from behind counts too
};

/// A binary tree over all lamps: each node knows the box that holds them, the cone in which their light leaves, and
/// their strength. It says quickly which lamps matter at a point, so that the many others cost little.
/// Source  Conty Estevez, Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting" (the measure
///         of importance); Walter et al. 2005, "Lightcuts" (the cut)
class LampTree {
public:
    explicit LampTree(const std::vector<LocalSource>& lamps);

    struct Chosen {
        int lamp = -1; ///< -1: no lamp of the subtree can be seen
        double probability = 0;
    };
    /// @param u  [0, 1); neighbouring numbers choose neighbouring lamps
    Chosen choose(const Receiver& receiver, double u) const noexcept;
    /// Probability with which choose() picks a lamp.
    double probability(int lamp, const Receiver& receiver) const noexcept;

    /// A lamp that stands for a group: its light divided by its probability is the group's, on average.
    struct Representative {
        int lamp;
        double probability; ///< 1 for a lamp that stands for itself
    };
    /// Divides all lamps that can reach the receiver into at most `most` groups, the strongest split first, and
    /// chooses one lamp of each.
    /// @param u  [0, 1), moves the choice in all groups
    void cut(const Receiver& receiver, std::size_t most, double u, std::vector<Representative>& found) const;

private:
    /// Lengths in units of the radius of all lamps together, from their middle; strengths as shares of the whole: so
    /// that single precision is enough at any place and scale. 64 bytes, two siblings after one another.
    struct Node {
        float x, y, z, radius;
        float axis_x, axis_y, axis_z;
        float cos_spread, sin_spread; ///< cone of the axes of what it holds
        float cos_emission;           ///< beyond the spread, where no more light leaves
        float strength;
        std::uint32_t parent, child; ///< first of two; 0: a leaf
        std::uint32_t first, count;  ///< of its lamps, in order_
    };
    /// A receiver in the units of the nodes.
    struct Seen {
        float x, y, z, normal_x, normal_y, normal_z;
        bool transmits;
    };
    struct Builder;
    Seen seen_from(const Receiver& receiver) const noexcept;
    static float importance(const Node& node, const Seen& from) noexcept;
    static bool compact(const Node& node, const Seen& from) noexcept;
    Chosen within(const Node& node, double u) const noexcept;
    double share_within(const Node& node, std::size_t place) const noexcept;
    Chosen descend(std::uint32_t from, const Seen& seen, double u) const noexcept;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;    ///< lamps as the leaves hold them
    std::vector<double> summed_strength_; ///< up to and including each of them
    std::vector<std::uint32_t> leaf_of_;  ///< by lamp
    Point middle_;
    double unit_m_ = 1;
};

} // namespace lightwell
