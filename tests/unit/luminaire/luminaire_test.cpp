#include "engine/scene/luminaire.h"

#include "engine/accel/ray_queries.h"
#include "engine/simulate/simulate.h"
#include "engine/sources/source_list.h"
#include "importers/radiance/radiance.h"
#include "materials/patterns/data_table.h"
#include "tests/unit/luminaire/photometric_files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <optional>
#include <sstream>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

Photometry parsed(const std::string& text)
{
    Report report;
    return parse_ies(text, "lamp.ies", report);
}

/// A scene of one luminaire in place.
Scene scene_of(const Photometry& photometry, const Affine& place, LuminaireLook look = {})
{
    Scene scene;
    Report report;
    scene.prototypes.push_back(luminaire_part(scene, photometry, look, report));
    scene.root.add_instance({0, place, {}}, "luminaire");
    validate(scene);
    return scene;
}

/// Irradiance of one lamp from side * side samples; nothing when one of them finds no light to aim at, and `strict`.
std::optional<double> irradiance(const LocalSource& lamp, const Point& at, const Direction& normal, int side,
                                 bool strict)
{
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
        const SourceSample s = lamp.sample(at, {(i % side + 0.5) / side, (i / side + 0.5) / side});
        if (s.density_per_sr > 0)
            sum += photopic(s.radiance) * std::fmax(0, dot(normal, s.to_light)) / s.density_per_sr;
        else if (strict)
            return {};
    }
    return sum / (side * side);
}

/// Illuminance without obstacles, lx. Far away one sample of a flat lamp or a ball says it all; the sides of cylinders
/// are sampled by area, of which half is turned away.
double illuminance(const SourceList& sources, const Point& at, const Direction& normal)
{
    double sum = 0;
    for (const LocalSource& lamp : sources.lamps()) {
        constexpr double far = 0.02;
        const bool flat = lamp.reach().half_angle_rad < 3;
        const auto quick = lamp.seen_size(at) < far ? irradiance(lamp, at, normal, flat ? 1 : 3, true) : std::nullopt;
        const bool turned_away = flat && !quick && lamp.seen_size(at) < far;
        sum += quick ? *quick : turned_away ? 0 : *irradiance(lamp, at, normal, 48, false);
    }
    return sum * lumens_per_watt;
}

/// Flat openings of recorded conversions have 1 / area behind their function; true when this is one.
bool has_area_of_record(const Photometry& photometry, const std::string& record, double factor)
{
    using Shape = Photometry::Opening::Shape;
    const std::size_t at = record.find("flatcorr");
    if (at == std::string::npos || photometry.opening.shape == Shape::cylinder_along_x)
        return false;
    std::stringstream numbers(record.substr(record.find("\n0\n1 ", at) + 5));
    double per_area = 0;
    numbers >> per_area;
    Scene scene;
    Report report;
    const Part part = luminaire_part(scene, photometry, {}, report);
    EXPECT_EQ(part.surfaces.size(), 1U);
    EXPECT_NEAR(factor / surface_area_m2(part, part.surfaces[0]), per_area, 2e-5 * per_area);
    return true;
}

Affine tilted_place()
{
    return compose(Affine::translate({3, -2, 5}), compose(Affine::rotate(0, 0.4), Affine::rotate(2, 1.1)));
}

/// The flux through a large sphere about the luminaire: midpoint rule in angles from its axis.
double flux_of(const Photometry& photometry)
{
    const Affine place = tilted_place();
    const Scene scene = scene_of(photometry, place);
    const RayQueries rays(scene);
    const SourceList sources(scene, rays);
    const double far = 1000 * std::max({photometry.opening.x_m, photometry.opening.y_m, photometry.opening.z_m, 0.05});
    const int turns = photometry.horizontal_deg.size() == 1 && photometry.type == Photometry::Type::C ? 1 : 24;
    constexpr int steps = 180;
    double flux = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < turns; ++k) {
            const double theta = pi * (i + 0.5) / steps, phi = 2 * pi * (k + 0.3) / turns;
            const Direction to = normalized(
                place.vector({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)}));
            const double candela = illuminance(sources, place.translation + to * far, -to) * far * far;
            flux += candela * std::sin(theta) * (pi / steps) * (2 * pi / turns);
        }
    return flux;
}

} // namespace

