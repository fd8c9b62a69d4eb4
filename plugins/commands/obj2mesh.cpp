#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/obj/corner_index.h"
#include "importers/radiance/mesh_text.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"
#include "plugins/commands/obj_faces.h"
#include "plugins/commands/scene_files.h"

#include <filesystem>
#include <map>
#include <ostream>

namespace lightwell::commands {
namespace {

struct Wish {
    std::vector<std::string> materials;
    bool warnings = true;
    std::string input, output;
};

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    std::size_t i = 1;
    for (; i < words.size() && words[i].size() > 1 && words[i][0] == '-'; ++i) {
        const std::string& option = words[i];
        if (option == "-w") {
            wish.warnings = false;
            continue;
        }
        if ((option != "-a" && option != "-l" && option != "-n" && option != "-r") || i + 1 == words.size())
            throw Fatal("unknown option: '" + option + "'");
        const std::string& value = words[++i];
        if (option == "-a" || option == "-l")
            wish.materials.push_back(value);
        else if (const auto number = parse_integer(value); !number || *number < 1) // how finely Radiance divides space
            throw Fatal("bad number in option '" + option + "'");
    }
    if (i + 2 < words.size())
        throw Fatal("too many file arguments: '" + words[i + 2] + "'");
    if (i < words.size())
        wish.input = words[i];
    if (i + 1 < words.size())
        wish.output = words[i + 1];
    return wish;
}

std::string material_text(const Wish& wish)
{
    std::string text;
    for (const std::string& name : wish.materials) {
        const auto found = find_in_library(name);
        if (!found)
            throw Fatal("cannot open scene file \"" + name + "\": not found");
        text.append(MappedFile(*found).bytes()).append("\n");
    }
    return text;
}

/// The faces of each material as a mesh of triangles. Where some corners of a material have normals, the others get
/// those of their faces.
std::map<std::string, Mesh> meshes_of(const ObjFile& file)
{
    std::map<std::string, bool> has_normals, all_texture;
    for (const ObjFace& face : file.faces) {
        const std::string& material = file.states[face.state].material;
        all_texture.try_emplace(material, true);
        for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
            has_normals[material] |= file.corners[i].normal >= 0;
            all_texture[material] &= file.corners[i].texture >= 0;
        }
    }
    std::map<std::string, Mesh> meshes;
    std::map<std::string, CornerIndex> known;
    for (const ObjFace& face : file.faces) {
        const std::string& material = file.states[face.state].material;
        const Vec3 flat = flat_normal(file, face);
        if (flat == Vec3{})
            continue;
        Mesh& mesh = meshes[material];
        for (const auto& triangle : triangles_of(file, face))
            for (const std::uint32_t i : triangle) {
                const ObjCorner& corner = file.corners[i];
                ObjCorner shared = corner;
                if (corner.normal < 0 && has_normals[material]) // that of this face alone
                    shared.normal = -1 - static_cast<std::int32_t>(face.number);
                mesh.triangles.push_back(known[material].find_or_add(shared));
                if (mesh.triangles.back() < mesh.points.size())
                    continue;
                mesh.points.push_back(file.points[static_cast<std::size_t>(corner.point)]);
                if (has_normals[material])
                    mesh.normals.push_back(
                        corner.normal >= 0 ? normalized(file.normals[static_cast<std::size_t>(corner.normal)]) : flat);
                if (all_texture[material]) {
                    const auto at = static_cast<std::ptrdiff_t>(2 * corner.texture);
                    mesh.texture.insert(mesh.texture.end(), file.texture.begin() + at, file.texture.begin() + at + 2);
                }
            }
    }
    return meshes;
}

} // namespace

/// obj2mesh: a Wavefront file and materials as one mesh file, which `mesh` in scene text names. Nothing is written
/// before everything has been read.
int obj2mesh(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    const ObjFile file = read_obj_input(wish.input, streams);
    const std::string materials = material_text(wish);
    const std::map<std::string, Mesh> meshes = meshes_of(file);
    if (meshes.empty())
        throw Fatal("no faces in \"" + file.name + "\"");
    const std::string whole = scene_text::mesh_file(command_line_of(words), materials, meshes);
    if (wish.warnings)
        warn_of_unknown_statements(words[0], file, streams.err);
    if (wish.output.empty())
        streams.out << whole;
    else
        write_text_atomically(wish.output, whole);
    return 0;
}

} // namespace lightwell::commands
