#include "importers/questions.h"

#include "engine/base/errors.h"
#include "importers/layer_words.h"
#include "importers/surface_amounts.h"
#include "importers/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace lightwell {
namespace {

/// Lengths between which parts of buildings lie. Something is questioned when even the longest facet and the box
/// around all of its kind are below `least_m`, or when half of the facets are above `most_m`.
struct PartSize {
    const char* idea;
    const char* name;
    double least_m, most_m;
    bool lies;    ///< most of it is level
    bool is_pane; ///< windows, glazing and glass speak of the same
};
constexpr PartSize part_sizes[] = {
    {"door", "doors", 0.7, 5, false, false},           {"window", "windows", 0.15, 30, false, true},
    {"furniture", "furniture", 0.1, 12, false, false}, {"stair", "stairs", 0.3, 30, false, false},
    {"column", "columns", 0.5, 80, false, false},      {"floor", "floors", 0.5, 500, true, false},
    {"ceiling", "ceilings", 0.5, 500, true, false},    {"slab", "slabs", 0.5, 500, true, false},
    {"ground", "the ground", 0.5, 5000, true, false},  {"wall", "walls", 0.5, 150, false, false},
    {"glazing", "glazing", 0.1, 40, false, true},      {"glass", "glass", 0.02, 40, false, true},
    {"light", "lamps", 0.005, 50, false, false},
};

/// Beyond these a model is no building, site or object that light is worked out for.
constexpr double smallest_model_m = 0.05, largest_model_m = 10'000, highest_model_m = 1000;

/// The facets of one kind of part.
struct Facets {
    std::vector<float> lengths_m; ///< longest distance from the first corner
    double longest_m = 0, area_m2 = 0, level_m2 = 0;
    Box box;
    std::string layer;
};

const PartSize* part_named(const SurfaceKey& key)
{
    for (const std::string* name : {&key.layer, &key.block, &key.group}) {
        const std::set<std::string> ideas = ideas_in(*name);
        if (ideas.contains("annotation"))
            return nullptr;
        const PartSize* found = nullptr;
        for (const PartSize& part : part_sizes) {
            if (!ideas.contains(part.idea))
                continue;
            if (found && !(found->is_pane && part.is_pane))
                return nullptr; // a wall with a door: neither's sizes
            found = found ? found : &part;
        }
        if (found)
            return found;
    }
    return nullptr;
}

void add_facet(Facets& facets, const Point* corners, std::size_t count)
{
    constexpr double level = 0.7; // cosine: slopes up to 45 degrees
    constexpr std::size_t enough_for_a_median = 100'000;
    double squared = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 way = corners[i] - corners[0];
        squared = std::fmax(squared, dot(way, way));
        facets.box.extend(corners[i]);
    }
    const Vec3 area = polygon_area_vector(corners, count);
    facets.longest_m = std::fmax(facets.longest_m, std::sqrt(squared));
    facets.area_m2 += length(area);
    facets.level_m2 += std::fabs(area.z) > level * length(area) ? length(area) : 0;
    if (facets.lengths_m.size() < enough_for_a_median)
        facets.lengths_m.push_back(static_cast<float>(std::sqrt(squared)));
}

void add_surface(Facets& facets, const Part& part, const Surface& surface, const Affine& to_world)
{
    std::vector<Point> corners;
    if (surface.shape == Shape::polygon) {
        const Polygon& polygon = part.polygons[surface.index];
        for (std::uint32_t i = 0; i < polygon.count; ++i)
            corners.push_back(to_world.point(part.points[polygon.first + i]));
        add_facet(facets, corners.data(), corners.size());
    } else if (surface.shape == Shape::mesh) {
        const Mesh& mesh = *part.meshes[surface.index];
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const Point triangle[] = {to_world.point(mesh.points[mesh.triangles[i]]),
                                      to_world.point(mesh.points[mesh.triangles[i + 1]]),
                                      to_world.point(mesh.points[mesh.triangles[i + 2]])};
            add_facet(facets, triangle, 3);
        }
    } else {
        const Box box = surface_bounds(part, surface, to_world);
        const Point diagonal[] = {box.low, box.high, box.low};
        add_facet(facets, diagonal, 3);
    }
}

std::map<const PartSize*, Facets> facets_by_part(const Imported& imported)
{
    std::vector<const PartSize*> parts;
    for (const SurfaceKey& key : imported.keys)
        parts.push_back(part_named(key));
    std::map<const PartSize*, Facets> result;
    constexpr std::size_t most_visited = 1'000'000; // a fraction of a second; a forest needs no door looked at
    if (expanded_count(imported.scene) > most_visited)
        return result;
    visit_expanded(imported.scene,
                   [&](const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier) {
                       const auto index = static_cast<std::size_t>(modifier);
                       if (modifier == void_modifier || index >= parts.size() || !parts[index])
                           return;
                       Facets& facets = result[parts[index]];
                       if (facets.layer.empty())
                           facets.layer = imported.keys[index].layer;
                       add_surface(facets, part, surface, to_world);
                   });
    return result;
}

