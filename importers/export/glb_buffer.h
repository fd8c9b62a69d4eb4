#pragma once

#include "engine/base/vector.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A range of the binary part of a GLB.
struct GlbView {
    std::size_t offset, bytes;
    int target; ///< 34962 numbers of vertices, 34963 indices
};
struct GlbAccessor {
    std::size_t view, count;
    bool indices;
    Vec3 low, high; ///< of positions, in single precision
};

/// The binary part of a GLB and what points into it.
class GlbBuffer {
public:
    /// Vectors in single precision.
    /// @return the number of the accessor
    std::size_t add_vectors(const std::vector<Vec3>& vectors);
    std::size_t add_indices(const std::vector<std::uint32_t>& indices);
    const std::vector<GlbView>& views() const { return views_; }
    const std::vector<GlbAccessor>& accessors() const { return accessors_; }
    std::size_t size() const { return bytes_.size(); }
    /// The whole file.
    std::string file(std::string_view json) const;

private:
    std::size_t add(const void* data, std::size_t bytes, int target);
    std::string bytes_;
    std::vector<GlbView> views_;
    std::vector<GlbAccessor> accessors_;
};

} // namespace lightwell
