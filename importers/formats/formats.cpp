#include "importers/formats/formats.h"

#include "engine/base/errors.h"
#include "importers/questions.h"
#include "importers/surfaces/recover_surfaces.h"

namespace lightwell {
namespace {

struct Format {
    bool (*recognize)(const std::filesystem::path&);
    Imported (*import)(const std::filesystem::path&, const ImportOptions&);
};

/// From the most to the least certain mark: glTF has a magic number or an asset, the long tail its first words, DXF its
/// section tags, OBJ only words.
constexpr Format formats[] = {{recognize_gltf, import_gltf},
                              {recognize_assimp, import_assimp},
                              {recognize_dxf, import_dxf},
                              {recognize_obj, import_obj}};

} // namespace

Imported import_file(const std::filesystem::path& file, const ImportOptions& options)
{
    for (const Format& format : formats)
        if (format.recognize(file)) {
            Imported imported = format.import(file, options);
            recover_surfaces(imported, options);
            if (!options.raised.empty() && format.import != import_dxf)
                imported.report.add(Finding::unused, file.filename().string(), "layers are raised in DXF files only");
            ask_about_sizes(imported, file.filename().string());
            return imported;
        }
    throw InputError(file.filename().string(), "content is none of the formats that can be read",
                     "expected DXF, OBJ, glTF (.gltf) or GLB, FBX, Collada, 3DS, PLY, STL, X3D, OFF, IFC 2x3");
}

} // namespace lightwell
