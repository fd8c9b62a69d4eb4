#include "importers/obj/corner_index.h"

#include "engine/base/random.h"

#include <algorithm>

namespace lightwell {

std::size_t CornerIndex::slot_of(const ObjCorner& corner) const noexcept
{
    const auto bits = [](std::int32_t index) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(index)); };
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = mix_bits(bits(corner.point) << 32 | bits(corner.normal), bits(corner.texture)) & mask;
    while (slots_[slot] != 0 && !(corners_[slots_[slot] - 1] == corner))
        slot = (slot + 1) & mask;
    return slot;
}

void CornerIndex::grow()
{
    constexpr std::size_t first_size = 64;
    slots_.assign(std::max(first_size, 2 * slots_.size()), 0);
    for (std::uint32_t i = 0; i < size(); ++i)
        slots_[slot_of(corners_[i])] = i + 1;
}

std::uint32_t CornerIndex::find_or_add(const ObjCorner& corner)
{
    if (2 * (corners_.size() + 1) > slots_.size())
        grow();
    std::uint32_t& found = slots_[slot_of(corner)];
    if (found == 0) {
        corners_.push_back(corner);
        found = size();
    }
    return found - 1;
}

} // namespace lightwell
