#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/dxf/build_scene.h"
#include "importers/dxf/drawing.h"
#include "importers/dxf/read_tags.h"
#include "importers/importer.h"
#include "importers/units.h"

#include <fmt/format.h>

namespace lightwell {
namespace {

/// How long a drawing unit is, and how that is known.
struct DrawingUnit {
    MetresPerUnit metres;
    std::string source; ///< "from $INSUNITS", "given", or "assumed: ..."
    bool is_assumed = false;
};

DrawingUnit drawing_unit(const dxf::Drawing& drawing, const ImportOptions& options)
{
    if (options.metres_per_unit)
        return {MetresPerUnit{*options.metres_per_unit}, "given"};
    const MetresPerUnit stated = unit_of_insunits(drawing.insunits.value_or(0));
    if (stated.value > 0)
        return {stated, "from $INSUNITS"};
    if (drawing.measurement == 0)
        return {parse_unit("in"), "assumed: $MEASUREMENT is English", true};
    return {parse_unit("mm"), drawing.measurement ? "assumed: $MEASUREMENT is metric" : "assumed", true};
}

/// An assumed unit is reported with the size of the model that follows from it, where a wrong one shows.
void report_unit(const dxf::Drawing& drawing, const DrawingUnit& unit, Imported& imported)
{
    if (!unit.is_assumed)
        return;
    const Box box = bounds(imported.scene);
    const Vec3 size = box.empty() ? Vec3{} : box.high - box.low;
    imported.report.add(
        Finding::assumed, drawing.file,
        fmt::format("the file does not state its unit ($INSUNITS); {} is {}, which makes the model {:.4g} x {:.4g} x "
                    "{:.4g} m; give the unit if that is wrong",
                    unit_name(unit.metres), unit.source, size.x, size.y, size.z));
}

void check_options(const std::filesystem::path& file, const ImportOptions& options)
{
    if (!(options.chord_tolerance_m > 0))
        throw InputError{file.string(),
                         fmt::format("chord tolerance is {} m, expected > 0", options.chord_tolerance_m)};
    if (options.metres_per_unit && !(*options.metres_per_unit > 0 && std::isfinite(*options.metres_per_unit)))
        throw InputError{file.string(), fmt::format("unit is {} m, expected > 0", *options.metres_per_unit)};
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
    Imported imported;
    const dxf::Drawing drawing = dxf::read_drawing(file, imported.report);
    const DrawingUnit unit = drawing_unit(drawing, options);
    imported.unit = fmt::format("{} ({})", unit_name(unit.metres), unit.source);
    dxf::build_scene(drawing, unit.metres, options.up == "y", options.chord_tolerance_m, imported);
    report_unit(drawing, unit, imported);
    return imported;
}

} // namespace lightwell
