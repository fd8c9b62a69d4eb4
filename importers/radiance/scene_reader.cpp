#include "importers/radiance/scene_reader.h"

#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/kept_meshes.h"
#include "importers/radiance/material_text.h"
#include "importers/radiance/radiance.h"
#include "importers/radiance/surface_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace lightwell {

Scene read_radiance(const std::filesystem::path& file, Report& report, const RadianceReadOptions& options)
{
    KeptMeshes kept;
    SceneOrigins origins;
    return scene_text::SceneReader(file, report, kept, origins, options).read();
}

Scene read_radiance(const std::filesystem::path& file, Report& report)
{
    return read_radiance(file, report, RadianceReadOptions{});
}

Scene read_radiance(const std::filesystem::path& file, Report& report, KeptMeshes& kept, SceneOrigins& origins)
{
    return scene_text::SceneReader(file, report, kept, origins, {}).read();
}

namespace scene_text {
namespace {

/// Files that refer to files that refer to files: deeper than this is a mistake, and would exhaust the stack.
constexpr int deepest_nesting = 200;

std::string chain_of_names(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : " -> ") + name;
    return text;
}

void give_back_memory(Part& part)
{
    part.surfaces.shrink_to_fit();
    part.points.shrink_to_fit();
    part.polygons.shrink_to_fit();
}

bool is_compiled(std::string_view text)
{
    return text.starts_with("#?RADIANCE") && text.substr(0, 4096).find("Radiance_octree") != std::string_view::npos;
}

} // namespace

SceneReader::SceneReader(const std::filesystem::path& file, Report& report, KeptMeshes& kept, SceneOrigins& origins,
                         const RadianceReadOptions& options)
    : first_file_(file), report_(report), kept_(kept), origins_(origins), policy_{options.run_commands}, table_(scene_)
{
}

Scene SceneReader::read()
{
    origins_ = {};
    kept_.state().begin_reading();
    read_file(first_file_, nullptr, first_file_.string(), {scene_.root, scope_, true});
    kept_.state().end_reading();
    origins_.objects.resize(scene_.root.surfaces.size());
    give_back_memory(scene_.root);
    return std::move(scene_);
}

void SceneReader::read_file(const std::filesystem::path& path, const OpenFile* from, const std::string& place,
                            Target target)
{
    const MappedFile mapped(path);
    const bool compiled = is_compiled_scene(mapped.bytes());
    if (!compiled && is_compiled(mapped.bytes()))
        throw InputError{place, path.string() + " is a compiled scene of another program, which is not read",
                         "give the text that it was made from"};
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(path);
    std::vector<std::string> names{path.filename().string()};
    for (const OpenFile* outer = from; outer != nullptr; outer = outer->from) {
        names.insert(names.begin(), outer->path.filename().string());
        if (outer->path == canonical)
            throw InputError{place, "files refer to each other in a circle: " + chain_of_names(names),
                             "take one of the references out"};
    }
    files_.insert(canonical);
    if (compiled)
        read_compiled(mapped.bytes(), canonical, path.string(), from, target);
    else
        read_text(mapped.bytes(), canonical, path.string(), from, target);
}

void SceneReader::read_text(std::string_view text, const std::filesystem::path& path, const std::string& name,
                            const OpenFile* from, Target target)
{
    OpenFile file{from, path, Words(text, name)};
    file.depth = from == nullptr ? 0 : from->depth + 1;
    if (file.depth > deepest_nesting)
        throw InputError{name, fmt::format("files refer to files more than {} deep", deepest_nesting),
                         "check for generated references that never end"};
    Primitive primitive;
    for (;;) {
        const Words::Next next = file.words.next();
        if (next == Words::Next::end)
            break;
        if (next == Words::Next::primitive) {
            file.words.read(primitive);
            const std::size_t before = scene_.root.surfaces.size();
            read_primitive(file, primitive, target);
            if (&target.part == &scene_.root)
                note_object(before);
        } else if (next == Words::Next::comment) {
            read_comment(file, file.words.comment(), target);
        } else {
            const std::string at = file.words.place(file.words.offset());
            run(file, file.words.command().substr(1), at, target);
            file.last_known = false;
        }
    }
}

void SceneReader::note_object(std::size_t first_surface)
{
    if (!object_.empty()) {
        origins_.objects.resize(first_surface);
        origins_.objects.resize(scene_.root.surfaces.size(), object_);
    }
    object_.clear();
}

