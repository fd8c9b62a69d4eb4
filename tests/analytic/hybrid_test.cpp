#include "engine/scene/add_sky.h"
#include "tests/analytic/expect.h"

#include <algorithm>
#include <bit>

namespace lightwell {
namespace {

ModifierId grey(Scene& scene, const std::string& name, double reflectance)
{
    return scene.add_material(name, Plastic{Spectrum::grey(reflectance), 0, 0});
}

ModifierId lamp_of(Scene& scene, double luminance_cd_per_m2)
{
    return scene.add_material("lamp", Light{Spectrum::grey(luminance_cd_per_m2 / lumens_per_watt)});
}

SensorGrid grid_of(std::vector<Sensor> sensors)
{
    SensorGrid grid;
    grid.sensors = std::move(sensors);
    return grid;
}

GridSettings asked(double accuracy, int samples, bool unbiased = false)
{
    GridSettings settings;
    settings.accuracy = accuracy;
    settings.samples = samples;
    settings.unbiased = unbiased;
    return settings;
}

double mean_of(const std::vector<Illuminance>& values)
{
    double sum = 0;
    for (const Illuminance& v : values)
        sum += v.value / static_cast<double>(values.size());
    return sum;
}

/// The six faces of a box, each a polygon of its own, seen from inside: floor, ceiling, x = low, high, y = low, high.
struct Faces {
    ModifierId floor, ceiling, x0, x1, y0, y1;
};

std::vector<Point> level(const Point& a, const Point& b, double z)
{
    return {{a.x, a.y, z}, {b.x, a.y, z}, {b.x, b.y, z}, {a.x, b.y, z}};
}

void add_walls(Scene& scene, const Point& a, const Point& b, const Faces& m)
{
    const auto wall = [&](Point p, Point q, ModifierId material, const char* name) {
        scene.root.add_polygon({{p.x, p.y, a.z}, {q.x, q.y, a.z}, {q.x, q.y, b.z}, {p.x, p.y, b.z}}, material, name);
    };
    wall({a.x, a.y, 0}, {a.x, b.y, 0}, m.x0, "x0");
    wall({b.x, a.y, 0}, {b.x, b.y, 0}, m.x1, "x1");
    wall({a.x, a.y, 0}, {b.x, a.y, 0}, m.y0, "y0");
    wall({a.x, b.y, 0}, {b.x, b.y, 0}, m.y1, "y1");
}

void add_box(Scene& scene, const Point& a, const Point& b, const Faces& m)
{
    add_walls(scene, a, b, m);
    scene.root.add_polygon(level(a, b, a.z), m.floor, "floor");
    scene.root.add_polygon(level(a, b, b.z), m.ceiling, "ceiling");
}

/// A lamp of radius a in the middle of a closed sphere of radius 1: E = pi L a^2 / (1 - r (1 - a^2)), see
/// interreflection_test.cpp.
double sphere_illuminance(double reflectance, double a)
{
    return pi * 1000 * a * a / (1 - reflectance * (1 - a * a));
}

Simulation lit_sphere(double reflectance, double a)
{
    Scene scene;
    const ModifierId wall = grey(scene, "wall", reflectance), lamp = lamp_of(scene, 1000);
    scene.root.add_sphere({{0, 0, 0}, 1}, Shape::bubble, wall, "room");
    scene.root.add_sphere({{0, 0, 0}, a}, Shape::sphere, lamp, "bulb");
    return Simulation(std::move(scene));
}

SensorGrid sphere_sensors(int count)
{
    SensorGrid grid;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - 2 * (i + 0.5) / count, turn = pi * (3 - std::sqrt(5.0)) * i, s = std::sqrt(1 - z * z);
        const Direction out{s * std::cos(turn), s * std::sin(turn), z};
        grid.sensors.push_back({out * (1 - 1e-9), -out});
    }
    return grid;
}

TEST(HybridSphere, InterreflectionIsExactAtEveryReflectance)
{
    for (const double reflectance : {0.2, 0.8, 0.95, 0.99, 0.999}) {
        SCOPED_TRACE(reflectance);
        const GridResult found = lit_sphere(reflectance, 0.05).illuminance(sphere_sensors(16), asked(0.05, 64));
        EXPECT_NEAR(mean_of(found.values) / sphere_illuminance(reflectance, 0.05), 1, 0.01);
    }
}

/// In a closed sphere the hybrid has no bias: what is stated must be noise of the check that was not recognized as
/// such, and no more than three of its standard errors.
TEST(HybridBias, EachSensorHasItsOwnAndPlainPathsHaveNone)
{
    const Simulation sphere = lit_sphere(0.8, 0.05);
    GridSettings settings = asked(0.05, 64);
    const GridResult found = sphere.illuminance(sphere_sensors(16), settings);
    ASSERT_EQ(found.biases.size(), 16u);
    ASSERT_GT(found.bias.standard_error, 0);
    for (std::size_t i = 0; i < found.biases.size(); ++i)
        EXPECT_LT(std::fabs(found.biases[i].value), 3 * (found.bias.standard_error * 4) * found.values[i].value) << i;
    settings.unbiased = true;
    EXPECT_TRUE(sphere.illuminance(sphere_sensors(16), settings).biases.empty());
}

/// One point agrees with itself: what is stated is the noise of its plain paths.
TEST(HybridBias, OneSensorsBiasIsNoSurerThanThePathsThatCheckedIt)
{
    const Simulation sphere = lit_sphere(0.8, 0.05);
    const GridResult one = sphere.illuminance(sphere_sensors(1), asked(0.05, 64));
    ASSERT_EQ(one.bias.points, 1);
    EXPECT_GT(one.bias.standard_error, 0.001);
    EXPECT_LT(std::fabs(one.bias.mean), 5 * one.bias.standard_error) << "the field of a sphere has none";
}

/// Isotropic lamp of 10,000 lm in the middle of a cube of 4 m, all faces of one reflectance.
/// Source  radiosity with exact point-to-polygon factors on three meshes, and a random walk; uncertainty 0.03 %
TEST(HybridBox, ACubeIsThatOfTheRadiositySolution)
{
    struct Case {
        double reflectance, centre, quarter, edge, corner;
    };
    for (const Case& c : {Case{0.5, 310.9561913, 216.0731163, 177.0978996, 119.3108338},
                          Case{0.8, 630.0219811, 531.8828739, 488.4031413, 402.1042264},
                          Case{0.95, 2196.719342, 2096.544548, 2050.606955, 1941.99611}}) {
        SCOPED_TRACE(c.reflectance);
        Scene scene;
        const ModifierId w = grey(scene, "w", c.reflectance);
        add_box(scene, {0, 0, 0}, {4, 4, 4}, {w, w, w, w, w, w});
        constexpr double a = 0.02;
        scene.root.add_sphere({{2, 2, 2}, a}, Shape::sphere, lamp_of(scene, 10000 / (4 * pi * pi * a * a)), "bulb");
        const Direction up{0, 0, 1};
        const GridResult found =
            Simulation(std::move(scene))
                .illuminance(
                    grid_of({{{2, 2, 1e-6}, up}, {{1, 1, 1e-6}, up}, {{2, 0.1, 1e-6}, up}, {{0.1, 0.1, 1e-6}, up}}),
                    asked(0.02, 2048));
        const double expected[] = {c.centre, c.quarter, c.edge, c.corner};
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(found.values[i].value / expected[i], 1, 0.02) << i;
    }
}

struct Room {
    Scene scene;
    SensorGrid grid;
    std::vector<double> expected;
};

/// Room of 6 x 4 x 3 m, a flush lamp of 5000 cd/m^2 in the ceiling. Source as above.
Room radiosity_room()
{
    Room room;
    const ModifierId floor = grey(room.scene, "floor", 0.2), ceiling = grey(room.scene, "ceiling", 0.8);
    const ModifierId wall = grey(room.scene, "wall", 0.5), lamp = lamp_of(room.scene, 5000);
    add_walls(room.scene, {0, 0, 0}, {6, 4, 3}, {floor, ceiling, wall, wall, wall, wall});
    room.scene.root.add_polygon(level({0, 0, 0}, {6, 4, 0}, 0), floor, "floor");
    room.scene.root.add_polygon_with_holes(level({0, 0, 0}, {6, 4, 0}, 3), {level({2.4, 1.7, 0}, {3.6, 2.3, 0}, 3)},
                                           ceiling, "ceiling");
    room.scene.root.add_polygon({{2.4, 1.7, 3}, {2.4, 2.3, 3}, {3.6, 2.3, 3}, {3.6, 1.7, 3}}, lamp, "panel");
    const double e = 1e-6;
    room.grid = grid_of({{{3, 2, e}, {0, 0, 1}},
                         {{1, 1, e}, {0, 0, 1}},
                         {{0.2, 0.2, e}, {0, 0, 1}},
                         {{1, 1, 3 - e}, {0, 0, -1}},
                         {{3, 2.6, 3 - e}, {0, 0, -1}},
                         {{e, 2, 1.2}, {1, 0, 0}},
                         {{3, e, 2.7}, {0, 1, 0}},
                         {{3, 2, 0.8}, {0, 0, 1}},
                         {{5, 3, 0.8}, {0, 0, 1}}});
    room.expected = {472.2035214, 247.18259,   148.8334598, 77.44071879, 90.37090387,
                     209.8700757, 204.3388536, 779.0975363, 261.5693701};
    return room;
}

TEST(HybridRoom, ARoomIsThatOfTheRadiositySolution)
{
    Room room = radiosity_room();
    const GridResult found = Simulation(std::move(room.scene)).illuminance(room.grid, asked(0.02, 2048));
    for (std::size_t i = 0; i < room.expected.size(); ++i)
        EXPECT_NEAR(found.values[i].value / room.expected[i], 1, 0.02) << i;
}

/// What is asked for is the median of the relative errors: half of the sensors may be worse, some of them much.
TEST(HybridRoom, AskingForMoreGivesMore)
{
    double before = infinity;
    for (const double accuracy : {0.1, 0.01}) {
        SCOPED_TRACE(accuracy);
        Room room = radiosity_room();
        const GridResult found = Simulation(std::move(room.scene)).illuminance(room.grid, asked(accuracy, 0));
        std::vector<double> errors;
        for (std::size_t i = 0; i < room.expected.size(); ++i) {
            const double value = found.values[i].value, expected = room.expected[i];
            EXPECT_NEAR(value, expected, interval * found.standard_errors[i].value + 0.02 * expected) << i;
            errors.push_back(std::fabs(value / expected - 1));
        }
        std::sort(errors.begin(), errors.end());
        const double median = errors[errors.size() / 2];
        EXPECT_LT(median, 2 * accuracy);
        EXPECT_LT(median, before);
        before = median;
    }
}

/// A room of 5 x 4 x 3 m with an open window to an overcast sky and a dark ground.
Scene daylit_room()
{
    Scene scene;
    SkyModel sky;
    sky.kind = CieSky::overcast;
    sky.zenith = 5000 / lumens_per_watt;
    add_sky(scene, sky);
    const ModifierId floor = grey(scene, "floor", 0.3), ceiling = grey(scene, "ceiling", 0.8);
    const ModifierId wall = grey(scene, "wall", 0.6);
    scene.root.add_polygon(level({0, 0, 0}, {5, 4, 0}, 0), floor, "floor");
    scene.root.add_polygon(level({0, 0, 0}, {5, 4, 0}, 3), ceiling, "ceiling");
    const auto upright = [](double y0, double y1, double z0, double z1) -> std::vector<Point> {
        return {{0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}};
    };
    scene.root.add_polygon_with_holes(upright(0, 4, 0, 3), {upright(1, 3, 1, 2.5)}, wall, "x0");
    scene.root.add_polygon({{5, 0, 0}, {5, 4, 0}, {5, 4, 3}, {5, 0, 3}}, wall, "x1");
    scene.root.add_polygon({{0, 0, 0}, {5, 0, 0}, {5, 0, 3}, {0, 0, 3}}, wall, "y0");
    scene.root.add_polygon({{0, 4, 0}, {5, 4, 0}, {5, 4, 3}, {0, 4, 3}}, wall, "y1");
    return scene;
}

std::vector<Sensor> desks(int columns, int rows, double z)
{
    std::vector<Sensor> sensors;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            sensors.push_back({{5 * (column + 0.5) / columns, 4 * (row + 0.5) / rows, z}, {0, 0, 1}});
    return sensors;
}

TEST(HybridDaylight, ADaylitRoomIsThatOfPlainPathTracing)
{
    const Simulation room(daylit_room());
    const SensorGrid grid = grid_of(desks(5, 3, 0.75));
    const GridResult plain = room.illuminance(grid, asked(0.02, 8192, true));
    const GridResult hybrid = room.illuminance(grid, asked(0.02, 2048));
    for (std::size_t i = 0; i < grid.sensors.size(); ++i)
        EXPECT_NEAR(hybrid.values[i].value, plain.values[i].value,
                    interval * std::hypot(plain.standard_errors[i].value, hybrid.standard_errors[i].value) +
                        0.02 * plain.values[i].value)
            << i;
    EXPECT_NEAR(mean_of(hybrid.values) / mean_of(plain.values), 1, 0.02);
    EXPECT_GT(hybrid.bias.points, 0);
    EXPECT_LT(std::fabs(hybrid.bias.mean), 0.02 + 6 * hybrid.bias.standard_error);
    EXPECT_EQ(plain.bias.points, 0) << "plain path tracing has none";
}

/// From 2000 sensors on, records are shared; below, each has its own hemisphere of rays. The light is the same.
TEST(HybridDaylight, ManySensorsWithRecordsAgreeWithFewWithout)
{
    const Simulation room(daylit_room());
    const SensorGrid many = grid_of(desks(50, 40, 0.75));
    SensorGrid few;
    for (std::size_t i = 25; i < many.sensors.size(); i += 100)
        few.sensors.push_back(many.sensors[i]);
    const GridResult with = room.illuminance(many, asked(0.05, 8));
    const GridResult without = room.illuminance(few, asked(0.05, 1024));
    double mean_with = 0, mean_without = 0, error_with = 0, squares_without = 0;
    for (std::size_t k = 0; k < few.sensors.size(); ++k) {
        mean_with += with.values[25 + 100 * k].value;
        mean_without += without.values[k].value;
        error_with += with.standard_errors[25 + 100 * k].value; // neighbours share records: errors add up
        squares_without += std::pow(without.standard_errors[k].value, 2);
    }
    EXPECT_NEAR(mean_with, mean_without, 3 * std::sqrt(error_with * error_with + squares_without));
    EXPECT_LT(std::sqrt(error_with * error_with + squares_without), 0.08 * mean_without) << "too coarse to tell";
}

/// Sensors are further apart than the panels are from the ceiling, whose shaded parts tell nothing about other panels.
TEST(HybridDaylight, PanelsCloseBelowTheCeilingHaveTheirOwnLight)
{
    constexpr double gap_m = 0.01, lift_m = 1e-6;
    const Direction down{0, 0, -1};
    Scene scene = daylit_room();
    const ModifierId panel = grey(scene, "panel", 0.8);
    SensorGrid few, many;
    many.spacing_m = 1;
    for (const Sensor& above : desks(50, 40, 3 - lift_m))
        many.sensors.push_back({above.position, down});
    for (const double x : {0.3, 1.5, 2.7, 3.9})
        for (const double y : {0.4, 1.7, 3.0}) {
            scene.root.add_polygon(level({x, y, 0}, {x + 0.6, y + 0.6, 0}, 3 - gap_m), panel, "panel");
            few.sensors.push_back({{x + 0.3, y + 0.3, 3 - gap_m - lift_m}, down});
        }
    many.sensors.insert(many.sensors.end(), few.sensors.begin(), few.sensors.end());
    const Simulation room(std::move(scene));
    const GridResult with = room.illuminance(many, asked(0.05, 8));
    const GridResult without = room.illuminance(few, asked(0.02, 2048));
    double square = 0;
    for (std::size_t i = 0; i < few.sensors.size(); ++i) {
        const double found = with.values[many.sensors.size() - few.sensors.size() + i].value;
        square += std::pow(found / without.values[i].value - 1, 2) / static_cast<double>(few.sensors.size());
    }
    EXPECT_LT(std::sqrt(square), 0.07);
}

View into_the_room()
{
    View view;
    view.position = {4.8, 0.3, 1.6};
    view.direction = {-1, 0.6, -0.15};
    view.horizontal = view.vertical = 80;
    return view;
}

PictureSettings small_picture(int samples, bool unbiased)
{
    PictureSettings settings;
    settings.width = settings.height = 48;
    settings.samples = samples;
    settings.unbiased = unbiased;
    return settings;
}

struct Region {
    double mean = 0, error = 0;
};

/// One of 3 x 3 regions. The errors of its pixels count as if they were one: the cache makes them depend on each other.
Region region_of(const Picture& picture, int column, int row)
{
    Region region;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            region.mean += picture.at("G", 16 * column + x, 16 * row + y) / 256;
            region.error += picture.at("error.G", 16 * column + x, 16 * row + y) / 256;
        }
    return region;
}

