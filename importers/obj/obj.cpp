#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/importer.h"
#include "importers/obj/build_obj.h"
#include "importers/obj/mtl.h"
#include "importers/obj/obj_file.h"
#include "importers/obj/obj_lines.h"
#include "importers/units.h"

#include <algorithm>

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

/// The files that one `mtllib` line may mean: the whole rest of the line, or its words; never a folder.
std::vector<std::filesystem::path> libraries_in(const std::string& names, const std::filesystem::path& folder,
                                                const std::string& place, Report& report)
{
    const auto find = [&](std::string name) -> std::optional<std::filesystem::path> {
        std::replace(name.begin(), name.end(), '\\', '/');
        std::error_code none;
        for (const std::filesystem::path& path : {folder / name, folder / std::filesystem::path(name).filename()})
            if (std::filesystem::is_regular_file(path, none))
                return path;
        return {};
    };
    if (const auto whole = find(names))
        return {*whole};
    std::vector<std::filesystem::path> found;
    for (const std::string_view word : split(names)) {
        if (const auto path = find(std::string(word)))
            found.push_back(*path);
        else
            report.add(Finding::ignored, place,
                       "material library \"" + std::string(word) +
                           "\" is not there; its materials are chosen by layer");
    }
    return found;
}

void read_libraries(const ObjFile& file, const std::filesystem::path& folder, std::map<std::string, Spectrum>& colours,
                    Imported& imported)
{
    std::map<std::string, bool> known;
    for (const std::string& names : file.libraries)
        for (const std::filesystem::path& path : libraries_in(names, folder, file.name, imported.report)) {
            if (!known.try_emplace("file " + path.string(), true).second)
                continue;
            const MappedFile mapped(path);
            const std::string name = path.filename().string();
            for (const MtlMaterial& mtl : read_mtl(mapped.bytes(), name, imported.report)) {
                const std::string place = name + ":" + std::to_string(mtl.line) + ": material \"" + mtl.name + '"';
                if (!known.try_emplace("material " + mtl.name, true).second) {
                    imported.report.add(Finding::ignored, place, "defined twice; the first one counts");
                    continue;
                }
                imported.file_materials.emplace_back(mtl.name, material_of(mtl, place, imported.report));
                if (mtl.diffuse)
                    colours.emplace(mtl.name, *mtl.diffuse);
            }
        }
    if (!imported.file_materials.empty())
        imported.report.add(Finding::converted, file.name,
                            "colours of the material library are taken as linear Rec.709");
}

void note_undefined_materials(const ObjFile& file, Imported& imported)
{
    for (const ObjState& state : file.states) {
        const auto same = [&](const auto& entry) { return entry.first == state.material; };
        if (!state.material.empty() &&
            std::none_of(imported.file_materials.begin(), imported.file_materials.end(), same))
            imported.report.add(Finding::ignored, file.name,
                                "material \"" + state.material + "\" is used but not described; chosen by layer");
    }
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
    std::map<std::string, Spectrum> colours;
    const ObjFile file = read_obj(mapped.bytes(), path.filename().string());
    imported.ledger.add(file.ledger);
    imported.report.add(file.report);
    const MetresPerUnit unit = unit_of(file, options, imported);
    const bool y_up = y_is_up(file, options, imported);
    read_libraries(file, path.parent_path(), colours, imported);
    note_undefined_materials(file, imported);
    build_obj(file, to_metres_z_up(unit, y_up), colours, imported);
    return imported;
}

} // namespace lightwell
