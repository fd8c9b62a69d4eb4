#pragma once

#include "importers/dxf/drawing.h"
#include "importers/importer.h"

#include <compare>
#include <map>

namespace lightwell::dxf {

/// Layer and colour of an entity as far as they are known inside its block: what is drawn on layer 0 takes the layer
/// of the insert, what is coloured BYBLOCK the colour of the insert.
struct Style {
    enum class ColourFrom : std::uint8_t { entity, layer_of_insert, insert };
    std::uint32_t layer = no_index; ///< into Drawing::layers; no_index: that of the insert
    ColourFrom colour_from = ColourFrom::entity;
    std::int32_t colour = colour_white; ///< palette index; counts when colour_from is entity and true_colour is -1
    std::int32_t true_colour = -1;

    bool depends_on_insert() const { return layer == no_index || colour_from != ColourFrom::entity; }
    auto operator<=>(const Style&) const = default;
};

Style style_of(const Drawing& drawing, const Entity& entity, bool in_block);
/// The style that an entity of a block gets from one insert of that block.
Style inserted_style(const Drawing& drawing, const Style& inside, const Style& insert);

/// Surfaces that share a modifier.
struct SurfaceClass {
    Style style;
    std::uint32_t type = 0;              ///< into Drawing::types
    std::uint32_t block_name = no_index; ///< into Drawing::block_names; no_index: outside blocks
    auto operator<=>(const SurfaceClass&) const = default;
};

/// The modifiers of an imported drawing: one for each class of surfaces.
class ModifierTable {
public:
    ModifierTable(const Drawing& drawing, Imported& imported) : drawing_(drawing), keys_(imported) {}
    /// A place-holder when the class depends on the insert.
    ModifierId modifier_for(const SurfaceClass& what);
    /// @param material  of Imported::file_materials
    ModifierId modifier_for(const SurfaceClass& what, const std::string& material);
    SurfaceKey key_of(const SurfaceClass& what) const;

private:
    const Drawing& drawing_;
    KeyTable keys_;
    std::map<SurfaceClass, ModifierId> known_;
};

} // namespace lightwell::dxf
