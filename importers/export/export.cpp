#include "importers/export/export.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

namespace lightwell {

void export_file(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
{
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
