#pragma once

#include "importers/obj/obj_file.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Numbers the different corners of a mesh in order of appearance. Open addressing: a million corners ask.
class CornerIndex {
public:
    /// @return the number of this corner; size() before the call when it is a new one
    std::uint32_t find_or_add(const ObjCorner& corner);
    std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(corners_.size()); }

private:
    void grow();
    std::size_t slot_of(const ObjCorner& corner) const noexcept;
    std::vector<ObjCorner> corners_;   ///< by number
    std::vector<std::uint32_t> slots_; ///< number + 1, 0 where free; a power of two, at most half full
};

} // namespace lightwell
