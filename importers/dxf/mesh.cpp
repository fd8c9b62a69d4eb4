#include "engine/base/errors.h"
#include "engine/geometry/limit_surface.h"
#include "importers/dxf/shapes.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightwell::dxf {
namespace {

/// Group codes of a MESH. Each count is followed by its list; the lists of faces and edges have the same code.
enum MeshCode { level = 91, face_list = 93, index = 90, edge_count = 94, crease_count = 95, crease = 140 };

/// The numbers between two codes, of which the second may be missing.
Values between(int first, int last, Values values)
{
    const auto has = [](int code) { return [code](const Value& value) { return value.code == code; }; };
    const auto begin = std::find_if(values.begin(), values.end(), has(first));
    if (begin == values.end())
        return {};
    return {begin + 1, std::find_if(begin, values.end(), has(last))};
}

/// Checked: each face of the file's list, and the corners that are not there.
class CageReader {
public:
    CageReader(const Drawing& drawing, const Entity& entity) : drawing_(drawing), entity_(entity) {}
    SubdivisionCage read() const;

private:
    std::uint32_t checked(const char* what, double found, double most) const
    {
        if (!(found >= 0 && found <= most))
            throw InputError{drawing_.place(entity_), fmt::format("{} is {}, expected 0 to {}", what, found, most),
                             "save the drawing again or delete the entity"};
        return static_cast<std::uint32_t>(found);
    }
    void read_faces(SubdivisionCage& cage) const;
    void read_creases(SubdivisionCage& cage) const;

    const Drawing& drawing_;
    const Entity& entity_;
};

void CageReader::read_faces(SubdivisionCage& cage) const
{
    // For each face the number of its corners, then the corners.
    const std::vector<double> list = numbers_with(index, between(face_list, edge_count, entity_.values));
    const double last = static_cast<double>(cage.points.size()) - 1;
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t left = list.size() - at - 1;
        const std::uint32_t size = checked("number of corners of a face", list[at], static_cast<double>(left));
        const std::size_t end = ++at + size;
        if (size >= 3)
            cage.face_sizes.push_back(size);
        for (; at < end; ++at) {
            const std::uint32_t corner = checked("corner of a face", list[at], last);
            if (size >= 3)
                cage.corners.push_back(corner);
        }
    }
}

void CageReader::read_creases(SubdivisionCage& cage) const
{
    const std::vector<double> ends = numbers_with(index, between(edge_count, crease_count, entity_.values));
    const std::vector<double> values = numbers_with(crease, entity_.values);
    const double last = static_cast<double>(cage.points.size()) - 1;
    for (std::size_t i = 0; i < values.size() && 2 * i + 1 < ends.size(); ++i)
        if (values[i] != 0) // below 0: always sharp
            cage.creases.push_back({checked("end of an edge", ends[2 * i], last),
                                    checked("end of an edge", ends[2 * i + 1], last),
                                    values[i] < 0 ? fully_sharp : values[i]});
}

SubdivisionCage CageReader::read() const
{
    SubdivisionCage cage;
    cage.points = points_with(10, entity_.values);
    read_faces(cage);
    read_creases(cage);
    return cage;
}

} // namespace

Reason add_mesh(const Drawing& drawing, const Entity& entity, const ShapeOptions& options, Shapes& shapes)
{
    const SubdivisionCage cage = CageReader{drawing, entity}.read();
    if (cage.face_sizes.empty())
        return &no_area;
    if (Fields{entity.values}.get(level) > 0) {
        LimitSurface smooth = limit_surface(cage, options.chord_tolerance, drawing.place(entity));
        if (smooth.mesh.triangles.empty())
            return &no_area;
        shapes.deviations.limit_triangles += smooth.mesh.triangles.size() / 3;
        shapes.deviations.limit_error = smooth.largest_deviation_m; // here in drawing units, like the cage
        shapes.meshes.push_back(std::move(smooth.mesh));
        return nullptr;
    }
    std::vector<Point> corners;
    auto corner = cage.corners.begin();
    for (const std::uint32_t size : cage.face_sizes) {
        corners.clear();
        for (const auto end = corner + size; corner != end; ++corner)
            corners.push_back(cage.points[*corner]);
        shapes.add_face(corners);
    }
    return shapes.empty() ? &no_area : nullptr;
}

} // namespace lightwell::dxf
