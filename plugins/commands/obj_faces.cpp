#include "plugins/commands/obj_faces.h"

#include "engine/base/files.h"
#include "engine/geometry/triangulate.h"
#include "engine/scene/surface.h"
#include "plugins/commands/library_path.h"

#include <filesystem>
#include <ostream>

namespace lightwell::commands {
namespace {

std::vector<Point> outline_of(const ObjFile& file, const ObjFace& face)
{
    std::vector<Point> outline;
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i)
        outline.push_back(file.points[static_cast<std::size_t>(file.corners[i].point)]);
    return outline;
}

} // namespace

ObjFile read_obj_input(const std::string& name, const Streams& streams)
{
    if (name.empty())
        return read_obj(whole_stream(streams.in), "standard input");
    if (!std::filesystem::is_regular_file(name))
        throw Fatal("cannot open \"" + name + "\"");
    return read_obj(MappedFile(name).bytes(), name);
}

void warn_of_unknown_statements(const std::string& program, const ObjFile& file, std::ostream& err)
{
    if (file.unknown_statements > 0)
        err << program << ": warning - " << file.unknown_statements << " statements unrecognized\n";
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const ObjFile& file, const ObjFace& face)
{
    if (face.count == 3)
        return {{face.first, face.first + 1, face.first + 2}};
    const std::vector<Point> outline = outline_of(file, face);
    std::vector<std::array<std::uint32_t, 3>> triangles = triangulate(outline.data(), outline.size());
    for (auto& triangle : triangles)
        for (std::uint32_t& corner : triangle)
            corner += face.first;
    return triangles;
}

Vec3 flat_normal(const ObjFile& file, const ObjFace& face)
{
    const std::vector<Point> outline = outline_of(file, face);
    return normalized(polygon_area_vector(outline.data(), outline.size()));
}

} // namespace lightwell::commands
