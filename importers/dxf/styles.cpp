#include "importers/dxf/styles.h"

namespace lightwell::dxf {
namespace {

Style coloured_by_layer(Style style, const Drawing& drawing)
{
    if (style.layer == no_index) {
        style.colour_from = Style::ColourFrom::layer_of_insert;
        return style;
    }
    style.colour_from = Style::ColourFrom::entity;
    style.colour = drawing.layers[style.layer].colour;
    style.true_colour = drawing.layers[style.layer].true_colour;
    return style;
}

} // namespace

Style style_of(const Drawing& drawing, const Entity& entity, bool in_block)
{
    constexpr std::uint32_t layer_zero = 0;
    Style style;
    style.layer = in_block && entity.layer == layer_zero ? no_index : entity.layer;
    if (entity.true_colour >= 0)
        style.true_colour = entity.true_colour;
    else if (entity.colour == colour_by_layer)
        return coloured_by_layer(style, drawing);
    else if (entity.colour == colour_by_block && in_block)
        style.colour_from = Style::ColourFrom::insert;
    else if (entity.colour != colour_by_block)
        style.colour = entity.colour;
    return style;
}

Style inserted_style(const Drawing& drawing, const Style& inside, const Style& insert)
{
    Style style = inside;
    if (style.layer == no_index)
        style.layer = insert.layer;
    if (inside.colour_from == Style::ColourFrom::entity)
        return style;
    Style source = insert;
    if (inside.colour_from == Style::ColourFrom::layer_of_insert)
        source = coloured_by_layer(insert, drawing);
    style.colour_from = source.colour_from;
    style.colour = source.colour;
    style.true_colour = source.true_colour;
    return style;
}

SurfaceKey ModifierTable::key_of(const SurfaceClass& what) const
{
    const Style& style = what.style;
    SurfaceKey key;
    key.layer = style.layer == no_index ? drawing_.layers[0].name : drawing_.layers[style.layer].name;
    key.block = what.block_name == no_index ? "" : drawing_.block_names[what.block_name];
    key.entity = drawing_.types[what.type];
    if (style.colour_from == Style::ColourFrom::entity)
        key.colour = style.true_colour >= 0 ? true_colour(style.true_colour) : palette_colour(style.colour);
    else // tells the place-holders apart
        key.group = style.colour_from == Style::ColourFrom::insert ? "BYBLOCK" : "BYLAYER";
    return key;
}

ModifierId ModifierTable::modifier_for(const SurfaceClass& what)
{
    const auto [entry, fresh] = known_.try_emplace(what, void_modifier);
    if (fresh)
        entry->second =
            what.style.depends_on_insert() ? keys_.inherited(key_of(what)) : keys_.modifier_for(key_of(what));
    return entry->second;
}

ModifierId ModifierTable::modifier_for(const SurfaceClass& what, const std::string& material)
{
    SurfaceKey key = key_of(what);
    key.material = material;
    key.colour.reset(); // the colour of its symbol
    return keys_.modifier_for(key);
}

} // namespace lightwell::dxf
