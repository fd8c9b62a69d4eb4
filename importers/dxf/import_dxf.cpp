#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/dxf/build_scene.h"
#include "importers/dxf/drawing.h"
#include "importers/dxf/external_files.h"
#include "importers/dxf/read_tags.h"
#include "importers/importer.h"
#include "importers/units.h"

#include <fmt/format.h>

namespace lightwell {
namespace {

/// Smaller than this, a model is no room: what was read as millimetres was drawn in metres.
constexpr double smallest_model_m = 0.5;

/// How long a drawing unit is, and how that is known.
struct DrawingUnit {
    MetresPerUnit metres;
    std::string source; ///< "from $INSUNITS", "given", or "assumed"
    bool is_assumed = false;
};

DrawingUnit drawing_unit(const dxf::Drawing& drawing, const ImportOptions& options)
{
    if (options.metres_per_unit)
        return {MetresPerUnit{*options.metres_per_unit}, "given"};
    const MetresPerUnit stated = unit_of_insunits(drawing.insunits.value_or(0));
    if (stated.value > 0)
        return {stated, "from $INSUNITS"};
    constexpr int engineering = 3, architectural = 4; // 1'-3.5" and 1'-3 1/2"
    if (drawing.linear_format == engineering || drawing.linear_format == architectural)
        return {parse_unit("in"), "assumed: $LUNITS writes feet and inches", true};
    if (drawing.measurement == 0)
        return {parse_unit("in"), "assumed: $MEASUREMENT is English", true};
    return {parse_unit("mm"), drawing.measurement ? "assumed: $MEASUREMENT is metric" : "assumed", true};
}

Imported built(const dxf::Drawing& drawing, const DrawingUnit& unit, const ImportOptions& options,
               const Report& reading)
{
    Imported imported;
    imported.report = reading;
    imported.unit = fmt::format("{} ({})", unit_name(unit.metres), unit.source);
    dxf::build_scene(drawing, unit.metres, options, imported);
    return imported;
}

/// An assumed unit is reported with the size of the model that follows from it, where a wrong one shows.
void report_unit(const dxf::Drawing& drawing, Imported& imported)
{
    const Box box = bounds(imported.scene);
    const Vec3 size = box.empty() ? Vec3{} : box.high - box.low;
    imported.report.add(Finding::assumed, drawing.file(),
                        fmt::format("the file does not state its unit ($INSUNITS); read as {}, the model measures "
                                    "{:.4g} x {:.4g} x {:.4g} m; give the unit if that is wrong",
                                    imported.unit, size.x, size.y, size.z));
}

void check_options(const std::filesystem::path& file, const ImportOptions& options)
{
    if (!(options.chord_tolerance_m > 0))
        throw InputError{file.string(),
                         fmt::format("chord tolerance is {} m, expected > 0", options.chord_tolerance_m)};
    if (options.metres_per_unit && !(*options.metres_per_unit > 0 && std::isfinite(*options.metres_per_unit)))
        throw InputError{file.string(), fmt::format("unit is {} m, expected > 0", *options.metres_per_unit)};
    for (const RaisedLayer& rule : options.raised)
        if (!(rule.height_m > 0 && std::isfinite(rule.height_m)))
            throw InputError{file.string(),
                             fmt::format("height of layer \"{}\" is {} m, expected > 0", rule.layer, rule.height_m)};
    if (!options.up.empty() && options.up != "z" && options.up != "y")
        throw InputError{file.string(), "up is \"" + options.up + "\", expected \"y\" or \"z\""};
}

} // namespace

bool recognize_dxf(const std::filesystem::path& file)
{
    return dxf::looks_like_dxf(MappedFile{file}.bytes());
}

Imported import_dxf(const std::filesystem::path& file, const ImportOptions& options)
{
    check_options(file, options);
    Report reading;
    const dxf::Drawing drawing = dxf::read_drawing_with_references(file, reading); // tags -> entities with their lines
    DrawingUnit unit = drawing_unit(drawing, options);
    Imported imported = built(drawing, unit, options, reading); // blocks -> prototypes, entities -> surfaces
    if (!unit.is_assumed)
        return imported;
    const Box box = bounds(imported.scene);
    if (drawing.measurement != 0 && !box.empty() && box.diagonal() < smallest_model_m) {
        unit = {parse_unit("m"), "assumed: in mm the model would be too small", true};
        imported = {}; // else both would take memory at once
        imported = built(drawing, unit, options, reading);
    }
    report_unit(drawing, imported);
    return imported;
}

} // namespace lightwell
