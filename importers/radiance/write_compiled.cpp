#include "engine/base/errors.h"
#include "importers/radiance/compiled_bytes.h"
#include "importers/radiance/compiled_scene.h"
#include "importers/radiance/scene_writer.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace lightwell {
namespace {

using scene_text::ByteWriter;

/// What a file was when it was read: another size or time means that it has changed.
void write_watched(ByteWriter& out, const std::vector<std::filesystem::path>& files)
{
    out.value(static_cast<std::uint64_t>(files.size()));
    for (const std::filesystem::path& file : files) {
        std::error_code gone;
        out.text(std::filesystem::absolute(file).string());
        out.value(static_cast<std::uint64_t>(std::filesystem::file_size(file, gone)));
        out.value(static_cast<std::int64_t>(std::filesystem::last_write_time(file, gone).time_since_epoch().count()));
    }
}

using MeshNumbers = std::map<const Mesh*, std::uint32_t>;

void write_surfaces(ByteWriter& out, const std::vector<Surface>& surfaces)
{
    std::vector<std::uint8_t> shapes;
    std::vector<std::uint32_t> indices, name_ends;
    std::vector<ModifierId> modifiers;
    std::string names;
    for (const Surface& surface : surfaces) {
        shapes.push_back(static_cast<std::uint8_t>(surface.shape));
        indices.push_back(surface.index);
        modifiers.push_back(surface.modifier);
        names += surface.name;
        if (names.size() > UINT32_MAX)
            throw InputError{"compiled scene", "the names of its surfaces take more than four gigabytes"};
        name_ends.push_back(static_cast<std::uint32_t>(names.size()));
    }
    out.array(shapes);
    out.array(indices);
    out.array(modifiers);
    out.array(name_ends);
    out.text(names);
}

void write_part(ByteWriter& out, const Part& part, const MeshNumbers& meshes)
{
    out.text(part.name);
    write_surfaces(out, part.surfaces);
    out.array(part.points);
    out.array(part.polygons);
    out.array(part.spheres);
    out.array(part.cones);
    out.array(part.rings);
    out.array(part.sources);
    std::vector<std::uint32_t> numbers;
    for (const auto& mesh : part.meshes)
        numbers.push_back(meshes.at(mesh.get()));
    out.array(numbers);
    out.value(static_cast<std::uint64_t>(part.instances.size()));
    for (const Instance& instance : part.instances) {
        out.value(instance.prototype);
        out.value(instance.to_parent);
        out.array(instance.bindings);
    }
}

/// Each mesh once, however many parts hold it.
std::vector<const Mesh*> meshes_of(const Scene& scene, MeshNumbers& numbers)
{
    std::vector<const Mesh*> list;
    const auto add = [&](const Part& part) {
        for (const auto& mesh : part.meshes)
            if (numbers.try_emplace(mesh.get(), static_cast<std::uint32_t>(list.size())).second)
                list.push_back(mesh.get());
    };
    std::for_each(scene.prototypes.begin(), scene.prototypes.end(), add);
    add(scene.root);
    return list;
}

std::string one_line(const std::string& text)
{
    std::string line = text;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return line;
}

} // namespace

void write_compiled(const NamedScene& named, const CompileOptions& options, std::ostream& out)
{
    const Scene& scene = named.scene;
    Report report;
    const std::string modifiers = scene_text::SceneWriter(scene, {}, {}, report).modifiers_text();
    if (!report.notes().empty())
        throw InputError{report.notes().front().place, report.notes().front().text, "leave the transform out of it"};
    out << "#?RADIANCE\n";
    for (const std::string& line : options.header)
        out << one_line(line) << '\n';
    out << "FORMAT=Radiance_octree\n\n" << scene_text::compiled_mark;
    ByteWriter writer(out);
    writer.value(scene_text::compiled_version);
    writer.value(static_cast<std::uint32_t>(options.frozen ? 1 : 0));
    const Box cube = options.cube.value_or(bounds(scene));
    for (const Vec3& corner : {cube.low, cube.high})
        writer.value(corner);
    writer.value(static_cast<std::uint64_t>(options.frozen ? 0 : options.inputs.size()));
    if (!options.frozen)
        for (const std::string& input : options.inputs)
            writer.text(std::filesystem::absolute(input).string());
    write_watched(writer, options.frozen ? std::vector<std::filesystem::path>{} : named.files);
    writer.text(modifiers);
    writer.value(static_cast<std::uint64_t>(named.names.size()));
    for (const auto& [name, id] : named.names) {
        writer.text(name);
        writer.value(id);
    }
    MeshNumbers numbers;
    const std::vector<const Mesh*> meshes = meshes_of(scene, numbers);
    writer.value(static_cast<std::uint64_t>(meshes.size()));
    for (const Mesh* mesh : meshes) {
        writer.array(mesh->points);
        writer.array(mesh->triangles);
        writer.array(mesh->normals);
        writer.array(mesh->texture);
    }
    writer.value(static_cast<std::uint64_t>(scene.prototypes.size()));
    for (const Part& part : scene.prototypes)
        write_part(writer, part, numbers);
    write_part(writer, scene.root, numbers);
    const std::uint64_t sum = writer.sum(), size = writer.size();
    writer.value(sum);
    writer.value(size);
    writer.bytes(scene_text::compiled_end.data(), scene_text::compiled_end.size());
    if (!out.flush())
        throw InputError{"compiled scene", "cannot be written", "check free space"};
}

} // namespace lightwell
