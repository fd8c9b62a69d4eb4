#include "plugins/cli/layer_table.h"

#include "engine/base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace lightwell {
namespace {

using Json = nlohmann::ordered_json;

std::string fixed(double value, const char* format)
{
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Columns that a UTF-8 text takes on a terminal, near enough: one for each code point.
std::size_t columns(const std::string& text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width)
{
    return text + std::string(width > columns(text) ? width - columns(text) : 0, ' ');
}

std::string right(const std::string& text, std::size_t width)
{
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

std::string bounds_text(const Scene& scene)
{
    const Box box = bounds(scene);
    if (box.empty())
        return "nothing of finite size";
    const Vec3 size = box.high - box.low;
    return fixed(size.x, "%.3f") + " x " + fixed(size.y, "%.3f") + " x " + fixed(size.z, "%.3f") + " m, from (" +
           fixed(box.low.x, "%.3f") + ", " + fixed(box.low.y, "%.3f") + ", " + fixed(box.low.z, "%.3f") + ")";
}

Json point_json(const Point& p)
{
    return Json::array({p.x, p.y, p.z});
}

Json skipped_json(const Ledger& ledger)
{
    Json list = Json::array();
    for (const Ledger::Skipped& entry : ledger.skipped_list())
        list.push_back({{"type", to_utf8(entry.type)},
                        {"layer", to_utf8(entry.layer)},
                        {"reason", to_utf8(entry.reason)},
                        {"count", entry.count}});
    return list;
}

} // namespace

void print_layer_table(const Imported& imported, const std::vector<LayerSummary>& layers, bool assigned,
                       std::ostream& out)
{
    std::size_t width = 5;
    for (const LayerSummary& layer : layers)
        width = std::max(width, columns(layer.name));
    out << "unit: " << imported.unit << "\nsize: " << bounds_text(imported.scene) << "\n\n";
    out << padded("layer", width) << right("surfaces", 11) << right("area m2", 13) << "  "
        << (assigned ? "material" : "proposed material") << '\n';
    for (const LayerSummary& layer : layers)
        out << padded(layer.name, width) << right(std::to_string(layer.surfaces), 11)
            << right(fixed(layer.area_m2, "%.3f"), 13) << "  " << (layer.material.empty() ? "-" : layer.material)
            << '\n';
    const Ledger& ledger = imported.ledger;
    out << "\nentities: " << ledger.read_count() << " read = " << ledger.made_count() << " made into surfaces + "
        << ledger.read_count() - ledger.made_count() << " skipped\n";
    for (const Ledger::Skipped& entry : ledger.skipped_list())
        out << "  skipped " << entry.count << " " << entry.type << " on \"" << entry.layer << "\": " << entry.reason
            << '\n';
}

void print_layer_json(const std::string& file, const Imported& imported, const std::vector<LayerSummary>& layers,
                      bool assigned, std::ostream& out)
{
    Json json;
    json["file"] = to_utf8(file);
    json["unit"] = imported.unit;
    const Box box = bounds(imported.scene);
    json["bounds_m"] = nullptr;
    if (!box.empty())
        json["bounds_m"] = {{"low", point_json(box.low)}, {"high", point_json(box.high)}};
    json["entities"] = {{"read", imported.ledger.read_count()},
                        {"made", imported.ledger.made_count()},
                        {"skipped", skipped_json(imported.ledger)}};
    json["layers"] = Json::array();
    for (const LayerSummary& layer : layers)
        json["layers"].push_back({{"name", to_utf8(layer.name)},
                                  {"surfaces", layer.surfaces},
                                  {"area_m2", layer.area_m2},
                                  {"material", layer.material.empty() ? Json(nullptr) : Json(layer.material)},
                                  {"assigned", assigned}});
    json["notes"] = Json::array();
    for (const Note& note : imported.report.notes())
        json["notes"].push_back({{"finding", to_string(note.finding)},
                                 {"place", to_utf8(note.place)},
                                 {"text", to_utf8(note.text)},
                                 {"count", note.count}});
    out << json.dump(2) << '\n';
}

} // namespace lightwell
