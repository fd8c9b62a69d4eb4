#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/compiled_bytes.h"
#include "importers/radiance/compiled_scene.h"
#include "importers/radiance/scene_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace lightwell {
namespace {

/// The header is short text; its end is looked for no further.
constexpr std::size_t longest_header = 1 << 20;

std::size_t end_of_header(std::string_view bytes) noexcept
{
    if (!bytes.starts_with("#?RADIANCE"))
        return std::string_view::npos;
    const std::size_t end = bytes.substr(0, longest_header).find("\n\n");
    return end == std::string_view::npos ? end : end + 2;
}

[[noreturn]] void refuse(const std::string& place, const std::string& what)
{
    throw InputError{place, "the compiled scene " + what, "compile it again with oconv"};
}

} // namespace

bool is_compiled_scene(std::string_view bytes) noexcept
{
    const std::size_t end = end_of_header(bytes);
    return end != std::string_view::npos && bytes.substr(end).starts_with(scene_text::compiled_mark);
}

CompiledHead compiled_head(std::string_view bytes, const std::string& place)
{
    CompiledHead head;
    const std::size_t end = end_of_header(bytes);
    for (const std::string_view line : split(bytes.substr(0, end), "\n"))
        if (!line.starts_with("#?") && !line.starts_with("FORMAT="))
            head.header.emplace_back(line);
    head.body = end + scene_text::compiled_mark.size();
    const std::string_view body = bytes.substr(head.body);
    const std::size_t tail = 2 * sizeof(std::uint64_t) + scene_text::compiled_end.size();
    if (body.size() < tail || !body.ends_with(scene_text::compiled_end))
        refuse(place, "is cut off");
    scene_text::ByteReader trailer(body.substr(body.size() - tail), place);
    const auto sum = trailer.value<std::uint64_t>(), size = trailer.value<std::uint64_t>();
    if (size != body.size() - tail)
        refuse(place, "is cut off");
    scene_text::ByteReader reader(body, place);
    if (const auto version = reader.value<std::uint32_t>(); version != scene_text::compiled_version)
        refuse(place, fmt::format("has version {}, expected {}", version, scene_text::compiled_version));
    scene_text::ByteSum check;
    check.add(body.data(), size);
    if (check.sum() != sum)
        refuse(place, "is damaged: its checksum differs");
    head.frozen = reader.value<std::uint32_t>() != 0;
    head.cube.low = reader.value<Vec3>();
    head.cube.high = reader.value<Vec3>();
    return head;
}

namespace scene_text {
namespace {

/// Modifiers by their number in the file.
class Renumbering {
public:
    Renumbering(const std::vector<ModifierId>& ids, const std::string& place) : ids_(ids), place_(place) {}
    ModifierId operator()(ModifierId stored) const
    {
        if (stored == void_modifier)
            return stored;
        if (stored < 0 || static_cast<std::size_t>(stored) >= ids_.size())
            refuse(place_, "names a modifier that it does not have");
        return ids_[static_cast<std::size_t>(stored)];
    }

private:
    const std::vector<ModifierId>& ids_;
    const std::string& place_;
};

struct PartReader {
    ByteReader& in;
    const Renumbering& modifier;
    const std::vector<std::shared_ptr<const Mesh>>& meshes;
    std::uint32_t first_prototype;
    const std::string& place;

