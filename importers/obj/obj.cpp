#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/importer.h"
#include "importers/laid_pictures.h"
#include "importers/obj/build_obj.h"
#include "importers/obj/mtl.h"
#include "importers/obj/obj_file.h"
#include "importers/obj/smoothing.h"
#include "importers/obj/vertex_colours.h"
#include "importers/units.h"

#include <algorithm>
#include <optional>
#include <set>

namespace lightwell {
namespace {

/// So much of a file is looked at to tell whether it is OBJ.
constexpr std::size_t recognized_bytes = 1 << 16;

MetresPerUnit unit_of(const ObjFile& file, const ImportOptions& options, Imported& imported)
{
    const auto chosen = [&](MetresPerUnit unit, const std::string& why) {
        imported.unit = unit_name(unit) + " (" + why + ")";
        return unit;
    };
    if (options.metres_per_unit) {
        if (!(*options.metres_per_unit > 0) || !(*options.metres_per_unit < infinity))
            throw InputError(file.name, "unit of " + shortest(*options.metres_per_unit) + " m", "expected > 0");
        return chosen(MetresPerUnit{*options.metres_per_unit}, "given");
    }
    if (!file.unit.empty()) {
        try {
            return chosen(parse_unit(file.unit), "from a comment of the file");
        } catch (const InputError&) {
            imported.report.add(Finding::ignored, file.name,
                                "comment names the unit \"" + file.unit + "\", which is no unit of length");
        }
    }
    if (file.written_by == "FreeCAD")
        return chosen(MetresPerUnit{0.001}, "as FreeCAD writes");
    imported.report.add(Finding::assumed, file.name,
                        "unit is metre, since the format has none; `--unit` says otherwise");
    return chosen(MetresPerUnit{1}, "assumed");
}

bool y_is_up(const ObjFile& file, const ImportOptions& options, Imported& imported)
{
    if (!options.up.empty() && options.up != "y" && options.up != "z")
        throw InputError(file.name, "up axis \"" + options.up + '"', "expected y or z");
    if (!options.up.empty())
        return options.up == "y";
    if (!file.up.empty())
        return file.up == "y";
    if (file.written_by == "FreeCAD")
        return false;
    imported.report.add(Finding::assumed, file.name, "y is up, as most programs write it; `--up z` says otherwise");
    return true;
}

/// The files that one `mtllib` line may mean: the whole rest of the line, or its words.
std::vector<std::filesystem::path> libraries_in(const std::string& names, const std::filesystem::path& folder,
                                                const std::string& place, Report& report)
{
    if (const auto whole = find_beside(names, folder))
        return {*whole};
    std::vector<std::filesystem::path> found;
    std::vector<std::string> missing;
    for (const std::string_view word : split(names)) {
        if (const auto path = find_beside(std::string(word), folder))
            found.push_back(*path);
        else
            missing.emplace_back(word);
    }
    if (found.empty())
        missing = {names};
    for (const std::string& name : missing)
        report.add(Finding::ignored, place,
                   "material library \"" + name + "\" is not there; its materials are chosen by layer");
    return found;
}

/// Libraries that the file names; when none of them is there, the one that is named as the file itself.
std::vector<std::filesystem::path> libraries_of(const ObjFile& file, const std::filesystem::path& path, Report& report)
{
    std::vector<std::filesystem::path> found;
    for (const std::string& names : file.libraries)
        for (const std::filesystem::path& library : libraries_in(names, path.parent_path(), file.name, report))
            if (std::find(found.begin(), found.end(), library) == found.end())
                found.push_back(library);
    const std::string own = path.stem().string() + ".mtl";
    if (!found.empty() || file.libraries.empty())
        return found;
    if (const auto library = find_beside(own, path.parent_path())) {
        report.add(Finding::assumed, file.name, "\"" + own + "\" stands in for the material library");
        found.push_back(*library);
    }
    return found;
}

/// @param described  names of the materials so far; receives those of the library
void read_library(const std::filesystem::path& library, std::set<std::string>& described,
                  std::map<std::string, Spectrum>& colours, Imported& imported)
{
    const std::string name = library.filename().string();
    std::optional<MappedFile> mapped;
    try {
        mapped.emplace(library);
    } catch (const InputError& error) {
        imported.report.add(Finding::ignored, name, std::string("material library left out: ") + error.what());
        return;
    }
    MtlPictures pictures(library.parent_path());
    for (MtlMaterial& mtl : read_mtl(mapped->bytes(), name, imported.report)) {
        const std::string place = name + ":" + std::to_string(mtl.line) + ": material \"" + mtl.name + '"';
        if (!described.insert(mtl.name).second) {
            imported.report.add(Finding::ignored, place, "defined twice; the first one counts");
            continue;
        }
        const std::size_t first_texture = imported.file_textures.size();
        pictures.apply(mtl, place, imported.report, imported.file_textures);
        imported.file_materials.emplace_back(mtl.name, material_of(mtl, place, imported.report));
        settle_pictures(imported.file_textures, first_texture, imported.file_materials.back().second, false, place,
                        imported.report);
        if (mtl.diffuse)
            colours.emplace(mtl.name, *mtl.diffuse);
    }
}

void note_undefined_materials(const ObjFile& file, Imported& imported)
{
    std::set<std::string> known{std::string()};
    for (const auto& [name, material] : imported.file_materials)
        known.insert(name);
    for (const ObjState& state : file.states)
        if (known.insert(state.material).second)
            imported.report.add(Finding::ignored, file.name,
                                "material \"" + state.material + "\" is used but not described; chosen by layer");
}

} // namespace

bool recognize_obj(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    const std::string_view start = mapped.bytes().substr(0, recognized_bytes);
    const std::string_view mark = start.substr(0, 2);
    if (start.find('\0') != std::string_view::npos && mark != "\xfe\xff" && mark != "\xff\xfe")
        return false;
    try {
        const std::size_t whole_lines = start.size() < recognized_bytes ? start.size() : start.rfind('\n');
        const ObjFile content = read_obj(start.substr(0, whole_lines), "start");
        const auto finite = std::count_if(content.points.begin(), content.points.end(), is_finite);
        return finite > 0 && content.unknown_statements <= static_cast<std::size_t>(finite);
    } catch (const InputError&) {
        return false;
    }
}

Imported import_obj(const std::filesystem::path& path, const ImportOptions& options)
{
    const MappedFile mapped(path);
    Imported imported;
    std::set<std::string> described;
    std::map<std::string, Spectrum> colours;
    ObjFile file = read_obj(mapped.bytes(), path.filename().string());
    imported.ledger.add(file.ledger);
    const MetresPerUnit unit = unit_of(file, options, imported);
    const bool y_up = y_is_up(file, options, imported);
    for (const std::filesystem::path& library : libraries_of(file, path, imported.report))
        read_library(library, described, colours, imported);
    if (!imported.file_materials.empty())
        imported.report.add(Finding::converted, file.name,
                            "colours of the material library are taken as linear Rec.709");
    take_vertex_colours(file, imported);
    note_undefined_materials(file, imported);
    smooth_groups(file);
    imported.report.add(file.report);
    build_obj(file, to_metres_z_up(unit, y_up), colours, imported);
    return imported;
}

} // namespace lightwell