/// What a file holds leaves its surfaces in the scene, turned and moved.
TEST(Luminaire, LumensOfEveryRealFileLeaveTheLuminousOpeningInTheScene)
{
    const fs::path folder = shared("fixtures/photometry");
    if (!fs::exists(folder))
        GTEST_SKIP() << "no luminaires beside the repository";
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".ies" && ending != ".IES" && ending != ".ldt")
            continue;
        SCOPED_TRACE(entry.path().filename().string());
        Report report;
        const Photometry photometry = read_photometry(entry.path(), report);
        EXPECT_NEAR(flux_of(photometry), photometry.lumens(), 0.005 * photometry.lumens());
        ++files;
    }
    EXPECT_EQ(files, 43);
}

/// A small source of constant intensity, and of I cos theta, above a plane: E = I(theta) cos^3 theta / h^2.
TEST(Luminaire, EveryShapeOfOpeningGivesTheIntensityOfItsFileFromFar)
{
    for (const char* size : {"0 0 0", "0.2 0.5 0", "-0.3 -0.3 0", "-0.2 -0.4 0", "0.2 0.3 0.1", "-0.2 -0.2 0.3",
                             "-0.2 -0.2 -0.2", "0 0.6 -0.1", "0.6 0 -0.1", "-0.1 -0.2 -0.3"}) {
        SCOPED_TRACE(size);
        const Photometry photometry = parsed(ies_text([](double t) { return 600 + 400 * std::cos(t); }, size));
        const Scene scene = scene_of(photometry, Affine::translate({0, 0, 200}));
        const RayQueries rays(scene);
        const SourceList sources(scene, rays);
        for (const double x : {0.0, 100.0, 300.0}) {
            const Point at{x * 0.6, x * 0.8, 0};
            const double distance = length(at - Point{0, 0, 200}), cosine = 200 / distance;
            const double wanted = (600 + 400 * cosine) * cosine / (distance * distance);
            EXPECT_NEAR(illuminance(sources, at, {0, 0, 1}), wanted, 0.004 * wanted) << x;
        }
        const double above = illuminance(sources, {0, 0, 400}, {0, 0, -1});
        EXPECT_NEAR(above, 200.0 / (200 * 200), 0.004 * 200.0 / (200 * 200));
    }
}

/// Near a rectangle of 0.5 by 0.2 m that sends I(theta): each piece of its area sends I(theta) / area.
TEST(Luminaire, NearAnOpeningItsExtentCounts)
{
    const Photometry photometry = parsed(ies_text(lambertian, "0.2 0.5 0", 90));
    const Scene scene = scene_of(photometry, Affine::translate({0, 0, 0.3}));
    const RayQueries rays(scene);
    const SourceList sources(scene, rays);
    for (const double x : {0.0, 0.2, 0.6}) {
        double wanted = 0;
        constexpr int pieces = 200;
        for (int i = 0; i < pieces; ++i)
            for (int k = 0; k < pieces; ++k) {
                const double dx = x - (i + 0.5 - pieces / 2.0) * 0.5 / pieces,
                             dy = (k + 0.5 - pieces / 2.0) * 0.2 / pieces;
                const double squared = dx * dx + dy * dy + 0.09, cosine = 0.3 / std::sqrt(squared);
                wanted += 1000 * cosine * cosine / squared / (pieces * pieces);
            }
        EXPECT_NEAR(illuminance(sources, {x, 0, 0}, {0, 0, 1}), wanted, 0.002 * wanted) << x;
        const double as_point = 1000 * std::pow(0.3, 2) / std::pow(x * x + 0.09, 2);
        EXPECT_GT(std::fabs(wanted / as_point - 1), 0.03) << "too far away to tell an extent from a point";
    }
}