void SceneReader::read_primitive(OpenFile& file, Primitive& primitive, Target target)
{
    switch (classify(primitive.type)) {
    case TypeClass::surface:
        break;
    case TypeClass::unknown:
        throw InputError{file.words.place(primitive),
                         fmt::format("\"{}\" is no type of the scene language", primitive.type.substr(0, 40)),
                         parse_double(primitive.modifier)
                             ? "a number stands where a primitive should begin: check the counts of the one before"
                             : "check the counts of the primitive before it"};
    case TypeClass::alias:
        return define_alias(file, primitive, target);
    default:
        return define(file, primitive, target);
    }
    if (primitive.type == "instance")
        return add_instance(file, primitive, target);
    if (!file.last_known || primitive.modifier != file.last_modifier) {
        file.last_meaning = meaning_of(file, primitive, primitive.modifier, target);
        file.last_modifier = primitive.modifier;
        file.last_known = true;
    }
    const ModifierId modifier = usable(file, primitive, file.last_meaning);
    if (modifier == void_modifier && primitive.type != "mesh" && primitive.type != "subdivision") {
        report_.add(Finding::ignored, file.words.place(primitive), "surface made of `void` left out");
        return;
    }
    if (primitive.type == "mesh" || primitive.type == "subdivision")
        add_mesh(file, primitive, target);
    else
        add_surface(target.part, primitive, modifier, file.words, report_);
}

void SceneReader::read_comment(OpenFile& file, std::string_view comment, Target target)
{
    if (!comment.starts_with("#@"))
        return;
    const std::vector<std::string_view> fields = split(comment, " \t");
    const std::string place = file.words.place(file.words.offset());
    if (fields[0] == "#@from" && fields.size() == 2) {
        const bool root = &target.part == &scene_.root;
        if (root)
            object_ = decoded_name(fields[1]);
        if (target.own_part && (!root || target.part.surfaces.empty()))
            target.part.name = decoded_name(fields[1]);
    } else if (fields[0] == "#@view" && fields.size() >= 2 && target.first_file) {
        const char* const words = fields[1].data() + fields[1].size();
        View view = parse_view(std::string(words, comment.data() + comment.size()), place);
        view.name = decoded_name(fields[1]);
        scene_.views.push_back(std::move(view));
    } else if (fields[0] == "#@is" && fields.size() == 2 && listed_modifiers_ != nullptr) {
        const auto meaning = target.scope.find(decoded_name(fields[1]));
        listed_modifiers_->push_back(fields[1] == "void" || !meaning ? void_modifier : meaning->id);
    } else if (trimmed(comment) == sharp_horizon_comment) {
        file.sharp_horizon = true;
    } else if (fields[0].starts_with("#@grid") && target.first_file) {
        read_grid(place, fields);
    }
}

void SceneReader::read_grid(const std::string& place, const std::vector<std::string_view>& fields)
{
    const auto number = [&](std::size_t i) {
        const auto value = i < fields.size() ? parse_double(fields[i]) : std::nullopt;
        if (!value || !std::isfinite(*value))
            throw InputError{place, fmt::format("word {} of `{}` is no finite number", i, fields[0])};
        return *value;
    };
    const auto integer = [&](std::size_t i) {
        const auto value = i < fields.size() ? parse_integer(fields[i]) : std::nullopt;
        if (!value || *value < -1 || *value > std::numeric_limits<int>::max())
            throw InputError{place, fmt::format("word {} of `{}` is no count", i, fields[0])};
        return static_cast<int>(*value);
    };
    if (fields[0] == "#@grid") {
        SensorGrid grid;
        grid.rows = integer(2);
        grid.columns = integer(3);
        grid.spacing_m = number(4);
        grid.name = decoded_name(fields[1]);
        scene_.grids.push_back(std::move(grid));
        return;
    }
    if (scene_.grids.empty())
        throw InputError{place, fmt::format("`{}` without a `#@grid` before it", fields[0])};
    SensorGrid& grid = scene_.grids.back();
    if (fields[0] == "#@grid-sensor")
        grid.sensors.push_back({{number(1), number(2), number(3)}, {number(4), number(5), number(6)}});
    else if (fields[0] == "#@grid-cells")
        for (std::size_t i = 1; i < fields.size(); ++i)
            grid.cells.push_back(integer(i));
}

} // namespace scene_text
} // namespace lightwell