TEST(HybridPicture, EachRegionIsThatOfPlainPathTracing)
{
    const Simulation room(daylit_room());
    const Picture plain = room.render(into_the_room(), small_picture(128, true)).picture;
    const Picture hybrid = room.render(into_the_room(), small_picture(16, false)).picture;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            const Region a = region_of(plain, column, row), b = region_of(hybrid, column, row);
            // Plain pixels are independent: their mean over 256 is 16 times as good as one of them. Interpolated ones
            // are not.
            EXPECT_NEAR(b.mean, a.mean, 0.03 * a.mean + 6 * a.error / 16 + 3 * b.error) << column << ' ' << row;
        }
}

TEST(HybridBits, DoNotDependOnTheNumberOfThreads)
{
    const Simulation room(daylit_room());
    for (const int columns : {10, 50}) { // hemispheres; records
        SensorGrid grid = grid_of(desks(columns, 40, 0.75));
        grid.spacing_m = 0.1;
        GridSettings settings = asked(0.2, 8);
        std::vector<std::vector<Illuminance>> found;
        for (const int threads : {1, 2, 4}) {
            settings.threads = threads;
            found.push_back(room.illuminance(grid, settings).values);
        }
        for (std::size_t i = 0; i < grid.sensors.size(); ++i) {
            ASSERT_EQ(found[0][i].value, found[1][i].value) << i;
            ASSERT_EQ(found[0][i].value, found[2][i].value) << i;
        }
    }
    std::vector<Picture> pictures;
    for (const int threads : {1, 2, 4}) {
        PictureSettings settings = small_picture(8, false);
        settings.accuracy = 0.2;
        settings.threads = threads;
        pictures.push_back(room.render(into_the_room(), settings).picture);
    }
    const auto bits = [](const std::vector<float>& values) { // those of NaN, where the sky is seen, included
        std::vector<std::uint32_t> all;
        for (const float v : values)
            all.push_back(std::bit_cast<std::uint32_t>(v));
        return all;
    };
    for (const char* channel : {"R", "G", "B", "illuminance.Y", "error.G"})
        for (const std::size_t other : {1u, 2u})
            ASSERT_EQ(bits(pictures[0].channels.at(channel)), bits(pictures[other].channels.at(channel))) << channel;
}

