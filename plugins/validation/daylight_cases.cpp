#include "plugins/validation/case.h"
#include "plugins/validation/cie_sky.h"
#include "plugins/validation/glass_formulas.h"
#include "plugins/validation/quadrature.h"
#include "plugins/validation/room_frame.h"

#include <algorithm>
#include <fmt/format.h>

/// \file The daylight cases of CIE 171:2006 (5.9 to 5.14): a black room with one opening under sixteen skies, with and
/// without glass, behind an overhang or opposite a wall. Values by quadrature over the free part of the opening.
namespace lightwell {
namespace {

constexpr double horizontal_lx = 10000, sun_altitude_deg = 60, ground_reflectance = 0.3;
constexpr double accepted_relative = 0.01, accepted_percent = 0.005;
constexpr double transmissivity = 0.96, glass_index = 1.52;
constexpr Point room_size{4, 4, 3};

/// What stands outside, unlimited in x: black.
struct Mask {
    enum class Kind { none, overhang, opposite } kind = Kind::none;
    double size = 0; ///< depth of the overhang, height of the wall
};
constexpr double opposite_distance = 6;

/// A rectangle in one face of the room.
struct Opening {
    std::string id;
    bool in_roof;
    double low[2], high[2]; ///< x and y in the roof, x and z in the wall y = 0
    bool glazed = false;
    Mask mask = {};

    Point at(double s, double t) const { return in_roof ? Point{s, t, room_size.z} : Point{s, 0, t}; }
    std::vector<Point> outline() const
    {
        return {at(low[0], low[1]), at(high[0], low[1]), at(high[0], high[1]), at(low[0], high[1])};
    }
    Direction across() const { return in_roof ? Direction{0, 0, 1} : Direction{0, 1, 0}; }
    Direction to_sun() const
    {
        const double h = sun_altitude_deg * radians_per_degree;
        return {0, (in_roof ? 1 : -1) * std::cos(h), std::sin(h)}; // the sun stands where the report has it
    }
};

/// Heights of a wall's opening that a place on the floor sees past the mask.
void free_heights(const Mask& mask, const Point& from, double& low, double& high)
{
    if (mask.kind == Mask::Kind::overhang)
        high = std::min(high, room_size.z * from.y / (mask.size + from.y));
    else if (mask.kind == Mask::Kind::opposite)
        low = std::max(low, mask.size * from.y / (from.y + opposite_distance));
}

/// Percentage of the horizontal illuminance that comes through an opening.
class Gathered {
public:
    Gathered(const Opening& opening, const CieSkyFormula& sky, double horizontal)
        : opening_(opening), sky_(sky), horizontal_(horizontal)
    {
    }
    double percent(const Sensor& sensor) const
    {
        double low = opening_.low[1], high = opening_.high[1];
        if (opening_.in_roof)
            return 100 * panel(sensor, opening_.low[0], low, opening_.high[0], high);
        free_heights(opening_.mask, sensor.position, low, high);
        // The horizon, where sky and ground meet, is the edge of a panel.
        const double horizon = std::clamp(sensor.position.z, low, std::max(low, high));
        double sum = 0;
        if (high > horizon)
            sum += panel(sensor, opening_.low[0], horizon, opening_.high[0], high);
        if (horizon > low)
            sum += panel(sensor, opening_.low[0], low, opening_.high[0], horizon);
        return 100 * sum;
    }

private:
    double luminance(const Direction& d) const
    {
        const bool sees_ground = d.z < 0 && opening_.mask.kind == Mask::Kind::none;
        const double open = d.z > 0 ? sky_(d) / horizontal_ : sees_ground ? ground_reflectance / pi : 0;
        if (!opening_.glazed)
            return open;
        return open * pane_transmittance(transmissivity, glass_index, std::acos(std::fabs(dot(d, opening_.across()))));
    }
    /// Halved until it is small beside its distance, and beside its angle to the sun, about which the sky has a cone.
    double panel(const Sensor& sensor, double s0, double t0, double s1, double t1) const
    {
        constexpr double near = 0.5;
        constexpr int nodes = 6;
        const Point middle = opening_.at(0.5 * (s0 + s1), 0.5 * (t0 + t1));
        const double size = std::max(s1 - s0, t1 - t0), distance = length(middle - sensor.position);
        constexpr double smallest = 1e-4, least_angle = 0.01;
        const double from_sun = length((middle - sensor.position) / distance - opening_.to_sun());
        const bool fine = size <= near * (distance - 0.5 * size) &&
                          size <= near * distance * std::max(from_sun - 0.5 * size / distance, least_angle);
        if (!fine && size > smallest) {
            const double s = 0.5 * (s0 + s1), t = 0.5 * (t0 + t1);
            if (s1 - s0 > t1 - t0)
                return panel(sensor, s0, t0, s, t1) + panel(sensor, s, t0, s1, t1);
            return panel(sensor, s0, t0, s1, t) + panel(sensor, s0, t, s1, t1);
        }
        static const std::vector<QuadratureNode> unit = gauss_legendre(nodes, 0, 1);
        double sum = 0;
        for (const QuadratureNode& u : unit)
            for (const QuadratureNode& v : unit) {
                const Vec3 to = opening_.at(s0 + u.x * (s1 - s0), t0 + v.x * (t1 - t0)) - sensor.position;
                const double square = dot(to, to);
                const Direction d = to / std::sqrt(square);
                const double receiver = dot(d, sensor.normal), aperture = std::fabs(dot(d, opening_.across()));
                if (receiver > 0)
                    sum += u.weight * v.weight * luminance(d) * receiver * aperture / square;
            }
        return sum * (s1 - s0) * (t1 - t0);
    }

