#include "importers/touching.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lightwell {
namespace {

/// Surfaces of one thing are drawn with their edges together, but for rounding in the file.
constexpr double slack_m = 0.002;

bool touch(const Box& a, const Box& b)
{
    for (int axis = 0; axis < 3; ++axis)
        if (a.low[axis] > b.high[axis] + slack_m || b.low[axis] > a.high[axis] + slack_m)
            return false;
    return true;
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i)
{
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

} // namespace

std::vector<std::vector<std::size_t>> touching_groups(const std::vector<Box>& boxes)
{
    std::vector<std::size_t> order(boxes.size()), parents(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    std::iota(parents.begin(), parents.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return boxes[a].low.x < boxes[b].low.x; });
    std::vector<std::size_t> open; // those that may still touch what begins further along
    for (const std::size_t i : order) {
        std::erase_if(open, [&](std::size_t k) { return boxes[k].high.x + slack_m < boxes[i].low.x; });
        for (const std::size_t k : open)
            if (touch(boxes[i], boxes[k]))
                parents[root_of(parents, i)] = root_of(parents, k);
        open.push_back(i);
    }
    std::map<std::size_t, std::size_t> group_of_root;
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto [entry, fresh] = group_of_root.try_emplace(root_of(parents, i), groups.size());
        if (fresh)
            groups.emplace_back();
        groups[entry->second].push_back(i);
    }
    return groups;
}

} // namespace lightwell
