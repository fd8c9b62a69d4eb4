#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// Axis-parallel box; empty until the first extend().
struct Box {
    Point low{infinity, infinity, infinity};
    Point high{-infinity, -infinity, -infinity};

    bool empty() const noexcept { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
    void extend(const Point& p) noexcept
    {
        low = min(low, p);
        high = max(high, p);
    }
    void extend(const Box& other) noexcept
    {
        if (!other.empty()) {
            extend(other.low);
            extend(other.high);
        }
    }
    Point centre() const noexcept { return (low + high) * 0.5; }
    /// Length of the diagonal; 0 when empty.
    double diagonal() const noexcept { return empty() ? 0 : length(high - low); }
    Point corner(int i) const noexcept
    {
        return {(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z};
    }
};

} // namespace lightwell