    /// @param known  prototypes that come before this part: it can be made of no others, least of all of itself
    Part read(std::size_t known) const
    {
        Part part;
        part.name = in.text();
        read_surfaces(part);
        part.points = in.array<Point>();
        part.polygons = in.array<Polygon>();
        part.spheres = in.array<Sphere>();
        part.cones = in.array<Cone>();
        part.rings = in.array<Ring>();
        part.sources = in.array<DistantSource>();
        for (const std::uint32_t number : in.array<std::uint32_t>()) {
            if (number >= meshes.size())
                refuse(place, "names a mesh that it does not have");
            part.meshes.push_back(meshes[number]);
        }
        const auto instances = in.value<std::uint64_t>();
        for (std::uint64_t i = 0; i < instances; ++i) {
            Instance instance;
            const std::uint64_t prototype = std::uint64_t{in.value<std::uint32_t>()} + first_prototype;
            if (prototype >= known)
                refuse(place, "has a part made of one that does not come before it");
            instance.prototype = static_cast<std::uint32_t>(prototype);
            instance.to_parent = in.value<Affine>();
            instance.bindings = in.array<Binding>();
            for (Binding& binding : instance.bindings)
                binding = {modifier(binding.inherited), modifier(binding.actual)};
            part.instances.push_back(std::move(instance));
        }
        check_numbers(part);
        return part;
    }

private:
    /// Each surface names a shape that is there, each polygon corners that are there.
    void check_numbers(const Part& part) const
    {
        const std::size_t cones = part.cones.size(), spheres = part.spheres.size();
        const std::size_t counts[] = {part.polygons.size(),
                                      spheres,
                                      spheres,
                                      cones,
                                      cones,
                                      cones,
                                      cones,
                                      part.rings.size(),
                                      part.sources.size(),
                                      part.meshes.size(),
                                      part.instances.size()};
        for (const Surface& surface : part.surfaces)
            if (surface.index >= counts[static_cast<std::size_t>(surface.shape)])
                refuse(place, "names a shape that it does not have");
        for (const Polygon& polygon : part.polygons)
            if (polygon.count > part.points.size() || polygon.first > part.points.size() - polygon.count)
                refuse(place, "names corners that it does not have");
    }
    void read_surfaces(Part& part) const
    {
        const auto shapes = in.array<std::uint8_t>();
        const auto indices = in.array<std::uint32_t>();
        const auto modifiers = in.array<ModifierId>();
        const auto name_ends = in.array<std::uint32_t>();
        const std::string_view names = in.text();
        const std::size_t count = shapes.size();
        if (indices.size() != count || modifiers.size() != count || name_ends.size() != count)
            refuse(place, "has surfaces without all their data");
        part.surfaces.reserve(count);
        std::size_t begin = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t end = name_ends[i];
            if (shapes[i] > static_cast<std::uint8_t>(Shape::instance) || end < begin || end > names.size())
                refuse(place, "has a surface of no known shape");
            part.surfaces.push_back({static_cast<Shape>(shapes[i]), indices[i], modifier(modifiers[i]),
                                     std::string(names.substr(begin, end - begin))});
            begin = end;
        }
    }
};

std::shared_ptr<const Mesh> read_mesh(ByteReader& in, const std::string& place)
{
    auto mesh = std::make_shared<Mesh>();
    mesh->points = in.array<Point>();
    mesh->triangles = in.array<std::uint32_t>();
    mesh->normals = in.array<Direction>();
    mesh->texture = in.array<double>();
    const auto known = [&](std::uint32_t index) { return index < mesh->points.size(); };
    if (!std::all_of(mesh->triangles.begin(), mesh->triangles.end(), known))
        refuse(place, "names corners that it does not have");
    return mesh;
}

template <class T>
std::uint32_t append(std::vector<T>& to, std::vector<T>&& from)
{
    const auto offset = static_cast<std::uint32_t>(to.size());
    if (to.empty())
        to = std::move(from);
    else
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    return offset;
}

/// Everything of one part behind what is in another.
void append_part(Part& to, Part&& from)
{
    if (to.surfaces.empty()) {
        const std::string name = to.name.empty() ? from.name : to.name;
        to = std::move(from);
        to.name = name;
        return;
    }
    const auto points = append(to.points, std::move(from.points));
    for (Polygon& polygon : from.polygons)
        polygon.first += points;
    std::uint32_t offsets[static_cast<std::size_t>(Shape::instance) + 1] = {};
    const auto set = [&](std::initializer_list<Shape> shapes, std::uint32_t offset) {
        for (const Shape shape : shapes)
            offsets[static_cast<std::size_t>(shape)] = offset;
    };
    set({Shape::polygon}, append(to.polygons, std::move(from.polygons)));
    set({Shape::sphere, Shape::bubble}, append(to.spheres, std::move(from.spheres)));
    set({Shape::cone, Shape::cup, Shape::cylinder, Shape::tube}, append(to.cones, std::move(from.cones)));
    set({Shape::ring}, append(to.rings, std::move(from.rings)));
    set({Shape::source}, append(to.sources, std::move(from.sources)));
    set({Shape::mesh}, append(to.meshes, std::move(from.meshes)));
    set({Shape::instance}, append(to.instances, std::move(from.instances)));
    for (Surface& surface : from.surfaces) {
        surface.index += offsets[static_cast<std::size_t>(surface.shape)];
        to.surfaces.push_back(std::move(surface));
    }
}

struct Origin {
    std::vector<std::string> inputs;
    bool changed = false;
    std::string gone; ///< a source that is no longer there
};

Origin read_origin(ByteReader& in)
{
    Origin origin;
    const auto inputs = in.value<std::uint64_t>();
    for (std::uint64_t i = 0; i < inputs; ++i)
        origin.inputs.emplace_back(in.text());
    const auto files = in.value<std::uint64_t>();
    for (std::uint64_t i = 0; i < files; ++i) {
        const std::filesystem::path file = in.text();
        const auto size = in.value<std::uint64_t>();
        const auto time = in.value<std::int64_t>();
        std::error_code gone;
        const auto size_now = std::filesystem::file_size(file, gone);
        if (gone) {
            origin.gone = file.string();
            continue;
        }
        const auto time_now = std::filesystem::last_write_time(file, gone).time_since_epoch().count();
        origin.changed = origin.changed || size_now != size || time_now != time;
    }
    return origin;
}

} // namespace

