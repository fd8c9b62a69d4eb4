#include "engine/base/errors.h"
#include "importers/formats/formats.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace lightwell {
namespace {

using Json = nlohmann::json;

std::filesystem::path hosts_folder()
{
    return shared_fixtures() / "hosts";
}

Json truth_of(const std::string& folder)
{
    std::ifstream in{hosts_folder() / folder / "truth.json"};
    return in ? Json::parse(in) : Json{};
}

/// What the host's own objects measure, m^2: each exporter keeps some of them.
struct OfficeAreas {
    double shown = 0;     ///< as modelled, without excluded collections
    double excluded = 0;  ///< what the collections that are excluded hold
    double stools = 0;    ///< three instances of an excluded collection
    double smoothing = 0; ///< what applying the subdivision adds; below 0
};

OfficeAreas office_areas(const Json& truth)
{
    OfficeAreas areas;
    for (const auto& [name, collection] : truth["collections"].items())
        (collection["excluded_from_view_layer"].get<bool>() ? areas.excluded : areas.shown) +=
            collection["area"].get<double>();
    areas.stools = 3 * truth["collections"]["Chair asset"]["area"].get<double>();
    const Json& pouf = truth["objects"]["Pouf (subdivision)"];
    areas.smoothing = pouf["evaluated"]["area"].get<double>() - pouf["cage"]["area"].get<double>();
    return areas;
}

/// What one file must hold.
struct Wanted {
    double area_m2, relative;
    double bounds_within_m;
};

class Table {
public:
    explicit Table(std::string folder) : folder_(std::move(folder)), truth_(truth_of(folder_)) {}

    const Json& truth() const { return truth_; }
    void expect_model(const std::string& name, const Wanted& wanted, const Box& bounds, const std::string& up = {})
    {
        SCOPED_TRACE(name);
        ImportOptions options;
        options.up = up;
        const Imported model = import_file(hosts_folder() / folder_ / name, options);
        validate(model.scene);
        double area = 0;
        Box found;
        visit_expanded(model.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId) {
            if (surface.shape == Shape::sphere || surface.shape == Shape::source)
                return; // the balls that stand for point lights are ours
            Share share;
            measure_surface(part, surface, map, share, found);
            area += share.area_m2;
        });
        EXPECT_NEAR(area, wanted.area_m2, wanted.relative * wanted.area_m2);
        EXPECT_LE(max_abs(found.low - bounds.low), wanted.bounds_within_m);
        EXPECT_LE(max_abs(found.high - bounds.high), wanted.bounds_within_m);
        EXPECT_GT(model.ledger.made_count(), 0u);
        std::cout << folder_ << "/" << name << ": agrees, " << area << " m2, truth " << wanted.area_m2 << " m2\n";
    }
    void expect_refused(const std::string& name, const std::string& word)
    {
        SCOPED_TRACE(name);
        try {
            import_file(hosts_folder() / folder_ / name, {});
            ADD_FAILURE() << "was read";
        } catch (const InputError& error) {
            EXPECT_NE(std::string{error.what()}.find(name), std::string::npos) << error.what();
            EXPECT_NE(std::string{error.what()}.find(word), std::string::npos) << error.what();
            std::cout << error.what() << "\n";
        }
    }

private:
    std::string folder_;
    Json truth_;
};

Box box_of(const Json& numbers)
{
    const auto point = [](const Json& p) { return Point{p[0].get<double>(), p[1].get<double>(), p[2].get<double>()}; };
    return {point(numbers[0]), point(numbers[1])};
}

TEST(Hosts, EveryOfficeFileHasTheAreaOfTheObjectsThatItsExporterKeeps)
{
    Table table{"blender_office"};
    if (table.truth().empty())
        GTEST_SKIP() << "the office is not at hand";
    const OfficeAreas areas = office_areas(table.truth());
    const Box whole = box_of(table.truth()["bbox_metres"]);
    const Box shown{{0, 0, 0}, whole.high}; // the stool at the origin is excluded
    constexpr double single_precision = 1e-5, bounds_m = 1e-4;
    // Two OBJ files were written with z up, which the format cannot say.
    const auto expect = [&](const std::string& name, double area, const Box& bounds, const std::string& up = {}) {
        table.expect_model(name, {area, single_precision, bounds_m}, bounds, up);
    };
    const double all = areas.shown + areas.excluded;
    expect("office.dae", areas.shown, shown);
    expect("office.dxf", areas.shown + areas.smoothing, shown);
    expect("office.fbx", areas.shown + areas.stools, shown);
    expect("office.obj", areas.shown + areas.stools, shown, "z");
    expect("office_yup_applied.obj", areas.shown + areas.stools + areas.smoothing, shown);
    expect("office_legacy.obj", all + areas.stools, whole, "z");
    expect("office.glb", all + areas.stools, whole);
    expect("office.gltf", all + areas.stools, whole);
    expect("office_applied.glb", all + areas.stools + areas.smoothing, whole);
    expect("office.ply", all + areas.smoothing, whole);
    expect("office.stl", all + areas.smoothing, whole);
    table.expect_refused("office.blend", "none of the formats");
}

TEST(Hosts, EveryBuildingFileHasTheAreaOfTheExportedObjects)
{
    Table table{"freecad_building"};
    if (table.truth().empty())
        GTEST_SKIP() << "the building is not at hand";
    double area = 0;
    for (const Json& name : table.truth()["exported_objects"])
        area += table.truth()["objects"][name.get<std::string>()]["area_mm2"].get<double>() * 1e-6;
    // The exporters cut curved faces into chords, 5 mm at most: 0.04 % of all area here.
    constexpr double chords = 4e-4, chords_m = 5e-3;
    for (const char* name : {"building.glb", "building.gltf", "building.obj", "building.ply", "building.stl"})
        table.expect_model(name, {area, chords, chords_m}, box_of(table.truth()["bbox_m"]));
    table.expect_refused("building.step", "STEP");
    table.expect_refused("building_nocolour.step", "STEP");
    table.expect_refused("building.iges", "IGES");
    for (const char* name : {"building.brep", "building.3mf", "building.FCStd"})
        table.expect_refused(name, "none of the formats");
    const Imported plan = import_file(hosts_folder() / "freecad_building/building.dxf", {});
    EXPECT_EQ(plan.ledger.made_count(), 0u); // edges only
}

} // namespace
} // namespace lightwell
