#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/gltf/build_gltf.h"
#include "importers/gltf/gltf_document.h"
#include "importers/gltf/gltf_material.h"
#include "importers/gltf/gltf_vertex_colours.h"
#include "importers/importer.h"
#include "importers/laid_pictures.h"
#include "importers/units.h"

#include <algorithm>
#include <set>

namespace lightwell {
namespace {

/// Extensions that are read, or that touch only what is not modelled (textures, variants, data for other programs).
constexpr std::string_view known_extensions[] = {
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",    "KHR_lights_punctual",     "KHR_texture_transform",   "KHR_texture_basisu",
    "EXT_texture_webp",           "KHR_materials_variants"};

void note_required_extensions(const GltfDocument& document, Report& report)
{
    for (const std::string& name : document.required) {
        const bool known =
            std::find(std::begin(known_extensions), std::end(known_extensions), name) != std::end(known_extensions) ||
            name.rfind("KHR_materials_", 0) == 0;
        if (!known)
            report.add(Finding::unsupported, document.name,
                       "the file requires extension " + name + ", which is not known; read without it");
    }
}

MetresPerUnit unit_of(const GltfDocument& document, const ImportOptions& options, Imported& imported)
{
    const double metres = options.metres_per_unit.value_or(1);
    if (!(metres > 0) || !(metres < infinity))
        throw InputError(document.name, "unit of " + shortest(metres) + " m", "expected > 0");
    imported.unit = unit_name(MetresPerUnit{metres}) + (options.metres_per_unit ? " (given)" : " (glTF)");
    return MetresPerUnit{metres};
}

bool y_is_up(const GltfDocument& document, const ImportOptions& options)
{
    if (!options.up.empty() && options.up != "y" && options.up != "z")
        throw InputError(document.name, "up axis \"" + options.up + '"', "expected y or z");
    return options.up != "z";
}

/// @param open_shells  numbers of the materials whose meshes do not all enclose a body
void take_materials(const GltfDocument& document, const std::set<int>& open_shells, double metres_per_unit,
                    Imported& imported)
{
    GltfSurroundings around;
    around.from_blender = document.generator.find("Blender") != std::string::npos;
    around.metres_per_unit = metres_per_unit;
    GltfPictures pictures(document);
    std::set<std::string> known;
    for (std::size_t i = 0; i < document.materials.size(); ++i) {
        GltfMaterial material = document.materials[i];
        std::string name = material.name;
        if (name.empty())
            name.append("material").append(std::to_string(i));
        const std::string place = document.name + ": material \"" + name + '"';
        if (!known.insert(name).second) {
            imported.report.add(Finding::ignored, place, "name is used twice; the first material of that name counts");
            continue;
        }
        const std::size_t first_texture = imported.file_textures.size();
        apply_pictures(material, name, pictures, place, imported.report, imported.file_textures);
        around.open_shell = open_shells.count(static_cast<int>(i)) > 0;
        imported.file_materials.emplace_back(name, material_of(material, around, place, imported.report));
        settle_pictures(imported.file_textures, first_texture, imported.file_materials.back().second,
                        lets_base_colour_through(material), place, imported.report);
    }
}

/// A file may offer several looks; the one that its primitives name without choice is shown.
void note_variants(const GltfDocument& document, Report& report)
{
    if (document.variants.empty())
        return;
    std::string names;
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, document.variants.size()); ++i)
        names.append(i ? ", " : "").append(document.variants[i]);
    report.add(Finding::ignored, document.name, "variants of materials; the default is taken (" + names + ")",
               document.variants.size());
}

} // namespace

bool recognize_gltf(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    std::string_view bytes = mapped.bytes();
    if (bytes.substr(0, 4) == "glTF")
        return true;
    if (bytes.substr(0, 3) == "\xef\xbb\xbf")
        bytes.remove_prefix(3);
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{' && bytes.find("\"asset\"") != std::string_view::npos;
}

Imported import_gltf(const std::filesystem::path& file, const ImportOptions& options)
{
    Imported imported;
    GltfDocument document = read_gltf(file, imported.report);
    take_vertex_colours(document, imported.report);
    note_required_extensions(document, imported.report);
    note_variants(document, imported.report);
    const MetresPerUnit unit = unit_of(document, options, imported);
    if (y_is_up(document, options))
        imported.up_in_parts = {0, 1, 0};
    const std::set<int> open_shells = build_gltf(document, to_metres_z_up(unit, y_is_up(document, options)), imported);
    take_materials(document, open_shells, unit.value, imported);
    return imported;
}

} // namespace lightwell