/// "read in mm they would measure 2.1 m; if that is right, give --unit mm": the usual unit that fits best.
std::string better_unit(const Imported& imported, double measured_m, double least_m, double most_m)
{
    const std::string stated = imported.unit.substr(0, imported.unit.find(' '));
    double metres = 0;
    try {
        metres = parse_unit(stated).value;
    } catch (const InputError&) {
        return "check the unit";
    }
    const double typical_m = std::sqrt(least_m * most_m);
    std::string best;
    double best_distance = infinity, best_size = 0;
    for (const char* unit : {"m", "mm", "cm", "ft", "in", "km"}) {
        const double size = measured_m / metres * parse_unit(unit).value;
        const double distance = std::fabs(std::log(size / typical_m));
        if (size >= least_m && size <= most_m && unit != stated && distance < best_distance) {
            best = unit;
            best_distance = distance;
            best_size = size;
        }
    }
    return best.empty()
               ? "check the unit"
               : fmt::format("in {} it would be {:.3g} m: if that is right, give --unit {}", best, best_size, best);
}

class Asker {
public:
    Asker(Imported& imported, const std::string& file) : imported_(imported), file_(file) {}
    void ask_about_model();
    void ask_about_part(const PartSize& part, Facets facets);

private:
    void ask(const std::string& text) { imported_.report.add(Finding::question, file_, text); }
    Imported& imported_;
    const std::string file_;
};

void Asker::ask_about_model()
{
    Box box;
    for (const auto& [modifier, of_modifier] : surface_boxes(imported_.scene))
        box.extend(of_modifier);
    if (box.empty())
        return;
    const Vec3 size = box.high - box.low;
    const double largest = std::fmax(size.x, std::fmax(size.y, size.z));
    const std::string measures =
        fmt::format("the model measures {:.4g} x {:.4g} x {:.4g} m (unit {})", size.x, size.y, size.z, imported_.unit);
    // The sizes of rooms and buildings.
    constexpr double least_m = 2, most_m = 60;
    if (largest > largest_model_m || size.z > highest_model_m)
        ask(measures + ", larger than any building: is the unit right? " +
            better_unit(imported_, largest, least_m, most_m));
    else if (largest > 0 && largest < smallest_model_m)
        ask(measures + ", smaller than a hand: is the unit right? " + better_unit(imported_, largest, least_m, most_m));
}

void Asker::ask_about_part(const PartSize& part, Facets facets)
{
    if (facets.lengths_m.empty())
        return;
    const auto middle = facets.lengths_m.begin() + static_cast<std::ptrdiff_t>(facets.lengths_m.size() / 2);
    std::nth_element(facets.lengths_m.begin(), middle, facets.lengths_m.end());
    const double extent = std::fmax(facets.longest_m, facets.box.diagonal());
    const std::string who = fmt::format("{} (layer \"{}\")", part.name, facets.layer);
    if (extent < part.least_m)
        ask(fmt::format("{} measure {:.3g} m in all, expected at least {:.3g} m: is the unit right? ", who, extent,
                        part.least_m) +
            better_unit(imported_, extent, part.least_m, part.most_m));
    else if (*middle > part.most_m)
        ask(fmt::format("{} have pieces of {:.3g} m, expected at most {:.3g} m: is the unit right? ", who, *middle,
                        part.most_m) +
            better_unit(imported_, *middle, part.least_m, part.most_m));
    constexpr double least_level_share = 0.25;
    if (part.lies && facets.area_m2 > 0 && facets.level_m2 < least_level_share * facets.area_m2)
        ask(fmt::format("{} stand upright ({:.0f} % of the area is level): is the upward axis right? "
                        "the other choice is --up y or --up z",
                        who, 100 * facets.level_m2 / facets.area_m2));
}

} // namespace

void ask_about_sizes(Imported& imported, const std::string& file)
{
    Asker asker{imported, file};
    asker.ask_about_model();
    std::map<const PartSize*, Facets> parts = facets_by_part(imported);
    for (const PartSize& part : part_sizes)
        if (const auto found = parts.find(&part); found != parts.end())
            asker.ask_about_part(part, std::move(found->second));
}

void ask_about_lamps(Imported& imported)
{
    // Floodlights of stadiums give 2e5 lm, ceilings of light far more, but at the luminance of a panel; the disc of the
    // sun has 1.6e9 cd/m2.
    constexpr double most_lm = 1e6, panel_cd_per_m2 = 1e5, most_cd_per_m2 = 2e9, most_of_any_lm = 5e7;
    for (const auto& [id, amount] : surface_amounts(imported.scene)) {
        const ResolvedMaterial resolved = resolve(imported.scene, id);
        if (!resolved.material || !is_emitter(*resolved.material) || amount.surfaces == 0)
            continue;
        const double cd_per_m2 = lumens_per_watt * photopic(emitted_radiance(*resolved.material));
        const double lumens = pi * cd_per_m2 * amount.area_m2 / amount.surfaces;
        const bool too_much = lumens > most_of_any_lm || (lumens > most_lm && cd_per_m2 > panel_cd_per_m2);
        if (!too_much && !(cd_per_m2 > most_cd_per_m2))
            continue;
        const std::string& name = imported.scene.modifiers[static_cast<std::size_t>(id)].name;
        imported.report.add(
            Finding::question, "layer \"" + name + '"',
            fmt::format("lamps of layer \"{}\" give {:.3g} lm each at {:.3g} cd/m2, more than {}: is the "
                        "material, or the unit of the drawing, right?",
                        name, lumens, cd_per_m2,
                        too_much ? "a stadium's floodlight (2e5 lm)" : "the sun (1.6e9 cd/m2)"));
    }
}

} // namespace lightwell
