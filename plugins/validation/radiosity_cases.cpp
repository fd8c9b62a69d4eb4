#include "plugins/validation/box_radiosity.h"
#include "plugins/validation/case.h"

/// \file Empty rooms with all their interreflection, against a radiosity calculation that shares nothing with the
/// engine.
namespace lightwell {
namespace {

constexpr double accepted = 0.01;

struct Place {
    std::string name;
    Sensor sensor;
};

/// The room for the engine, of one channel's reflectances.
Scene scene_of(const RadiosityRoom& room, const Perturbation& p)
{
    Scene scene;
    const std::vector<RoomFace> faces = room_faces(room.size);
    double lowest = 1;
    for (std::size_t i = 0; i < faces.size(); ++i)
        lowest = std::min(lowest, room.reflectance[i]);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const ModifierId wall = scene.add_material(faces[i].name, p.diffuse(room.reflectance[i], lowest));
        if (i == 1 && room.panel) {
            const auto& l = *room.panel;
            const double z = room.size.z;
            const std::vector<Point> panel{{l.x0, l.y0, z}, {l.x0, l.y1, z}, {l.x1, l.y1, z}, {l.x1, l.y0, z}};
            scene.root.add_polygon_with_holes(faces[i].corners(), {panel}, wall, faces[i].name);
            scene.root.add_polygon(panel, scene.add_material("light", p.lamp(l.exitance / pi)), "light");
        } else {
            scene.root.add_polygon(faces[i].corners(), wall, faces[i].name);
        }
    }
    if (room.partition) {
        // Two sheets a tenth of a millimetre apart, since each side has a reflectance of its own.
        constexpr double apart = 1e-4;
        const auto& sheet = *room.partition;
        const double x = room.size.x, h = sheet.height, y0 = sheet.y - 0.5 * apart, y1 = sheet.y + 0.5 * apart;
        scene.root.add_polygon({{0, y0, 0}, {x, y0, 0}, {x, y0, h}, {0, y0, h}},
                               scene.add_material("part_y0side", p.diffuse(sheet.reflectance_y0, lowest)), "part_y0");
        scene.root.add_polygon({{0, y1, 0}, {x, y1, 0}, {x, y1, h}, {0, y1, h}},
                               scene.add_material("part_y1side", p.diffuse(sheet.reflectance_y1, lowest)), "part_y1");
    }
    if (room.lamp) {
        constexpr double radius = 0.002;
        scene.root.add_sphere({room.lamp->position, radius}, Shape::sphere,
                              scene.add_material("lamp", p.lamp(room.lamp->flux_lm / (4 * pi * pi * radius * radius))),
                              "lamp");
    }
    return scene;
}

/// @param channel  added to the names; its values are irradiances for radiances in place of luminances
void add_room(Case& result, const RadiosityRoom& room, const std::vector<Place>& places, const std::string& channel,
              const std::vector<std::string>& means)
{
    const ExtrapolatedRadiosity solved(room);
    Check check{"places" + channel, 0, 0, {}, {}, false, channel.empty() ? "lx" : "cd/m2 times sr"};
    check.tolerance_part = accepted;
    check.method = Method::usual;
    for (const Place& place : places) {
        check.sensors.push_back({place.sensor, 1});
        check.each.push_back(solved.at(place.sensor.position, place.sensor.normal));
        check.names.push_back(place.name + channel);
        result.references.emplace_back(check.names.back(), check.each.back());
        // The sheets of a partition lie beside the place that stands for both sides.
        constexpr double off_sheet = 1e-4;
        if (room.partition && place.sensor.position.y == room.partition->y)
            check.sensors.back().sensor.position += place.sensor.normal * off_sheet;
    }
    for (const std::string& face : means)
        result.references.emplace_back("mean_" + face + channel, solved.mean(face));
    result.setups.push_back({[=](const Perturbation& p) { return scene_of(room, p); }, {check}});
}

constexpr unsigned both = Technique::direct | Technique::interreflection;
const std::vector<std::string> box_names{"floor", "ceiling", "x0", "x1", "y0", "y1"};

Case cube_case(double reflectance)
{
    const std::string id = numbered("rad_enclosure_rho", reflectance);
    Case later{id, both};
    later.only_full = reflectance < 0.7 || reflectance > 0.9;
    later.later = [=] {
        RadiosityRoom room{{4, 4, 4}, {}, {}, {}, RadiosityRoom::Lamp{{2, 2, 2}, 10000}};
        room.reflectance.fill(reflectance);
        Case result{id, both};
        constexpr Direction up{0, 0, 1};
        add_room(result, room,
                 {{"centre", {{2, 2, 0}, up}},
                  {"quarter", {{1, 1, 0}, up}},
                  {"edge0.1", {{2, 0.1, 0}, up}},
                  {"corner0.1", {{0.1, 0.1, 0}, up}}},
                 "", box_names);
        result.references.emplace_back("mean_all_exact", 10000 / (96 * (1 - reflectance)));
        return result;
    };
    return later;
}

Case room_case()
{
    Case later{"rad_room", both};
    later.later = [] {
        const RadiosityRoom room{
            {6, 4, 3}, {0.2, 0.8, 0.5, 0.5, 0.5, 0.5}, RadiosityRoom::Panel{2.4, 3.6, 1.7, 2.3, 5000 * pi}};
        Case result{"rad_room", both};
        constexpr Direction up{0, 0, 1}, down{0, 0, -1};
        add_room(result, room,
                 {{"floor_c", {{3, 2, 0}, up}},
                  {"floor_q", {{1, 1, 0}, up}},
                  {"floor_corner", {{0.2, 0.2, 0}, up}},
                  {"ceil_q", {{1, 1, 3}, down}},
                  {"ceil_near", {{3, 2.6, 3}, down}},
                  {"wall_x0", {{0, 2, 1.2}, {1, 0, 0}}},
                  {"wall_y0_hi", {{3, 0, 2.7}, {0, 1, 0}}},
                  {"desk", {{3, 2, 0.8}, up}},
                  {"desk2", {{5, 3, 0.8}, up}}},
                 "", box_names);
        return result;
    };
    return later;
}

Case cornell_case()
{
    Case later{"rad_cornell_empty", both};
    later.only_full = true;
    later.later = [] {
        Case result{"rad_cornell_empty", both};
        const std::vector<Place> places{
            {"floor_c", {{0.5, 0.5, 0}, {0, 0, 1}}},     {"floor_red", {{0.1, 0.5, 0}, {0, 0, 1}}},
            {"floor_green", {{0.9, 0.5, 0}, {0, 0, 1}}}, {"back", {{0.5, 1, 0.5}, {0, -1, 0}}},
            {"ceil", {{0.2, 0.2, 1}, {0, 0, -1}}},       {"red", {{0, 0.5, 0.5}, {1, 0, 0}}}};
        const std::pair<const char*, std::array<double, 2>> channels[] = {
            {":R", {0.63, 0.14}}, {":G", {0.065, 0.45}}, {":B", {0.05, 0.09}}};
        for (const auto& [name, side] : channels)
            add_room(result,
                     {{1, 1, 1},
                      {0.75, 0.75, side[0], side[1], 0.75, 0.75},
                      RadiosityRoom::Panel{0.4, 0.6, 0.4, 0.6, 15 * pi}},
                     places, name, box_names);
        return result;
    };
    return later;
}

Case partition_case()
{
    Case later{"rad_partition", both};
    later.only_full = true;
    later.later = [] {
        const RadiosityRoom room{{4, 6, 3},
                                 {0.3, 0.7, 0.5, 0.5, 0.5, 0.5},
                                 RadiosityRoom::Panel{1.5, 2.5, 1, 2, 4000 * pi},
                                 RadiosityRoom::Partition{3.5, 1.8, 0.6, 0.4}};
        Case result{"rad_partition", both};
        constexpr Direction up{0, 0, 1};
        std::vector<std::string> faces = box_names;
        faces.insert(faces.end(), {"part_y0side", "part_y1side"});
        add_room(result, room,
                 {{"floor_lit", {{2, 1.5, 0}, up}},
                  {"floor_shade", {{2, 4.2, 0}, up}},
                  {"floor_deep", {{1, 5.5, 0}, up}},
                  {"far_wall", {{2, 6, 1}, {0, -1, 0}}},
                  {"part_back", {{2, 3.5, 0.9}, {0, 1, 0}}},
                  {"part_front", {{2, 3.5, 0.9}, {0, -1, 0}}},
                  {"ceil_far", {{2, 5, 3}, {0, 0, -1}}}},
                 "", faces);
        return result;
    };
    return later;
}

} // namespace

std::vector<Case> radiosity_cases()
{
    return {cube_case(0.2), cube_case(0.5), cube_case(0.8),  cube_case(0.95),
            room_case(),    cornell_case(), partition_case()};
}

} // namespace lightwell