void SceneReader::read_compiled(std::string_view bytes, const std::filesystem::path& path, const std::string& name,
                                const OpenFile* from, Target target)
{
    const CompiledHead head = compiled_head(bytes, name);
    ByteReader in(bytes.substr(head.body), name);
    in.bytes(2 * sizeof(std::uint32_t) + 2 * sizeof(Vec3)); // read with the head
    const Origin origin = read_origin(in);
    if (!origin.gone.empty())
        report_.add(Finding::assumed, name, origin.gone + " is gone: what was compiled of it is used");
    else if (origin.changed) {
        report_.add(Finding::assumed, name, "its sources have changed since it was compiled: they are read again");
        const OpenFile self{from, path, Words({}, name)};
        for (const std::string& input : origin.inputs)
            read_file(input, &self, name, {target.part, target.scope, target.first_file, false});
        return;
    }
    std::vector<ModifierId> ids;
    std::vector<ModifierId>* const outer = std::exchange(listed_modifiers_, &ids);
    read_text(in.text(), path, name, from, target);
    listed_modifiers_ = outer;
    const Renumbering modifier(ids, name);
    const auto names = in.value<std::uint64_t>();
    for (std::uint64_t i = 0; i < names; ++i) {
        const std::string word(in.text());
        target.scope.define(word, {modifier(in.value<ModifierId>())});
    }
    std::vector<std::shared_ptr<const Mesh>> meshes;
    for (auto left = in.value<std::uint64_t>(); left > 0; --left)
        meshes.push_back(read_mesh(in, name));
    const PartReader parts{in, modifier, meshes, static_cast<std::uint32_t>(scene_.prototypes.size()), name};
    for (auto left = in.value<std::uint64_t>(); left > 0; --left) {
        scene_.prototypes.push_back(parts.read(scene_.prototypes.size()));
        prototype_changes_.emplace_back(false, false);
    }
    append_part(target.part, parts.read(scene_.prototypes.size()));
}

NamedScene SceneReader::read_sources(const std::vector<SceneSource>& sources)
{
    for (const SceneSource& source : sources) {
        if (!source.text)
            read_file(source.name, nullptr, source.name, {scene_.root, scope_, true});
        else if (is_compiled_scene(*source.text))
            read_compiled(*source.text, std::filesystem::current_path() / source.name, source.name, nullptr,
                          {scene_.root, scope_, true});
        else
            read_text(*source.text, std::filesystem::current_path() / source.name, source.name, nullptr,
                      {scene_.root, scope_, true});
    }
    NamedScene named;
    for (const auto& [name, meaning] : scope_.own())
        if (meaning.problem < 0)
            named.names.emplace_back(name, meaning.id);
    std::sort(named.names.begin(), named.names.end());
    named.files.assign(files_.begin(), files_.end());
    named.scene = std::move(scene_);
    return named;
}

} // namespace scene_text

NamedScene read_radiance_sources(const std::vector<SceneSource>& sources, Report& report,
                                 const RadianceReadOptions& options)
{
    const std::string first = sources.empty() || sources[0].text ? "." : sources[0].name;
    KeptMeshes kept;
    SceneOrigins origins;
    NamedScene named = scene_text::SceneReader(first, report, kept, origins, options).read_sources(sources);
    validate(named.scene);
    return named;
}

} // namespace lightwell