/// A level sheet under a uniform sky of luminance L over a black ground. From below: L times the diffuse
/// transmittance colour * transmission; from above: L times the diffuse reflectance colour * (1 - transmission).
TEST(HybridTranslucent, ASheetPassesTheLightOfItsBackToItsFront)
{
    Scene scene;
    const ModifierId glow = scene.add_material("sky", Glow{Spectrum::grey(1000 / lumens_per_watt), 0});
    scene.root.add_source({{0, 0, 1}, 180}, glow, "sky");
    const ModifierId sheet = scene.add_material("sheet", Trans{Spectrum::grey(0.8), 0, 0, 0.75, 0});
    scene.root.add_polygon(level({-1, -1, 0}, {1, 1, 0}, 2), sheet, "sheet");
    const Simulation simulation(std::move(scene));
    for (const bool from_below : {true, false}) {
        View view;
        view.position = {0.2, 0.1, from_below ? 0.0 : 4.0};
        view.direction = {0.05, 0.02, from_below ? 1.0 : -1.0};
        view.up = {0, 1, 0};
        view.horizontal = view.vertical = 20;
        PictureSettings settings;
        settings.width = settings.height = 16;
        settings.samples = 32;
        const Picture picture = simulation.render(view, settings).picture;
        double mean = 0;
        for (const float g : picture.channels.at("G"))
            mean += lumens_per_watt * static_cast<double>(g) / 256;
        EXPECT_NEAR(mean / (from_below ? 600 : 200), 1, 0.02) << from_below;
    }
}

