#include "importers/radiance/ply_mesh.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/radiance/ply_file.h"
#include "importers/radiance/surface_text.h"
#include "importers/radiance/words.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace lightwell::scene_text {
namespace {

/// More names than this are no list of materials.
constexpr long long most_modifiers = 1 << 16;

class MeshChecker {
public:
    MeshChecker(const PlyFile& file, const std::string& name) : file_(file), name_(name) {}

    PlyMesh check()
    {
        const PlyElement& vertices = element("vertex");
        const PlyElement& faces = element("face");
        read_header();
        read_points(vertices);
        read_faces(faces);
        read_face_modifiers(faces);
        read_corners(vertices, faces);
        read_creases();
        return std::move(mesh_);
    }

private:
    [[noreturn]] void reject(const std::string& what, const std::string& hint = {}) const
    {
        throw InputError{name_, what, hint};
    }

    const PlyElement& element(const char* element_name) const
    {
        const PlyElement* found = file_.find(element_name);
        if (found == nullptr)
            reject(fmt::format("there is no element \"{}\"", element_name), "a mesh part has vertices and faces");
        return *found;
    }

    const std::vector<double>& numbers(const PlyElement& element, std::string_view property) const
    {
        const PlyColumn* column = element.find(property);
        if (column == nullptr || column->list)
            reject(fmt::format("element \"{}\" has no property \"{}\" of single numbers", element.name, property));
        for (std::size_t i = 0; i < column->values.size(); ++i)
            if (!std::isfinite(column->values[i]))
                reject(fmt::format("{} {}: {} is not finite", element.name, i, property), "export it again");
        return column->values;
    }

    void read_header()
    {
        for (const std::string& comment : file_.comments) {
            const std::vector<std::string_view> words = split(comment);
            if (words.size() == 3 && words[0] == "modifier") {
                const auto number = parse_integer(words[1]);
                if (!number || *number < 0 || *number >= most_modifiers)
                    reject(fmt::format("`comment {}`: expected a number from 0 to {}", comment, most_modifiers - 1));
                const auto at = static_cast<std::size_t>(*number);
                mesh_.modifiers.resize(std::max(mesh_.modifiers.size(), at + 1));
                mesh_.modifiers[at] = decoded_name(words[2]);
            } else if (words.size() == 2 && words[0] == "boundary") {
                if (words[1] != "smooth" && words[1] != "sharp_corners")
                    reject(fmt::format("`comment {}`: expected smooth or sharp_corners", comment));
                mesh_.cage.keep_boundary_corners = words[1] == "sharp_corners";
            }
        }
    }

