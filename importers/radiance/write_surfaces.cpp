#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/scene/expansion.h"
#include "importers/radiance/material_text.h"
#include "importers/radiance/mesh_text.h"
#include "importers/radiance/place_surface.h"
#include "importers/radiance/scene_writer.h"
#include "importers/radiance/surface_text.h"
#include "importers/radiance/transform_words.h"
#include "materials/placed.h"

#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

/// `COUNT "FILE" transform words` and the two empty lists of an instance or a mesh.
void append_reference(std::string& text, const std::string& file, const std::vector<std::string>& transform)
{
    text += std::to_string(1 + transform.size()) + ' ';
    text += file.find_first_of(" \t'") == std::string::npos ? file : '"' + file + '"';
    for (const std::string& word : transform)
        text += ' ' + word;
    text += "\n0\n0\n";
}

} // namespace

const std::string& SceneWriter::use(Output& out, ModifierId id)
{
    if (id == out.last)
        return out.last_word;
    std::string word = "void";
    // A place-holder that nothing stands in for is invisible, as `void` is; other programs take no alias of `void`.
    const ResolvedMaterial resolved = resolve(changed_, id);
    if (resolved.material != nullptr || resolved.brightness != nullptr || resolved.varies) {
        const std::string& name = changed_.modifiers[static_cast<std::size_t>(id)].name;
        const auto known = out.defined.find(name);
        if (known == out.defined.end() || known->second != id)
            define(out, id);
        word = encoded_name(name);
    }
    out.last = id;
    return out.last_word = std::move(word);
}

void SceneWriter::define(Output& out, ModifierId id)
{
    if (!out.busy.insert(id).second)
        return;
    const Modifier& modifier = changed_.modifiers[static_cast<std::size_t>(id)];
    const std::string name = encoded_name(modifier.name);
    if (const auto* material = std::get_if<Material>(&modifier.what)) {
        for (const std::string& named : named_modifiers(*material))
            use(out, changed_.find_modifier(named));
        const std::string parent = use(out, modifier.parent);
        const auto* functions = functions_of(*material);
        if (functions == nullptr)
            append_material(out.file.text(), parent, name, *material);
        else if (!append_functions(out.file.text(), parent, name, **functions,
                                   file_words((*functions)->text(), modifier.name)))
            report_.add(Finding::approximated, modifier.name,
                        "functions under a map that is no similarity: written without their transform");
    } else if (const auto* sky = std::get_if<SkyBrightness>(&modifier.what)) {
        const std::string parent = use(out, modifier.parent);
        append_sky_brightness(out.file.text(), parent, name, *sky);
    } else if (const auto* varying = std::get_if<Varying>(&modifier.what)) {
        define_varying(out, modifier, *varying);
    } else {
        const auto* alias = std::get_if<Alias>(&modifier.what);
        const ModifierId target = alias != nullptr && alias->target != void_modifier ? alias->target : modifier.parent;
        const std::string target_word = use(out, target);
        const ResolvedMaterial resolved = resolve(changed_, target);
        const bool has_pattern = resolved.brightness != nullptr || resolved.varies;
        out.file.text() += (has_pattern ? "inherit alias " : "void alias ") + name + ' ' + target_word + '\n';
    }
    out.defined[modifier.name] = id;
    out.busy.erase(id);
}

/// Files stay where they are; the text names them from its own folder.
FileWords SceneWriter::file_words(const PatternText& read, const std::string& name)
{
    const auto found = [this](const std::string& path) {
        const std::filesystem::path whole = std::filesystem::absolute(path);
        return (file_.empty() ? whole
                              : std::filesystem::proximate(whole, std::filesystem::absolute(file_).parent_path()))
            .string();
    };
    const auto made = [this, &read, name](const std::string& text) { return data_file_of(read, text, name); };
    return {found, made};
}

void SceneWriter::define_varying(Output& out, const Modifier& modifier, const Varying& varying)
{
    std::vector<std::string> mixed;
    if (varying.kind == Varying::Kind::mixture)
        for (const ModifierId part : {varying.foreground, varying.background})
            mixed.push_back(use(out, part));
    const std::string parent = use(out, modifier.parent);
    if (!append_varying(out.file.text(), parent, encoded_name(modifier.name), *varying.function, mixed,
                        file_words(varying.function->text(), modifier.name)))
        report_.add(Finding::approximated, modifier.name,
                    "pattern under a map that is no similarity: written without its transform");
}

/// Where data that came with a pattern are written: beside the parts, once.
std::string SceneWriter::data_file_of(const PatternText& pattern, const std::string& text, const std::string& name)
{
    std::string& stem = data_stems_[&pattern];
    if (stem.empty()) {
        stem = stem_of(name);
        write_text_atomically(parts_ / (stem + ".dat"), text);
    }
    return in_parts_folder(stem + ".dat");
}

