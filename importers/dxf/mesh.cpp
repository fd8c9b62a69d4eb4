#include "engine/base/errors.h"
#include "importers/dxf/shapes.h"

#include <fmt/format.h>

namespace lightwell::dxf {
namespace {

/// Group codes of a MESH. Each count is followed by its list; the lists of faces and edges have the same code.
enum MeshCode { level = 91, point_count = 92, face_list = 93, index = 90, edge_count = 94 };

/// The numbers of the face list: for each face the number of its corners, then the corners.
Values face_list_of(Values values)
{
    const auto has = [](int code) { return [code](const Value& value) { return value.code == code; }; };
    const auto begin = std::find_if(values.begin(), values.end(), has(face_list));
    if (begin == values.end())
        return {};
    return {begin + 1, std::find_if(begin, values.end(), has(edge_count))};
}

} // namespace

Reason add_mesh(const Drawing& drawing, const Entity& entity, Shapes& shapes)
{
    const std::vector<Point> points = points_with(10, entity.values);
    const std::vector<double> list = numbers_with(index, face_list_of(entity.values));
    const auto bad = [&](const char* what, double found, double most) {
        return InputError{drawing.place(entity), fmt::format("{} is {}, expected 0 to {}", what, found, most),
                          "save the drawing again or delete the entity"};
    };
    std::vector<Point> corners;
    for (std::size_t at = 0; at < list.size();) {
        const auto left = static_cast<double>(list.size() - at - 1);
        if (!(list[at] >= 0 && list[at] <= left))
            throw bad("number of corners of a face", list[at], left);
        const std::size_t end = at + 1 + static_cast<std::size_t>(list[at]);
        corners.clear();
        for (++at; at < end; ++at) {
            if (!(list[at] >= 0 && list[at] < static_cast<double>(points.size())))
                throw bad("corner of a face", list[at], static_cast<double>(points.size()) - 1);
            corners.push_back(points[static_cast<std::size_t>(list[at])]);
        }
        shapes.add_face(corners);
    }
    if (Fields{entity.values}.get(level) > 0)
        ++shapes.deviations.cages;
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
