#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/assimp/build_foreign.h"
#include "importers/assimp/foreign_format.h"
#include "importers/assimp/ply_header.h"
#include "importers/assimp/run_child.h"
#include "importers/importer.h"
#include "importers/units.h"

#include <fmt/format.h>

#include <cmath>

namespace lightwell {
namespace {

/// Smaller than this, a model is no room: what was read as millimetres was drawn in metres.
constexpr double smallest_model_m = 0.5;
/// Places in single precision are known to this share of the farthest coordinate.
constexpr double single_precision = 6e-8;
/// What single precision may move a corner before it is worth a note.
constexpr double visible_rounding_m = 1e-4;
constexpr double metres_per_centimetre = 0.01;

/// How the frame of the child's answer relates to metres and to the axes of the file.
struct FileFrame {
    double metres_per_unit = 0;  ///< of the file; 0: it does not say
    double metres_in_answer = 1; ///< what the reader has multiplied lengths with already
    bool y_up = false;           ///< of the file
    bool up_is_known = true;
    bool turned = false; ///< the reader has turned z-up to y-up
    std::string source;  ///< who says so
};

/// The text of an attribute: `meter="0.0254"` of the first <unit>.
std::string attribute(std::string_view text, std::string_view tag, std::string_view name)
{
    const std::size_t at = text.find(tag);
    if (at == std::string_view::npos)
        return {};
    const std::string_view inside = text.substr(at, std::min(text.find('>', at), text.size()) - at);
    const std::size_t word = inside.find(name);
    const std::size_t open = inside.find_first_of("\"'", word);
    if (word == std::string_view::npos || open == std::string_view::npos)
        return {};
    const std::size_t close = inside.find(inside[open], open + 1);
    return std::string(inside.substr(open + 1, close == std::string_view::npos ? 0 : close - open - 1));
}

/// Source  Collada 1.4.1, <asset>: <unit meter> (default 1), <up_axis> (default Y_UP)
FileFrame collada_frame(std::string_view text, const std::string& place, Report& report)
{
    FileFrame frame;
    const std::string meter = attribute(text, "<unit", "meter");
    const double stated = parse_double(meter).value_or(0);
    frame.metres_per_unit = stated > 0 && std::isfinite(stated) ? stated : 1;
    frame.metres_in_answer = frame.metres_per_unit;
    frame.source = meter.empty() ? "Collada's default" : "from <unit>";
    const std::size_t up = text.find("<up_axis>");
    const std::string_view axis = up == std::string_view::npos ? "" : trimmed(text.substr(up + 9, 6));
    frame.y_up = axis.substr(0, 1) != "Z";
    if (axis.substr(0, 1) == "X")
        report.add(Finding::unsupported, place, "up axis X is not turned; the model is read as y up");
    return frame;
}

/// Source  FBX SDK, FbxSystemUnit (centimetres), FbxAxisSystem
FileFrame fbx_frame(const ForeignScene& scene, const std::string& place, Report& report)
{
    FileFrame frame;
    const bool stated = scene.centimetres_per_unit > 0 && std::isfinite(scene.centimetres_per_unit);
    frame.metres_per_unit = (stated ? scene.centimetres_per_unit : 1) * metres_per_centimetre;
    frame.source = stated ? "from UnitScaleFactor" : "FBX's default";
    frame.y_up = scene.up_axis != 2;
    if (scene.up_axis == 0 || scene.up_sign < 0)
        report.add(Finding::unsupported, place, "up axis X or turned over; the model is read as y up");
    return frame;
}

FileFrame ifc_frame(const ForeignScene& scene, const IfcText& ifc)
{
    FileFrame frame;
    frame.turned = true;
    if (!scene.nodes.empty())
        frame.metres_in_answer = length(scene.nodes.front().to_parent.x);
    frame.metres_per_unit = ifc.metres_per_unit > 0 ? ifc.metres_per_unit : frame.metres_in_answer;
    frame.source = "from IfcUnitAssignment";
    return frame;
}

FileFrame frame_of(const std::string& extension, const ForeignScene& scene, const IfcText& ifc, std::string_view text,
                   const std::string& place, Report& report)
{
    if (extension == "ifc")
        return ifc_frame(scene, ifc);
    if (extension == "dae")
        return collada_frame(text, place, report);
    if (extension == "fbx")
        return fbx_frame(scene, place, report);
    FileFrame frame;
    if (extension == "x3d") {
        frame.metres_per_unit = 1;
        frame.y_up = true;
        frame.source = "X3D";
        return frame;
    }
    frame.turned = extension == "3ds";
    frame.up_is_known = frame.turned;
    return frame;
}

/// From the child's answer to metres, z up.
Affine answer_to_metres(const FileFrame& frame, double metres_per_unit, bool y_up)
{
    const double scale = metres_per_unit / frame.metres_in_answer;
    const Affine straight = frame.turned ? to_metres_z_up(MetresPerUnit{1}, true) : Affine{};
    return compose(to_metres_z_up(MetresPerUnit{scale}, y_up), straight);
}

/// Names that readers give to surfaces for which the file has no material.
bool is_made_up(const std::string& name)
{
    return name == "DefaultMaterial" || name == "<IFCDefault>" || name == "%%%DEFAULT" || name == "SkeletonMaterial";
}

/// Materials that the file does not have lose their colour; styles of IFC get their blanks back.
void clean_materials(ForeignScene& scene, const IfcText& ifc)
{
    for (ForeignMaterial& material : scene.materials) {
        const auto full = ifc.style_names.find(material.name);
        if (full != ifc.style_names.end())
            material.name = full->second;
        if (is_made_up(material.name))
            material = {};
    }
}

/// Readers turn axes in single precision: what is left of a sine of zero is taken out.
void clean_maps(ForeignScene& scene)
{
    constexpr double noise = 1e-6;
    for (ForeignNode& node : scene.nodes) {
        Affine& map = node.to_parent;
        const double size = std::fmax(max_abs(map.x), std::fmax(max_abs(map.y), max_abs(map.z)));
        for (Vec3* column : {&map.x, &map.y, &map.z})
            for (int axis = 0; axis < 3; ++axis)
                if (std::fabs((*column)[axis]) < noise * size)
                    (*column)[axis] = 0;
    }
}

void check_options(const std::string& place, const ImportOptions& options)
{
    if (options.metres_per_unit && !(*options.metres_per_unit > 0 && std::isfinite(*options.metres_per_unit)))
        throw InputError{place, fmt::format("unit is {} m, expected > 0", *options.metres_per_unit)};
    if (!options.up.empty() && options.up != "z" && options.up != "y")
        throw InputError{place, "up is \"" + options.up + "\", expected \"y\" or \"z\""};
}

Vec3 size_of(const Imported& imported)
{
    const Box box = bounds(imported.scene);
    return box.empty() ? Vec3{} : box.high - box.low;
}

void note_precision(const std::string& place, Imported& imported)
{
    const Box box = bounds(imported.scene);
    const double farthest_m = box.empty() ? 0 : std::fmax(max_abs(box.low), max_abs(box.high));
    if (farthest_m * single_precision > visible_rounding_m)
        imported.report.add(Finding::approximated, place,
                            fmt::format("coordinates reach {:.4g} m and are read in single precision: places are known "
                                        "to {:.2g} m; move the model to the origin before the export",
                                        farthest_m, farthest_m * single_precision));
}

/// One attempt with one unit.
Imported built(const ForeignScene& scene, const ForeignFile& file, const FileFrame& frame, const ImportOptions& options,
               double metres_per_unit, const std::string& source, const Report& reading)
{
    Imported imported;
    imported.report = reading;
    imported.unit = fmt::format("{} ({})", unit_name(MetresPerUnit{metres_per_unit}), source);
    const bool y_up = options.up.empty() ? frame.y_up : options.up == "y";
    build_foreign(scene, file, answer_to_metres(frame, metres_per_unit, y_up), imported);
    return imported;
}

Imported with_unit(const ForeignScene& scene, const ForeignFile& file, const FileFrame& frame,
                   const ImportOptions& options, const Report& reading)
{
    const auto attempt = [&](double metres, const std::string& source) {
        return built(scene, file, frame, options, metres, source, reading);
    };
    if (options.metres_per_unit)
        return attempt(*options.metres_per_unit, "given");
    if (frame.metres_per_unit > 0)
        return attempt(frame.metres_per_unit, frame.source);
    Imported imported = attempt(1e-3, "assumed");
    if (length(size_of(imported)) < smallest_model_m)
        imported = attempt(1, "assumed: in mm the model would be too small");
    const Vec3 size = size_of(imported);
    imported.report.add(Finding::assumed, file.name,
                        fmt::format("the format states no unit; read as {}, the model measures {:.4g} x {:.4g} x "
                                    "{:.4g} m; give the unit if that is wrong",
                                    imported.unit, size.x, size.y, size.z));
    return imported;
}

} // namespace

bool recognize_assimp(const std::filesystem::path& file)
{
    const MappedFile mapped(file);
    return foreign_format_of(mapped.bytes(), mapped.bytes().size()) != nullptr;
}

Imported import_assimp(const std::filesystem::path& file, const ImportOptions& options)
{
    const std::string place = file.filename().string();
    check_options(place, options);
    const MappedFile mapped(file);
    const std::string_view bytes = mapped.bytes();
    const ForeignFormat* const format = foreign_format_of(bytes, bytes.size());
    if (format == nullptr)
        throw InputError(place, "content is none of FBX, Collada, 3DS, PLY, STL, X3D, OFF, IFC 2x3");
    if (format->refusal != nullptr)
        throw InputError(place, format->refusal);
    if (std::string_view(format->extension) == "ply")
        check_ply_header(bytes, place);
    const std::string named = place + " (" + format->name + ")";
    ForeignScene scene =
        scene_from_bytes(run_import_program(file, format->extension, child_limits(bytes.size()), named), named);
    const std::string extension = format->extension;
    const IfcText ifc = extension == "ifc" ? read_ifc_text(bytes) : IfcText{};
    clean_maps(scene);
    clean_materials(scene, ifc);
    Report reading;
    const FileFrame frame = frame_of(extension, scene, ifc, bytes, place, reading);
    if (!frame.up_is_known && options.up.empty())
        reading.add(Finding::assumed, place, "the format does not say which axis points up; read as z up");
    const ForeignFile words{place, extension == "ifc" ? &ifc : nullptr};
    Imported imported = with_unit(scene, words, frame, options, reading);
    if (imported.scene.root.surfaces.empty() && imported.scene.views.empty() && imported.ledger.read_count() == 0)
        throw InputError(place, std::string("the ") + format->name + " file has no surfaces, lines, lamps or cameras",
                         "export it again, or as glTF or OBJ");
    note_precision(place, imported);
    return imported;
}

} // namespace lightwell
