#include "engine/base/errors.h"
#include "importers/dxf/geometry.h"
#include "importers/dxf/shapes.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightwell::dxf {
namespace {

enum VertexFlag { spline_frame = 16, mesh_vertex = 64, polyface_record = 128 };

/// The corners of 3DFACE, SOLID and TRACE; a missing fourth is the third.
std::array<Point, 4> four_corners(const Fields& fields)
{
    const Point third = fields.point(12);
    return {fields.point(10), fields.point(11), third, fields.has(13) ? fields.point(13) : third};
}

/// One face record: its corners by number, negative where the edge that follows is invisible.
void add_polyface_face(const Drawing& drawing, const Entity& entity, const Fields& record, std::uint64_t place,
                       const std::vector<Point>& points, Shapes& shapes)
{
    std::vector<Point> corners;
    for (int code = 71; code <= 74; ++code) {
        const double number = std::fabs(record.get(code));
        if (number == 0)
            continue;
        if (!(number <= static_cast<double>(points.size())))
            throw InputError{drawing.place(place),
                             fmt::format("{} \"{}\" on layer \"{}\": face refers to vertex {}, expected 1 to {}",
                                         drawing.types[entity.type], drawing.name(entity),
                                         drawing.layers[entity.layer].name, record.get(code), points.size()),
                             "save the drawing again or delete the entity"};
        corners.push_back(points[static_cast<std::size_t>(number) - 1]);
    }
    shapes.add_face(corners); // two corners are an edge and add nothing
}

/// The grid of a polygon mesh: rows of columns points, with smoothing its fitted points.
struct Grid {
    std::size_t rows = 0, columns = 0;
    std::vector<Point> points;
};

Grid grid_of(const Drawing& drawing, const Entity& entity, const VertexList& list)
{
    constexpr int smoothed = 4;
    Grid grid;
    for (const auto& vertex : list.vertices)
        if (!(Fields{vertex}.flags(70) & spline_frame) || !(list.header.flags(70) & smoothed))
            grid.points.push_back(Fields{vertex}.point(10));
    const bool fitted = (list.header.flags(70) & smoothed) && list.header.get(73) > 0 && list.header.get(74) > 0;
    const double rows = list.header.get(fitted ? 73 : 71), columns = list.header.get(fitted ? 74 : 72);
    if (!(rows >= 2 && columns >= 2 && rows * columns == static_cast<double>(grid.points.size())))
        throw InputError{drawing.place(entity),
                         fmt::format("polygon mesh of {} x {} has {} vertices, expected {} and at least 2 x 2", rows,
                                     columns, grid.points.size(), rows * columns),
                         "save the drawing again or delete the entity"};
    grid.rows = static_cast<std::size_t>(rows);
    grid.columns = static_cast<std::size_t>(columns);
    return grid;
}

} // namespace

VertexList::VertexList(Values values) : header(values)
{
    const auto begins = [](const Value& value) { return value.code == vertex_begins; };
    auto at = std::find_if(values.begin(), values.end(), begins);
    header = Fields{{values.begin(), at}};
    while (at != values.end()) {
        const auto next = std::find_if(at + 1, values.end(), begins);
        vertices.emplace_back(at + 1, next);
        places.push_back(static_cast<std::uint64_t>(at->number));
        at = next;
    }
}

Reason add_face(const Fields& fields, Shapes& shapes)
{
    const auto [a, b, c, d] = four_corners(fields);
    shapes.add_quad(a, b, c, d);
    return shapes.empty() ? &no_area : nullptr;
}

Reason add_solid(const Fields& fields, const ShapeOptions& options, Shapes& shapes)
{
    const Affine axes = object_axes(fields.extrusion());
    const auto drawn = four_corners(fields);
    const double thickness = thickness_of(fields, options);
    // Drawn in the order of a bow tie: the outline runs first, second, fourth, third corner.
    std::vector<Point> outline;
    for (const std::size_t i : {0, 1, 3, 2})
        outline.push_back(axes.point(drawn[i] + Vec3{0, 0, std::fmin(thickness, 0.0)}));
    if (thickness == 0) {
        shapes.add_quad(outline[0], outline[1], outline[2], outline[3]);
        return shapes.empty() ? &no_area : nullptr;
    }
    if (dot(polygon_area_vector(outline.data(), outline.size()), axes.z) < 0)
        std::reverse(outline.begin(), outline.end());
    const Vec3 height = axes.z * std::fabs(thickness);
    shapes.add_quad(outline[3], outline[2], outline[1], outline[0]);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point &from = outline[i], &to = outline[(i + 1) % outline.size()];
        shapes.add_polygon({from, to, to + height, from + height});
    }
    shapes.add_quad(outline[0] + height, outline[1] + height, outline[2] + height, outline[3] + height);
    return shapes.empty() ? &no_area : nullptr;
}

Reason add_polyface(const Drawing& drawing, const Entity& entity, Shapes& shapes)
{
    const VertexList list{entity.values};
    const auto is_face = [&](std::size_t i) {
        const int flags = Fields{list.vertices[i]}.flags(70);
        return (flags & polyface_record) && !(flags & mesh_vertex);
    };
    std::vector<Point> points;
    for (std::size_t i = 0; i < list.vertices.size(); ++i)
        if (!is_face(i))
            points.push_back(Fields{list.vertices[i]}.point(10));
    for (std::size_t i = 0; i < list.vertices.size(); ++i)
        if (is_face(i))
            add_polyface_face(drawing, entity, Fields{list.vertices[i]},
                              place_in_file(list.places[i], entity.place >> file_bit), points, shapes);
    return shapes.empty() ? &no_area : nullptr;
}

Reason add_polygon_mesh(const Drawing& drawing, const Entity& entity, Shapes& shapes)
{
    constexpr int closed_in_rows = 1, closed_in_columns = 32;
    const VertexList list{entity.values};
    const Grid grid = grid_of(drawing, entity, list);
    const int flags = list.header.flags(70);
    const std::size_t last_row = flags & closed_in_rows ? grid.rows : grid.rows - 1;
    const std::size_t last_column = flags & closed_in_columns ? grid.columns : grid.columns - 1;
    const auto point = [&](std::size_t row, std::size_t column) {
        return grid.points[row % grid.rows * grid.columns + column % grid.columns];
    };
    for (std::size_t row = 0; row < last_row; ++row)
        for (std::size_t column = 0; column < last_column; ++column)
            shapes.add_quad(point(row, column), point(row, column + 1), point(row + 1, column + 1),
                            point(row + 1, column));
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