    void read_points(const PlyElement& vertices)
    {
        if (vertices.count > std::numeric_limits<std::uint32_t>::max())
            reject(fmt::format("{} vertices are too many for one part", vertices.count));
        const auto &x = numbers(vertices, "x"), &y = numbers(vertices, "y"), &z = numbers(vertices, "z");
        mesh_.cage.points.reserve(x.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            mesh_.cage.points.push_back({x[i], y[i], z[i]});
    }

    std::uint32_t vertex(double value, const std::string& who) const
    {
        if (!(value >= 0 && value < static_cast<double>(mesh_.cage.points.size()) && value == std::floor(value)))
            reject(fmt::format("{} names vertex {} of {}", who, value, mesh_.cage.points.size()), "export it again");
        return static_cast<std::uint32_t>(value);
    }

    void read_faces(const PlyElement& faces)
    {
        const PlyColumn* corners = faces.find("vertex_indices");
        if (corners == nullptr)
            corners = faces.find("vertex_index");
        if (corners == nullptr || !corners->list)
            reject("the faces have no list \"vertex_indices\"");
        mesh_.cage.face_sizes = corners->sizes;
        mesh_.cage.corners.reserve(corners->values.size());
        std::size_t next = 0;
        for (std::size_t face = 0; face < corners->sizes.size(); ++face) {
            const std::string who = fmt::format("face {}", face);
            if (corners->sizes[face] < 3)
                reject(fmt::format("{} has {} corners, expected at least 3", who, corners->sizes[face]));
            for (std::uint32_t i = 0; i < corners->sizes[face]; ++i)
                mesh_.cage.corners.push_back(vertex(corners->values[next++], who));
        }
    }

    void read_face_modifiers(const PlyElement& faces)
    {
        if (faces.find("modifier") == nullptr)
            return;
        for (const double value : numbers(faces, "modifier")) {
            const bool named = value >= 0 && value < static_cast<double>(mesh_.modifiers.size()) &&
                               !mesh_.modifiers[static_cast<std::size_t>(value)].empty();
            if (!named && value != -1)
                reject(fmt::format("face {} has modifier {}, for which the header has no name",
                                   mesh_.face_modifiers.size(), value),
                       "add a line `comment modifier NUMBER NAME`");
            mesh_.face_modifiers.push_back(static_cast<std::int32_t>(value));
        }
    }

    /// Values of a list with `width` numbers for each corner; null when there is none.
    const std::vector<double>* corner_list(const PlyElement& faces, const char* property, std::uint32_t width) const
    {
        const PlyColumn* column = faces.find(property);
        if (column == nullptr)
            return nullptr;
        for (std::size_t face = 0; face < faces.count; ++face)
            if (!column->list || column->sizes[face] != width * mesh_.cage.face_sizes[face])
                reject(fmt::format("face {}: {} numbers in \"{}\", expected {} for each of {} corners", face,
                                   column->list ? column->sizes[face] : 1, property, width,
                                   mesh_.cage.face_sizes[face]));
        for (std::size_t i = 0; i < column->values.size(); ++i)
            if (!std::isfinite(column->values[i]))
                reject(fmt::format("number {} of \"{}\" is not finite", i, property), "export it again");
        return &column->values;
    }

    void add_normal(const Vec3& normal)
    {
        const double size = length(normal);
        mesh_.normals.push_back(size > 0 ? unit_vector(normal) : Direction{0, 0, 0});
    }

    void read_corners(const PlyElement& vertices, const PlyElement& faces)
    {
        if (const auto* list = corner_list(faces, "normals", 3)) {
            for (std::size_t i = 0; i + 2 < list->size(); i += 3)
                add_normal({(*list)[i], (*list)[i + 1], (*list)[i + 2]});
        } else if (vertices.find("nx") != nullptr) {
            const auto &x = numbers(vertices, "nx"), &y = numbers(vertices, "ny"), &z = numbers(vertices, "nz");
            for (const std::uint32_t corner : mesh_.cage.corners)
                add_normal({x[corner], y[corner], z[corner]});
        }
        if (const auto* list = corner_list(faces, "s_t", 2)) {
            mesh_.texture = *list;
        } else if (vertices.find("s") != nullptr) {
            const auto &s = numbers(vertices, "s"), &t = numbers(vertices, "t");
            for (const std::uint32_t corner : mesh_.cage.corners)
                mesh_.texture.insert(mesh_.texture.end(), {s[corner], t[corner]});
        }
    }

    void read_creases()
    {
        if (const PlyElement* edges = file_.find("edge"); edges != nullptr && edges->find("sharpness") != nullptr) {
            const auto &from = numbers(*edges, "vertex1"), &to = numbers(*edges, "vertex2");
            const auto& sharpness = numbers(*edges, "sharpness");
            for (std::size_t i = 0; i < sharpness.size(); ++i) {
                const std::string who = fmt::format("edge {}", i);
                mesh_.cage.creases.push_back({vertex(from[i], who), vertex(to[i], who), sharpness[i]});
            }
        }
        if (const PlyElement* tips = file_.find("corner")) {
            const auto &points = numbers(*tips, "vertex"), &sharpness = numbers(*tips, "sharpness");
            for (std::size_t i = 0; i < sharpness.size(); ++i)
                mesh_.cage.tips.push_back({vertex(points[i], fmt::format("corner {}", i)), sharpness[i]});
        }
    }

    const PlyFile& file_;
    const std::string& name_;
    PlyMesh mesh_;
};

} // namespace

PlyMesh read_ply_mesh(std::string_view bytes, const std::string& name)
{
    const PlyFile file = read_ply(bytes, name);
    return MeshChecker(file, name).check();
}

} // namespace lightwell::scene_text