void SceneWriter::write_part(Output& out, const Part& part, const Place& place)
{
    for (const Surface& surface : part.surfaces) {
        if (surface.shape == Shape::instance)
            write_instance(out, part.instances[surface.index], place.prefix + surface.name, place);
        else
            write_surface(out, part, surface, place);
        out.file.pass_on();
    }
}

void SceneWriter::write_surface(Output& out, const Part& part, const Surface& surface, const Place& place)
{
    ModifierId modifier = bound_modifier(scene_, surface.modifier, place.bindings);
    const std::string name = place.prefix + surface.name;
    if (place.expanded)
        modifier = transformed(changed_, table_, modifier, place.map, {}, name);
    if (surface.shape == Shape::mesh)
        return write_mesh(out, part, surface, modifier, name, place.map);
    const bool whole = sector_of(part, surface).is_whole();
    if (!place.expanded && whole) {
        const std::string word = use(out, modifier);
        return append_surface(out.file.text(), part, surface, word);
    }
    Part image;
    if (whole)
        add_image(image, part, surface, place.map, modifier, name, options_.chord_tolerance_m, report_);
    else
        add_facets(image, part, surface, place.expanded ? place.map : Affine{}, modifier, name,
                   options_.chord_tolerance_m, report_);
    const std::string word = use(out, modifier);
    for (const Surface& piece : image.surfaces)
        append_surface(out.file.text(), image, piece, word);
}

void SceneWriter::write_instance(Output& out, const Instance& instance, const std::string& name, const Place& place)
{
    const Affine map = place.expanded ? compose(place.map, instance.to_parent) : instance.to_parent;
    const Bindings bindings = effective_bindings(instance.prototype, instance.bindings, place.bindings);
    const Part& prototype = scene_.prototypes[instance.prototype];
    bool lit = lit_[instance.prototype] != 0;
    for (const Binding& binding : bindings)
        lit = lit || sends_light(binding.actual);
    const auto transform = options_.flat || lit ? std::nullopt : words_of(map);
    if (transform) {
        const std::string stem = stem_of_variant(instance.prototype, bindings);
        out.file.text() += "void instance " + encoded_name(name) + '\n';
        return append_reference(out.file.text(), in_parts_folder(stem + ".oct"), *transform);
    }
    if (!options_.flat)
        report_.add(Finding::converted, name,
                    lit ? "instance with emitters or mirrors written out, since programs that compile parts would "
                          "not find them"
                        : "instance under a map that is no similarity written out");
    write_part(out, prototype, {map, true, bindings, name + '/'});
}

void SceneWriter::write_mesh(Output& out, const Part& part, const Surface& surface, ModifierId modifier,
                             const std::string& name, const Affine& map)
{
    const std::shared_ptr<const Mesh>& mesh = part.meshes[surface.index];
    // Compiled meshes cannot send light in other programs.
    if (options_.flat || sends_light(surface.modifier) || modifier == void_modifier)
        return write_triangles(out, *mesh, modifier, name, map);
    const std::string word = use(out, modifier);
    const auto transform = words_of(map);
    std::string stem;
    if (transform) {
        std::string& known = mesh_stems_[mesh.get()];
        if (known.empty())
            known = write_mesh_file(*mesh, surface.name);
        stem = known;
    } else {
        Part image;
        add_image(image, part, surface, map, modifier, name, options_.chord_tolerance_m, report_);
        stem = write_mesh_file(*image.meshes.front(), surface.name);
    }
    out.file.text() += word + " mesh " + encoded_name(name) + '\n';
    append_reference(out.file.text(), in_parts_folder(stem + ".rtm"), transform.value_or(std::vector<std::string>{}));
}

std::string SceneWriter::write_mesh_file(const Mesh& mesh, const std::string& name)
{
    std::string stem = stem_of(name);
    write_text_atomically(parts_ / (stem + ".obj"), mesh_text(mesh));
    meshes_.push_back(stem);
    return stem;
}

void SceneWriter::write_triangles(Output& out, const Mesh& mesh, ModifierId modifier, const std::string& name,
                                  const Affine& map)
{
    if (!mesh.normals.empty())
        report_.add(Finding::approximated, name, "mesh written as flat triangles; its interpolated normals are lost");
    const std::string word = use(out, modifier);
    const bool mirrored = map.determinant() < 0;
    Part triangle;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        std::vector<Point> corners;
        for (const std::size_t k : {std::size_t{0}, mirrored ? std::size_t{2} : 1, mirrored ? std::size_t{1} : 2})
            corners.push_back(map.point(mesh.points[mesh.triangles[i + k]]));
        triangle = {};
        triangle.add_polygon(corners, modifier, name + '.' + std::to_string(i / 3 + 1));
        append_surface(out.file.text(), triangle, triangle.surfaces[0], word);
        out.file.pass_on();
    }
}

} // namespace lightwell::scene_text