/// Types A and B: a beam whose intensity depends on one of the angles alone, against the angles' definition.
TEST(Luminaire, TypesAAndBTurnAboutTheirOwnAxes)
{
    const std::string head = "TILT=NONE\n1 -1 1 3 3 ", rest = " 2 0 0 0\n1 1 1\n-90 0 90\n-90 0 90\n";
    for (const int type : {2, 3}) {
        // Table [horizontal][vertical]: 0 at vertical -90 and 90, 900 at 0, whatever the horizontal angle.
        const Photometry p = parsed(head + std::to_string(type) + rest + "0 900 0\n0 900 0\n0 900 0\n");
        const double t = 30 * pi / 180;
        const Direction along_x{std::sin(t), 0, -std::cos(t)}; // vertical angle 30, horizontal 0
        EXPECT_NEAR(p.candela_towards(along_x), 600, 1e-9);
        const double h = 60 * pi / 180, v = 30 * pi / 180;
        const Direction both = type == 2 // B: within the plane of vertical angle v, h from its middle
                                   ? Direction{std::sin(v) * std::cos(h), -std::sin(h), -std::cos(v) * std::cos(h)}
                                   : Direction{std::sin(v), -std::cos(v) * std::sin(h), -std::cos(v) * std::cos(h)};
        EXPECT_NEAR(p.candela_towards(both), 600, 1e-9);
        EXPECT_NEAR(flux_of(p), p.lumens(), 0.005 * p.lumens());
        // Flux in closed form: B: int cos h dh int (1 - |v| / 90) dv; A: int dh int (1 - |v| / 90) cos v dv.
        const double wanted = type == 2 ? 900 * 2 * (pi / 2) : 900 * pi * 2 * (2 / pi);
        EXPECT_NEAR(p.lumens(), wanted, 1e-6 * wanted);
    }
}

TEST(Luminaire, SymmetricHalvesOfTypeBAreCompleted)
{
    const std::string rest = " 2 0 0 0\n1 1 1\n";
    const Photometry half = parsed("TILT=NONE\n1 -1 1 2 2 2" + rest + "0 90\n0 90\n100 0\n50 0\n");
    EXPECT_EQ(half.vertical_deg.size(), 3U);
    EXPECT_EQ(half.horizontal_deg.size(), 3U);
    for (const double x : {0.5, -0.5})
        for (const double y : {0.3, -0.3})
            EXPECT_NEAR(half.candela_towards(normalized(Vec3{x, y, -1})),
                        half.candela_towards(normalized(Vec3{0.5, 0.3, -1})), 1e-9);
}

/// The factors of a lamp that is tilted: at 45 degrees 0.9 of the light.
TEST(Luminaire, TiltFactorsDimWhatIsTilted)
{
    const fs::path file = shared("fixtures/photometry/tilt_include.ies");
    if (!fs::exists(file))
        GTEST_SKIP() << "no luminaires beside the repository";
    Report report;
    const Photometry lamp = read_photometry(file, report);
    EXPECT_DOUBLE_EQ(lamp.share_tilted(0), 1);
    EXPECT_DOUBLE_EQ(lamp.share_tilted(45), 0.9);
    EXPECT_NEAR(lamp.share_tilted(67.5), 0.85, 1e-12);
    EXPECT_DOUBLE_EQ(lamp.share_tilted(180), 1);
}

/// Values of other programs for the same files: intensities in W/sr, and one over the area of the opening.
TEST(Luminaire, IntensitiesAndOpeningsAreThoseOfRecordedConversions)
{
    const fs::path record = shared("reference/ies2rad-outputs.json");
    if (!fs::exists(record))
        GTEST_SKIP() << "no recorded conversions beside the repository";
    const auto cases = nlohmann::json::parse(std::ifstream(record))["cases"];
    int compared = 0, areas = 0;
    for (const auto& one : cases) {
        const std::string file = one["file"];
        SCOPED_TRACE(file);
        Report report;
        const Photometry p = read_photometry(shared("fixtures/photometry") / file, report);
        // The record keeps the file's multiplier, and an option's, apart from the table.
        const bool flood = file.ends_with("stellaflood.IES");
        const double multiplier = flood ? 0.5 : 1, option = flood ? 0.85 : 1;
        for (const auto& [name, text] : one["outputs"].items()) {
            if (name.ends_with(".rad"))
                areas += has_area_of_record(p, text, multiplier * option) ? 1 : 0;
            if (!name.ends_with(".dat") || name.ends_with("%.dat"))
                continue;
            const DataTable table = DataTable::parse(text.get<std::string>(), name);
            for (double theta = 0; theta <= 90; theta += 7.5)
                for (double phi = 0; phi < 90; phi += 22.5) {
                    const double angles[] = {phi, theta};
                    const double t = theta * pi / 180, f = phi * pi / 180;
                    const double watts = table.at(table.dimensions() == 2 ? angles : angles + 1);
                    const Direction to{std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), -std::cos(t)};
                    const double wanted = watts * lumens_per_watt * multiplier;
                    EXPECT_NEAR(p.candela_towards(to), wanted, 2e-5 * p.greatest_candela()) << phi << ' ' << theta;
                }
            ++compared;
        }
    }
    EXPECT_EQ(compared, 7);
    EXPECT_EQ(areas, 4); // the others: a box with light on all sides, one overridden, a cylinder that was replaced
}