/// A box of 1 mm walls and roof on a floor that goes on outside, where a lamp hangs.
Scene box_on_a_lit_floor(double wall_m)
{
    Scene scene;
    const ModifierId m = grey(scene, "m", 0.8);
    scene.root.add_polygon(level({-4, -4, 0}, {4, 4, 0}, 0), m, "floor");
    for (const double out : {0.0, wall_m}) {
        const Point a{-1 - out, -1 - out, 0}, b{1 + out, 1 + out, 1 + out};
        add_walls(scene, a, b, {m, m, m, m, m, m});
        scene.root.add_polygon(level(a, b, b.z), m, "roof");
    }
    scene.root.add_sphere({{1.6, 0, 0.8}, 0.05}, Shape::sphere, lamp_of(scene, 1e6), "bulb");
    return scene;
}

TEST(HybridLeaks, InsideAClosedBoxOfThinWallsItIsDark)
{
    const Simulation simulation(box_on_a_lit_floor(0.001));
    // Sensors inside and outside, up to 2 mm from the walls, few (hemispheres) and many (records).
    for (const int side : {20, 50}) {
        SensorGrid grid;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column)
                grid.sensors.push_back(
                    {{-2 + 4 * (column + 0.5) / side, -2 + 4 * (row + 0.5) / side, 1e-6}, {0, 0, 1}});
        for (int i = 0; i < 20; ++i) {
            grid.sensors.push_back({{0.998, -0.95 + 0.1 * i, 1e-6}, {0, 0, 1}});
            grid.sensors.push_back({{1.003, -0.95 + 0.1 * i, 1e-6}, {0, 0, 1}});
        }
        const GridResult found = simulation.illuminance(grid, asked(0.1, 8));
        double inside = 0, outside = 0;
        for (std::size_t i = 0; i < grid.sensors.size(); ++i) {
            const Point& p = grid.sensors[i].position;
            const bool is_inside = std::fabs(p.x) < 1 && std::fabs(p.y) < 1;
            double& largest = is_inside ? inside : outside;
            largest = std::max(largest, found.values[i].value);
        }
        EXPECT_EQ(inside, 0) << side;
        EXPECT_GT(outside, 100) << side;
    }
}

} // namespace
} // namespace lightwell
