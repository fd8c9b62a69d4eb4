#include "importers/dxf/drawing_reader.h"

#include "engine/base/text.h"

namespace lightwell::dxf {

void DrawingReader::read_tables()
{
    while (!is(0, "ENDSEC")) {
        if (is(0, "LAYER"))
            read_layer();
        else if (is(0, "VIEW") || is(0, "VPORT"))
            read_view(is(0, "VPORT"));
        else
            advance("section TABLES");
    }
}

void DrawingReader::read_layer()
{
    constexpr int frozen_flag = 1;
    Layer layer;
    for (advance("table LAYER"); tag_.code != 0; advance("table LAYER")) {
        if (tag_.code == 2)
            layer.name = trimmed(tag_.text);
        else if (tag_.code == 70)
            layer.is_frozen = integer("layer table") & frozen_flag;
        else if (tag_.code == 62)
            layer.colour = integer("layer table");
        else if (tag_.code == 420)
            layer.true_colour = integer("layer table");
        else if (tag_.code == 290)
            layer.is_plotted = integer("layer table") != 0;
    }
    layer.is_off = layer.colour < 0;
    layer.is_defined = true;
    layer.colour = std::abs(layer.colour);
    const std::uint32_t index = layer_index(layer.name);
    layer.name = drawing_.layers[index].name;
    drawing_.layers[index] = std::move(layer);
}

void DrawingReader::read_view(bool is_viewport)
{
    constexpr int last_geometry = 79;
    TableView view;
    view.is_viewport = is_viewport;
    view.place = tag_.place;
    for (advance("a view"); tag_.code != 0; advance("a view")) {
        if (tag_.code == 2)
            view.name = code_page_.decoded(trimmed(tag_.text));
        else if (tag_.code >= 10 && tag_.code <= last_geometry)
            view.values.push_back({tag_.code, number("a view")});
    }
    drawing_.views.push_back(std::move(view));
}

} // namespace lightwell::dxf
