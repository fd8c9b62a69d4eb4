#pragma once

#include "importers/layers.h"

#include <cstdint>
#include <vector>

namespace lightwell {

/// Tells surfaces apart that rules with `area` or `size` may treat differently. Area in m^2 and size (the longest side
/// of the bounding box) in metres are those of a surface as its block draws it; a mesh is one surface.
class GeometryClasses {
public:
    /// Gives surfaces that fit some of the map's conditions keys and modifiers of their own, in prototypes and
    /// instances too. Without such rules nothing is touched.
    /// @throws InputError for more than 64 different conditions
    GeometryClasses(Imported& imported, const LayerMap& map);
    /// Whether the surfaces of a modifier fit the rule's area and size.
    bool fits(std::size_t modifier, std::size_t rule) const
    {
        return bit_of_rule_[rule] == 0 || (modifier < fits_.size() && (fits_[modifier] & bit_of_rule_[rule]) != 0);
    }

private:
    std::vector<std::uint64_t> bit_of_rule_; ///< 0: the rule asks for no geometry
    std::vector<std::uint64_t> fits_;        ///< by modifier: the conditions that its surfaces fit
};

} // namespace lightwell
