#include "importers/export/export.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

namespace lightwell {
namespace {

void note_pictures(const Imported& model, const std::string& place, Report& report)
{
    std::size_t laid = 0;
    for (const FileTexture& texture : model.file_textures)
        laid += texture.laid ? 1 : 0;
    if (laid > 0)
        report.add(Finding::approximated, place,
                   "pictures on surfaces are not written: the mean colour of each stands for it", laid);
}

} // namespace

void export_file(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
{
    note_pictures(model, file.filename().string(), report);
    const std::string ending = lowercase_ascii(file.extension().string());
    if (ending == ".dxf")
        return export_dxf(model, file, options, report);
    if (ending == ".obj")
        return export_obj(model, file, options, report);
    if (ending == ".glb")
        return export_glb(model, file, options, report);
    throw InputError{file.string(), "the ending \"" + ending + "\" names no format that can be written",
                     "expected .dxf, .obj or .glb"};
}

} // namespace lightwell
