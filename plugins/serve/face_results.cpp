#include "plugins/serve/face_results.h"

#include "engine/base/files.h"
#include "engine/base/text.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace lightwell::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* units =
    "areas m2; front, back: mean illuminance by area, lx; front_error, back_error: one standard error of that, lx, at "
    "most (sensors share ambient light, so their errors are added as they are); maps: lx by cell, row by row, the "
    "first "
    "row at v = 0, null where the face does not cover the cell";

/// Illuminance by area on one side.
struct Side {
    double area_m2 = 0, flux_lm = 0, error_lm = 0, least_lx = infinity, most_lx = 0;

    void add(double area, double lx, double error)
    {
        area_m2 += area;
        flux_lm += area * lx;
        error_lm += area * error;
        least_lx = std::fmin(least_lx, lx);
        most_lx = std::fmax(most_lx, lx);
    }
    void add(const Side& other)
    {
        area_m2 += other.area_m2;
        flux_lm += other.flux_lm;
        error_lm += other.error_lm;
        least_lx = std::fmin(least_lx, other.least_lx);
        most_lx = std::fmax(most_lx, other.most_lx);
    }
    void put(Json& json, const std::string& name) const
    {
        const double area = area_m2 > 0 ? area_m2 : 1;
        json[name] = flux_lm / area;
        json[name + "_error"] = error_lm / area;
        json[name + "_min"] = area_m2 > 0 ? least_lx : 0;
        json[name + "_max"] = most_lx;
    }
};

/// Front and back of a face, or of what many faces are part of.
struct Sides {
    Side front, back;
    void add(const Sides& other)
    {
        front.add(other.front);
        back.add(other.back);
    }
    Json json() const
    {
        Json json = {{"area_m2", front.area_m2}};
        front.put(json, "front");
        back.put(json, "back");
        return json;
    }
};

Json vector_of(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

class ResultWriter {
public:
    ResultWriter(const FaceResults& faces, const GridResult& result) : faces_(faces), result_(result)
    {
        for (const ChartedFace& face : faces.faces)
            a_side_ += face.chart.sensors.size();
    }

    Json json()
    {
        Json json = {{"program", faces_.program},
                     {"units", units},
                     {"spacing_m", faces_.spacing_m},
                     {"samples", result_.samples},
                     {"error", result_.median_relative_error}};
        std::vector<std::string> order;
        std::map<std::string, std::pair<Sides, Json>> objects;
        std::map<std::string, Sides> layers;
        std::size_t first = 0;
        for (const ChartedFace& face : faces_.faces) {
            const auto [entry, fresh] = objects.try_emplace(face.object, Sides{}, Json::array());
            if (fresh)
                order.push_back(face.object);
            const Sides sides = sides_of(face, first);
            entry->second.first.add(sides);
            entry->second.second.push_back(json_of(face, sides, first));
            layers[face.chart.layer].add(sides);
            first += face.chart.sensors.size();
        }
        json["parts"] = Json::array();
        for (const std::string& name : order) {
            auto& [sides, list] = objects.at(name);
            Json part = {{"object", to_utf8(name)}};
            part.update(sides.json());
            part["faces"] = std::move(list);
            json["parts"].push_back(std::move(part));
        }
        for (const auto& [name, sides] : layers)
            json["layers"][to_utf8(name)] = sides.json();
        return json;
    }

private:
    double lx(std::size_t sensor) const { return result_.values[sensor].value; }

    Sides sides_of(const ChartedFace& face, std::size_t first) const
    {
        Sides sides;
        for (std::size_t i = 0; i < face.chart.sensors.size(); ++i) {
            const double area = face.chart.areas_m2[i];
            const std::size_t front = first + i, back = a_side_ + first + i;
            sides.front.add(area, lx(front), result_.standard_errors[front].value);
            sides.back.add(area, lx(back), result_.standard_errors[back].value);
        }
        return sides;
    }

    Json cells(const SurfaceChart& chart, std::size_t first) const
    {
        Json values = Json::array();
        for (const int cell : chart.cells)
            values.push_back(cell < 0 ? Json() : Json(static_cast<float>(lx(first + static_cast<std::size_t>(cell)))));
        return values;
    }

    Json json_of(const ChartedFace& face, const Sides& sides, std::size_t first) const
    {
        static constexpr const char* kinds[] = {"plane", "round", "triangles"};
        const SurfaceChart& chart = face.chart;
        Json json = {{"id", to_utf8(chart.id)}, {"layer", to_utf8(chart.layer)}};
        if (face.number >= 0)
            json["face"] = face.number;
        json.update(sides.json());
        Json map = {
            {"kind", kinds[static_cast<std::size_t>(chart.kind)]}, {"columns", chart.columns}, {"rows", chart.rows}};
        if (chart.kind == SurfaceChart::Kind::plane) {
            map["corner"] = vector_of(chart.corner);
            map["across"] = vector_of(chart.across);
            map["up"] = vector_of(chart.up);
        }
        map["front"] = cells(chart, first);
        map["back"] = cells(chart, a_side_ + first);
        json["map"] = std::move(map);
        return json;
    }

    const FaceResults& faces_;
    const GridResult& result_;
    std::size_t a_side_ = 0;
};

} // namespace

SensorGrid FaceResults::sensors() const
{
    SensorGrid grid;
    grid.name = "surfaces";
    grid.spacing_m = spacing_m;
    for (const bool back : {false, true})
        for (const ChartedFace& face : faces)
            for (const Sensor& sensor : face.chart.sensors)
                grid.sensors.push_back({sensor.position, back ? -sensor.normal : sensor.normal});
    return grid;
}

void FaceResults::write(const std::filesystem::path& file, const GridResult& result) const
{
    write_text_atomically(file, ResultWriter(*this, result).json().dump() + "\n");
}

} // namespace lightwell::serve