/// Point sources above a plane, the values computed independently.
TEST(Luminaire, PointSourcesGiveTheIlluminancesOfTheTestCases)
{
    const fs::path file = shared("validation/cie171_electric.json");
    if (!fs::exists(file))
        GTEST_SKIP() << "no test cases beside the repository";
    int checked = 0;
    const auto cases = nlohmann::json::parse(std::ifstream(file))["cases"];
    for (const auto& one : cases) {
        const std::string id = one["id"];
        if (id != "cie171_point_lambertian" && id != "cie171_point_isotropic")
            continue;
        const bool isotropic = id.ends_with("isotropic");
        const Photometry p = parsed(ies_text([&](double t) { return isotropic ? 1000 : lambertian(t); }, "0 0 0"));
        EXPECT_NEAR(p.lumens(), one["lights"][0]["flux_lm"].get<double>(), 1e-4 * p.lumens());
        const Scene scene = scene_of(p, Affine::translate({0, 0, 3}));
        const RayQueries rays(scene);
        const SourceList sources(scene, rays);
        for (const auto& sensor : one["sensors"]) {
            const auto at = sensor["position"];
            const double wanted = one["expected"][sensor["id"].get<std::string>()];
            EXPECT_NEAR(illuminance(sources, {at[0], at[1], at[2]}, {0, 0, 1}), wanted, 0.003 * wanted) << id;
            ++checked;
        }
    }
    EXPECT_EQ(checked, 20);
}

/// Isotropic light of 10,000 lm in a closed room of reflectance 0.5: the mean over all faces is twice the direct 125
/// lx.
TEST(Luminaire, ARoomReceivesTheFluxAndReflectsIt)
{
    Scene scene = scene_of(parsed(ies_text([](double) { return 10000 / (4 * pi); }, "0 0 0")),
                           compose(Affine::translate({2, 2, 1.5}), Affine::rotate(1, 1)));
    const ModifierId walls = scene.add_material("walls", Plastic{Spectrum::grey(0.5), 0, 0});
    const Point c[8] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3}};
    constexpr int faces[6][4] = {{0, 1, 2, 3}, {7, 6, 5, 4}, {4, 5, 1, 0}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}};
    SensorGrid grid;
    std::vector<double> areas;
    for (const auto& face : faces) {
        const Vec3 a = c[face[1]] - c[face[0]], b = c[face[3]] - c[face[0]];
        scene.root.add_polygon({c[face[0]], c[face[1]], c[face[2]], c[face[3]]}, walls, "wall");
        constexpr int cells = 6;
        for (int i = 0; i < cells * cells; ++i) {
            const Direction inwards = normalized(cross(a, b));
            grid.sensors.push_back(
                {c[face[0]] + a * ((i % cells + 0.5) / cells) + b * ((i / cells + 0.5) / cells) + inwards * 1e-4,
                 inwards});
            areas.push_back(length(cross(a, b)) / (cells * cells));
        }
    }
    const Simulation simulation(std::move(scene));
    GridSettings settings;
    settings.samples = 256;
    const GridResult result = simulation.illuminance(grid, settings);
    double flux = 0, area = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        flux += result.values[i].value * areas[i];
        area += areas[i];
    }
    EXPECT_NEAR(flux / area, 250, 0.012 * 250); // of which 0.5 % for 36 cells a face
}

