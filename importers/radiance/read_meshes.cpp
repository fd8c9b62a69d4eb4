#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/kept_meshes.h"
#include "importers/radiance/mesh_text.h"
#include "importers/radiance/scene_reader.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell::scene_text {

namespace fs = std::filesystem;

std::shared_ptr<const Mesh> SceneReader::mesh(const fs::path& path)
{
    std::shared_ptr<const Mesh>& known = meshes_[fs::weakly_canonical(path)];
    if (!known)
        known = std::make_shared<const Mesh>(read_mesh_text(path));
    return known;
}

void SceneReader::add_mesh(OpenFile& file, const Primitive& primitive, Target target)
{
    const std::string place = file.words.place(primitive);
    if (primitive.words.empty())
        throw InputError{place, "no file name", fmt::format("a {} has the words FILE and a transform", primitive.type)};
    const std::string name(primitive.words[0]);
    if (lowercase_ascii(fs::path(name).extension().string()) == ".ply")
        return add_ply(file, primitive, find(name, file, place), target);
    if (primitive.type == "subdivision")
        throw InputError{place, fmt::format("\"{}\" is no control cage", name), "name a .ply"};
    const ModifierId modifier = usable(file, primitive, file.last_meaning);
    const fs::path path = find(name, file, place);
    if (path.extension() != ".obj" && path.extension() != ".rtm")
        throw InputError{place, fmt::format("\"{}\" is no mesh file that is read", name),
                         "name a .ply, an .obj, or the .rtm beside which the .obj stands"};
    const Affine map = only_placement(primitive, place);
    if (modifier == void_modifier)
        target.part.add_instance({prototype_with_materials(path, file, place), map, {}}, decoded_name(primitive.name));
    else if (map == Affine{})
        target.part.add_mesh(mesh(path), modifier, decoded_name(primitive.name));
    else
        target.part.add_instance({prototype_of_mesh(path, moved_patterns(modifier, inverse(map), place)), map, {}},
                                 decoded_name(primitive.name));
}

/// A mesh with the materials that its faces name; they are defined in the file NAME.mat beside NAME.obj.
std::uint32_t SceneReader::prototype_with_materials(const fs::path& path, OpenFile& file, const std::string& place)
{
    const std::pair key(fs::weakly_canonical(path), void_modifier);
    if (const auto known = mesh_prototypes_.find(key); known != mesh_prototypes_.end())
        return known->second;
    const MappedFile mapped(path);
    const bool own = is_mesh_file(mapped.bytes());
    fs::path definitions = path;
    if (!own)
        definitions.replace_extension(".mat");
    if (std::error_code unreadable; !fs::is_regular_file(definitions, unreadable))
        throw InputError{place,
                         fmt::format("a mesh made of `void` takes its materials from \"{}\", which is not there",
                                     definitions.string()),
                         "give it a modifier, or put the materials beside it"};
    Part part;
    part.name = path.stem().string();
    Scope scope;
    if (own)
        read_text(materials_of_mesh_file(mapped.bytes(), path.string()), path, path.string(), &file, {part, scope});
    else
        read_file(definitions, &file, place, {part, scope});
    for (auto& [name, mesh] : read_meshes_by_material(path)) {
        const auto meaning = scope.find(name);
        if (!meaning)
            throw InputError{path.string(),
                             fmt::format("material \"{}\" is not defined in \"{}\"", name, definitions.string()),
                             "define it there"};
        if (meaning->problem >= 0) {
            const Problem& found = problems_[static_cast<std::size_t>(meaning->problem)];
            throw InputError{path.string(), fmt::format("uses {}, {}", found.place, found.what), found.hint};
        }
        part.add_mesh(std::make_shared<const Mesh>(std::move(mesh)), meaning->id, name);
    }
    return mesh_prototypes_[key] = add_prototype(std::move(part));
}

std::uint32_t SceneReader::prototype_of_mesh(const fs::path& path, ModifierId modifier)
{
    const std::pair key(fs::weakly_canonical(path), modifier);
    if (const auto known = mesh_prototypes_.find(key); known != mesh_prototypes_.end())
        return known->second;
    Part part;
    part.name = path.stem().string();
    part.add_mesh(mesh(path), modifier, part.name);
    return mesh_prototypes_[key] = add_prototype(std::move(part));
}

void SceneReader::add_ply(OpenFile& file, const Primitive& primitive, const fs::path& path, Target target)
{
    const std::string place = file.words.place(primitive);
    const Affine map = only_placement(primitive, place);
    double chord_tolerance_m = 0;
    if (primitive.type == "subdivision") {
        if (primitive.numbers.size() != 1 || !(primitive.numbers[0] > 0))
            throw InputError{place, "expected one number > 0",
                             "it is the chord tolerance in metres, for example 0.001"};
        chord_tolerance_m = primitive.numbers[0];
    }
    const auto varies = [&](const std::optional<Meaning>& meaning) {
        return meaning && meaning->problem < 0 && meaning->id != void_modifier && resolve(scene_, meaning->id).varies;
    };
    const auto built = kept_.state().part(fs::weakly_canonical(path), chord_tolerance_m, [&](const auto& names) {
        std::vector<bool> textured{varies(file.last_meaning)};
        for (const std::string& name : names)
            textured.push_back(varies(target.scope.find(name)));
        return textured;
    });
    std::vector<ModifierId> ids = ply_modifiers(*built, file, primitive, target);
    for (ModifierId& id : ids)
        id = moved_patterns(id, inverse(map), place);
    target.part.add_instance({prototype_of_ply(built, ids, place), map, {}}, decoded_name(primitive.name));
}

std::vector<ModifierId> SceneReader::ply_modifiers(const PlyPart& built, OpenFile& file, const Primitive& primitive,
                                                   Target target)
{
    std::vector<ModifierId> ids(built.used.size(), void_modifier);
    if (built.used[0]) {
        ids[0] = usable(file, primitive, file.last_meaning);
        if (ids[0] == void_modifier)
            throw InputError{file.words.place(primitive),
                             "it is made of `void`, and its file has faces without a modifier of their own",
                             "give it a modifier, or all faces of the file one of their own"};
    }
    for (std::size_t i = 1; i < ids.size(); ++i)
        if (built.used[i]) {
            const std::string word = encoded_name(built.modifiers[i - 1]);
            ids[i] = usable(file, primitive, meaning_of(file, primitive, word, target));
        }
    return ids;
}

std::uint32_t SceneReader::prototype_of_ply(const std::shared_ptr<const PlyPart>& built,
                                            const std::vector<ModifierId>& ids, const std::string& place)
{
    const auto [known, fresh] = ply_prototypes_.try_emplace({built, ids});
    if (!fresh)
        return known->second;
    if (ply_noted_.insert(built.get()).second)
        report_.add(built->report);
    Part part = built->part;
    part.name = fs::path(part.name).stem().string();
    for (Surface& surface : part.surfaces)
        surface.modifier = ids[static_cast<std::size_t>(surface.modifier)];
    if (const auto left_out =
            std::erase_if(part.surfaces, [](const Surface& surface) { return surface.modifier == void_modifier; }))
        report_.add(Finding::ignored, place, "surface made of `void` left out", left_out);
    known->second = add_prototype(std::move(part));
    origins_.mesh_files[known->second] = built->file;
    return known->second;
}

} // namespace lightwell::scene_text