    const Opening& opening_;
    const CieSkyFormula& sky_;
    double horizontal_;
};

void add_mask(Scene& scene, const Mask& mask, ModifierId black)
{
    // No place sees past its ends: the nearest is 0.25 m behind the opening, whose sides are 1 m to its left and right.
    constexpr double middle = 2, widest_slope = 4.1, nearest = 0.25;
    const double depth = mask.kind == Mask::Kind::overhang ? mask.size : opposite_distance;
    const double x0 = middle - widest_slope * (depth + nearest), x1 = middle + widest_slope * (depth + nearest);
    if (mask.kind == Mask::Kind::overhang)
        scene.root.add_polygon({{x0, 0, 3}, {x0, -depth, 3}, {x1, -depth, 3}, {x1, 0, 3}}, black, "overhang");
    else if (mask.kind == Mask::Kind::opposite)
        scene.root.add_polygon({{x0, -depth, 0}, {x1, -depth, 0}, {x1, -depth, mask.size}, {x0, -depth, mask.size}},
                               black, "opposite");
}

Scene room_scene(const Opening& opening, int type, double horizontal, const Perturbation& p)
{
    Scene scene;
    const double zenith = horizontal_lx / horizontal / lumens_per_watt;
    add_cie_sky(scene, type, opening.to_sun(), zenith * p.sky);
    if (!opening.in_roof)
        scene.root.add_source(
            {{0, 0, -1}, 180},
            scene.add_material("ground_glow", p.surroundings(ground_reflectance * horizontal_lx / pi)), "ground");
    const ModifierId black = scene.add_material("black", Plastic{});
    const std::string opened = opening.in_roof ? "ceiling" : "y0";
    for (const RoomFace& face : room_faces(room_size)) {
        if (face.name != opened)
            scene.root.add_polygon(face.corners(), black, face.name);
        else if (length(cross(face.u, face.v)) >
                 1.0001 * (opening.high[0] - opening.low[0]) * (opening.high[1] - opening.low[1]))
            scene.root.add_polygon_with_holes(face.corners(), {opening.outline()}, black, face.name);
    }
    add_mask(scene, opening.mask, black);
    // Without glass a pane of index 1 fills the opening: it changes no light and shows where the sky is to be sought.
    const Glass nothing{Spectrum::grey(1), 1};
    scene.root.add_polygon(opening.outline(),
                           scene.add_material("pane", opening.glazed ? p.pane(transmissivity, glass_index) : nothing),
                           "pane");
    return scene;
}

struct NamedSensor {
    std::string name;
    Sensor sensor;
};

/// Places of the report: A to F up or down a wall, G to N along the floor, and G' to N' along the ceiling.
std::vector<NamedSensor> sensors_of(const Opening& opening)
{
    std::vector<NamedSensor> sensors;
    const auto add = [&](char letter, const char* dash, const Point& at, const Direction& normal) {
        sensors.push_back({fmt::format("{}{}", letter, dash), {at, normal}});
    };
    if (opening.mask.kind == Mask::Kind::none)
        for (int i = 0; i < 6; ++i)
            add(static_cast<char>('A' + i), "", {2, opening.in_roof ? 0.0 : room_size.y, 2.75 - 0.5 * i},
                {0, opening.in_roof ? 1.0 : -1.0, 0});
    const auto along = [&](int i) { return opening.in_roof ? 0.25 + 0.5 * i : 3.75 - 0.5 * i; };
    for (int i = 0; i < 8; ++i)
        add(static_cast<char>('G' + i), "", {2, along(i), 0}, {0, 0, 1});
    if (!opening.in_roof && opening.mask.kind == Mask::Kind::none)
        for (int i = 0; i < 8; ++i)
            add(static_cast<char>('G' + i), "'", {2, along(i), room_size.z}, {0, 0, -1});
    return sensors;
}

/// Illuminance of the level ground under each sky, in units of the zenith luminance; the compass does not matter.
double level_illuminance(int type)
{
    static const std::vector<double> all = [] {
        const double h = sun_altitude_deg * radians_per_degree;
        std::vector<double> found;
        for (int t = 1; t <= traditional_overcast; ++t)
            found.push_back(CieSkyFormula(t, {0, std::cos(h), std::sin(h)}).on_plane({0, 0, 1}));
        return found;
    }();
    return all[static_cast<std::size_t>(type - 1)];
}

Case built(const std::string& id, const Opening& opening, int type)
{
    const CieSkyFormula sky(type, opening.to_sun());
    const double horizontal = level_illuminance(type);
    const Gathered gathered(opening, sky, horizontal);
    const bool sees_ground = opening.mask.kind == Mask::Kind::none;
    Check check{sees_ground ? "sky and ground" : "sky", 0, accepted_percent, {}, {}, false, "%"};
    check.tolerance_part = accepted_relative;
    for (const NamedSensor& one : sensors_of(opening)) {
        check.sensors.push_back({one.sensor, 100 / horizontal_lx});
        check.each.push_back(gathered.percent(one.sensor));
        check.names.push_back(one.name);
    }
    Case result{id, 0};
    result.setups.push_back({[=](const Perturbation& p) { return room_scene(opening, type, horizontal, p); }, {check}});
    return result;
}

std::vector<Opening> all_openings()
{
    std::vector<Opening> openings;
    for (const bool glazed : {false, true}) {
        const char* end = glazed ? "_glazed" : "";
        openings.push_back({fmt::format("roof_1x1{}", end), true, {1.5, 1.5}, {2.5, 2.5}, glazed});
        openings.push_back({fmt::format("roof_4x4{}", end), true, {0, 0}, {4, 4}, glazed});
        openings.push_back({fmt::format("facade_2x1{}", end), false, {1, 1}, {3, 2}, glazed});
        openings.push_back({fmt::format("facade_4x3{}", end), false, {0, 0}, {4, 3}, glazed});
    }
    for (const double depth : {0.5, 1.0, 2.0})
        openings.push_back(
            {fmt::format("mask_overhang_{}", depth), false, {1, 1}, {3, 2}, false, {Mask::Kind::overhang, depth}});
    for (const double height : {3.0, 6.0, 9.0})
        openings.push_back(
            {fmt::format("mask_opposite_{}", height), false, {1, 1}, {3, 2}, false, {Mask::Kind::opposite, height}});
    return openings;
}

} // namespace

std::vector<Case> daylight_cases()
{
    std::vector<Case> cases;
    for (const Opening& opening : all_openings())
        for (int type = 1; type <= traditional_overcast; ++type) {
            const std::string id = fmt::format("cie171_{}_sky{:02}", opening.id, type);
            Case later{id, opening.glazed ? Technique::sky | Technique::glass : static_cast<unsigned>(Technique::sky)};
            later.later = [=] { return built(id, opening, type); };
            // A quick look takes the clear and the overcast sky.
            constexpr int clear = 12, overcast = 1;
            later.only_full = type != clear && type != overcast;
            cases.push_back(later);
        }
    return cases;
}

std::vector<Case> sky_model_cases()
{
    std::vector<Case> cases;
    for (const double altitude : {60.0, 25.0})
        for (int type = 1; type <= traditional_overcast; ++type) {
            const std::string id = fmt::format("day_cie_sky{:02}_sun{:.0f}", type, altitude);
            Case later{id, static_cast<unsigned>(Technique::sky)};
            later.only_full = altitude < 60 || type % 5 != 2;
            later.later = [=] {
                const double h = altitude * radians_per_degree, zenith = 1000;
                const Direction to_sun{0, -std::cos(h), std::sin(h)};
                const CieSkyFormula sky(type, to_sun);
                Case result{id, static_cast<unsigned>(Technique::sky)};
                Setup setup;
                setup.scene = [=](const Perturbation& p) {
                    Scene scene;
                    add_cie_sky(scene, type, to_sun, p.zenith(zenith));
                    return scene;
                };
                Check check{"planes", 0, 0, {}, {}, false, "E/Lz"};
                check.tolerance_part = 0.001;
                check.quick_relative = 0.003;
                const std::pair<const char*, Direction> planes[] = {{"E_horizontal_over_Lz", {0, 0, 1}},
                                                                    {"E_vertical_over_Lz.north", {0, 1, 0}},
                                                                    {"E_vertical_over_Lz.east", {1, 0, 0}},
                                                                    {"E_vertical_over_Lz.south", {0, -1, 0}}};
                for (const auto& [name, normal] : planes) {
                    check.sensors.push_back({{{0, 0, 0}, normal}, 1 / zenith});
                    check.each.push_back(sky.on_plane(normal));
                    check.names.emplace_back(name);
                }
                setup.checks = {check};
                result.setups.push_back(setup);
                return result;
            };
            cases.push_back(later);
        }
    return cases;
}

} // namespace lightwell