/// A panel as it is drawn, 100 cd/m2 to the eye, whose light is that of a file: I = 1000 cd cos theta over 0.36 m2.
TEST(Luminaire, ABodyIsSeenAsItIsAndLightsByItsDistribution)
{
    const Photometry photometry = parsed(ies_text(lambertian, "0.6 0.6 0", 90));
    const auto with_body = [&](bool body) {
        LuminaireLook look;
        look.seen = !body;
        look.body = body ? Vec3{0.31, 0.31, 0.05} : Vec3{};
        Scene scene = scene_of(photometry, Affine::translate({0, 0, 3}), look);
        const ModifierId floor = scene.add_material("floor", Plastic{Spectrum::grey(0.4), 0, 0});
        scene.root.add_polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, floor, "floor");
        if (body) {
            scene.add_material("panel.look", Light{Spectrum::grey(100 / lumens_per_watt)});
            const ModifierId panel = scene.add_material("panel", Illum{{}, "panel.look"});
            scene.root.add_polygon({{-.31, .31, 2.95}, {.31, .31, 2.95}, {.31, -.31, 2.95}, {-.31, -.31, 2.95}}, panel,
                                   "panel");
        }
        return Simulation(std::move(scene));
    };
    const auto luminance = [](const Simulation& simulation) {
        View view;
        view.position = {0.5, 0, 1};
        view.direction = {-0.2, 0, 1};
        view.up = {0, 1, 0};
        view.horizontal = view.vertical = 1;
        PictureSettings settings;
        settings.width = settings.height = 2;
        settings.samples = 64;
        const Picture picture = simulation.render(view, settings).picture;
        return lumens_per_watt * picture.at("R", 0, 0);
    };
    const auto on_floor = [](const Simulation& simulation, double x) {
        SensorGrid grid;
        grid.sensors = {{{x, 0.2, 0.001}, {0, 0, 1}}};
        GridSettings settings;
        settings.samples = 512;
        return simulation.illuminance(grid, settings).values[0].value;
    };
    const Simulation bare = with_body(false), dual = with_body(true);
    EXPECT_NEAR(luminance(bare), 1000 / 0.36, 0.01 * 1000 / 0.36);
    EXPECT_NEAR(luminance(dual), 100, 0.1);
    for (const double x : {0.0, 2.0, 4.0}) {
        const double height = 2.95 - 0.0005, distance_squared = x * x + 0.04 + height * height;
        const double about = 1000 * height * height / (distance_squared * distance_squared);
        EXPECT_NEAR(on_floor(dual, x), about, 0.02 * about) << x;
        EXPECT_NEAR(on_floor(bare, x), about * std::pow(3 / height, x == 0 ? -2 : 0), 0.035 * about) << x;
    }
}

TEST(Luminaire, SceneTextKeepsTheLightWithItsTableBesideIt)
{
    const fs::path folder = fs::path(testing::TempDir()) / "luminaire_text";
    fs::create_directories(folder);
    const Photometry photometry =
        parsed(ies_text([](double t) { return 300 + 700 * std::fabs(std::cos(t)); }, "0 0.9 -0.1"));
    const Scene scene = scene_of(photometry, tilted_place(), {"tube lamp", true, 1, {}});
    Report report;
    write_radiance(scene, folder / "lamp.rad", {}, report);
    const Scene again = read_radiance(folder / "lamp.rad", report);
    const RayQueries rays(scene), rays_again(again);
    const SourceList sources(scene, rays), sources_again(again, rays_again);
    ASSERT_EQ(sources_again.lamps().size(), 3U);
    for (const Point& at : {Point{0, 0, 0}, Point{3, 3, 3}, Point{6, -2, 9}}) {
        const Direction to = normalized(tilted_place().translation - at);
        const double wanted = illuminance(sources, at, to);
        EXPECT_NEAR(illuminance(sources_again, at, to), wanted, 1e-9 * wanted);
    }
    fs::remove_all(folder);
}

} // namespace lightwell
