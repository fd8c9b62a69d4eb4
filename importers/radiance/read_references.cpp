#include "engine/base/files.h"
#include "importers/radiance/mesh_text.h"
#include "importers/radiance/scene_reader.h"

#include <cstdlib>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

namespace fs = std::filesystem;

/// The folders of the environment variable that Radiance programs use, in order.
std::vector<fs::path> library_folders()
{
    std::vector<fs::path> folders;
    const char* const path = std::getenv("RAYPATH");
    std::string_view rest = path == nullptr ? "" : path;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (end > 0)
            folders.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return folders;
}

bool is_file(const fs::path& path)
{
    std::error_code unreadable;
    return fs::is_regular_file(path, unreadable);
}

/// NAME.rad for NAME.oct and NAME.octf, NAME.obj for NAME.rtm: the text that a compiled file was made from.
fs::path text_of_compiled(const fs::path& name)
{
    fs::path text = name;
    if (name.extension() == ".oct" || name.extension() == ".octf")
        text.replace_extension(".rad");
    if (name.extension() == ".rtm")
        text.replace_extension(".obj");
    return text;
}

} // namespace

std::optional<fs::path> SceneReader::find_quietly(const fs::path& wanted, const OpenFile& file) const
{
    std::vector<fs::path> tried{wanted};
    if (wanted.is_relative()) {
        tried = {file.path.parent_path() / wanted, first_file_.parent_path() / wanted, wanted};
        for (const fs::path& folder : library_folders())
            tried.push_back(folder / wanted);
    }
    for (const fs::path& candidate : tried)
        if (is_file(candidate))
            return candidate;
    return std::nullopt;
}

fs::path SceneReader::find(const std::string& name, const OpenFile& file, const std::string& place) const
{
    // What oconv here has compiled is read as it is; of what others have compiled the text is wanted.
    if (const auto own = fs::path(name).extension() == ".oct" ? find_quietly(name, file) : std::nullopt)
        if (is_compiled_scene(MappedFile(*own).bytes()))
            return *own;
    if (const auto own = fs::path(name).extension() == ".rtm" ? find_quietly(name, file) : std::nullopt)
        if (is_mesh_file(MappedFile(*own).bytes()))
            return *own;
    const fs::path wanted = text_of_compiled(name);
    if (const auto found = find_quietly(wanted, file))
        return *found;
    const bool compiled = wanted != fs::path(name);
    throw InputError{
        place,
        compiled ? fmt::format("\"{}\" is compiled, and its text \"{}\" is not found", name, wanted.filename().string())
                 : fmt::format("file \"{}\" is not found", name),
        compiled ? "put the text beside it"
                 : "put it beside the file that names it, into the working folder or on RAYPATH"};
}

Affine only_placement(const Primitive& primitive, const std::string& place)
{
    const std::vector<std::string> words(primitive.words.begin() + 1, primitive.words.end());
    std::size_t next = 0;
    const std::vector<Placement> placements = read_placements(words, next, place);
    if (next != words.size())
        throw InputError{place, fmt::format("\"{}\" is no transform", words[next]),
                         "use -t -rx -ry -rz -s -mx -my -mz -affine -i"};
    if (placements.size() != 1)
        throw InputError{place, "an array (-a) makes more than one copy", "use !xform for arrays"};
    return placements.front().map;
}

void SceneReader::add_instance(OpenFile& file, const Primitive& primitive, Target target)
{
    const std::string place = file.words.place(primitive);
    if (primitive.words.empty())
        throw InputError{place, "no file name", "an instance has the words FILE and a transform"};
    const Meaning meaning = meaning_of(file, primitive, primitive.modifier, target);
    const Affine map = only_placement(primitive, place);
    const std::string_view name = primitive.words[0];
    auto known = file.instances.find(name);
    if (known == file.instances.end()) {
        const std::uint32_t fresh = prototype_of_file(find(std::string(name), file, place), file, place);
        known = file.instances.emplace(name, fresh).first;
    }
    std::uint32_t prototype = known->second;
    if (const ModifierId modifier = usable(file, primitive, meaning); modifier != void_modifier)
        prototype = with_modifier(prototype, moved_patterns(modifier, inverse(map), place));
    target.part.add_instance({prototype, map, {}}, decoded_name(primitive.name));
}

std::uint32_t SceneReader::add_prototype(Part part)
{
    scene_.prototypes.push_back(std::move(part));
    prototype_changes_.emplace_back(false, false);
    return static_cast<std::uint32_t>(scene_.prototypes.size() - 1);
}

std::uint32_t SceneReader::prototype_of_file(const fs::path& path, OpenFile& file, const std::string& place)
{
    const fs::path key = fs::weakly_canonical(path);
    if (const auto known = file_prototypes_.find(key); known != file_prototypes_.end())
        return known->second;
    Part part;
    part.name = path.stem().string();
    // Like a compiled scene it knows only its own names.
    Scope scope;
    read_file(path, &file, place, {part, scope});
    return file_prototypes_[key] = add_prototype(std::move(part));
}

std::uint32_t SceneReader::with_modifier(std::uint32_t prototype, ModifierId modifier)
{
    const std::pair key(prototype, modifier);
    if (const auto known = remade_prototypes_.find(key); known != remade_prototypes_.end())
        return known->second;
    Part part = scene_.prototypes[prototype];
    for (Surface& surface : part.surfaces)
        if (surface.shape != Shape::instance)
            surface.modifier = modifier;
    for (Instance& instance : part.instances)
        instance.prototype = with_modifier(instance.prototype, modifier);
    const std::uint32_t index = add_prototype(std::move(part));
    if (const auto file = origins_.mesh_files.find(prototype); file != origins_.mesh_files.end())
        origins_.mesh_files[index] = file->second;
    return remade_prototypes_[key] = index;
}

} // namespace lightwell::scene_text
