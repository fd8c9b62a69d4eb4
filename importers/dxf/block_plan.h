#pragma once

#include "engine/base/transform.h"
#include "importers/dxf/shapes.h"

namespace lightwell::dxf {

/// A block as it is used: inserts on a layer that is switched off hide what the block has on layer 0.
struct BlockUse {
    std::uint32_t block = no_index;
    bool hides_layer_zero = false;
    double largest_scale = 0; ///< of all copies of this block in the model: file units per block unit
    auto operator<=>(const BlockUse&) const = default;
};

/// Where the copies of an INSERT stand; more than one for an array (MINSERT).
struct InsertFrame {
    Affine first; ///< block to the frame around the insert
    Vec3 column_step, row_step;
    std::uint32_t columns = 1, rows = 1;
    double largest_scale = 1;
    bool has_zero_scale = false; ///< the file says 0 for some axis; 1 is used
};

/// @throws InputError: more copies than a drawing may have
InsertFrame insert_frame(const Drawing& drawing, const Entity& insert);

/// Why an entity is not seen; nullptr: it is.
/// @param around  the block it is drawn in, or nullptr in the model
Reason hidden_reason(const Drawing& drawing, const Entity& entity, const BlockUse* around);
/// The block that an INSERT copies.
/// @return the reason when there is none
Reason find_inserted(const Drawing& drawing, const Entity& insert, const BlockUse* around, BlockUse& inserted);

/// Every block that the visible model uses, directly or through other blocks, those inside others first.
/// @throws InputError: a block that contains itself, or nesting beyond 64 levels; both name the chain of blocks
std::vector<BlockUse> plan_blocks(const Drawing& drawing);

} // namespace lightwell::dxf
