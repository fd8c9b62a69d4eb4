#include "engine/scene/sensor.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {
namespace {

/// More cells than this is a slip of the spacing, not a wish.
constexpr double most_cells = 4e6;

[[noreturn]] void reject_form(const std::string& text)
{
    throw InputError{"grid \"" + text + "\"", "is not one of the three forms",
                     "use layer:A-FLOR@0.75/0.5, plane:z,x0,y0,x1,y1/0.5 or file:points.txt"};
}

double positive(const std::string& grid, std::string_view word, const char* what)
{
    const auto value = parse_double(word);
    if (!value || !(*value > 0) || !std::isfinite(*value))
        throw InputError{"grid \"" + grid + "\"", fmt::format("{} is \"{}\", expected a number > 0", what, word)};
    return *value;
}

/// A horizontal piece of the layer, seen from above.
struct Patch {
    std::vector<Point> corners;
    Box box;
};

/// Steeper surfaces than this (cosine to the vertical) are no floor.
constexpr double floor_cosine = 0.9;

void add_patch(std::vector<Patch>& patches, std::vector<Point> corners)
{
    const Vec3 area = polygon_area_vector(corners.data(), corners.size());
    if (!(std::fabs(area.z) > floor_cosine * length(area)) || length(area) == 0)
        return;
    Patch patch{std::move(corners), {}};
    for (const Point& p : patch.corners)
        patch.box.extend(p);
    patches.push_back(std::move(patch));
}

std::vector<Patch> horizontal_patches(const Scene& scene, const std::string& layer)
{
    std::vector<Patch> patches;
    const std::string split_layer = layer + "/*"; // a layer whose surfaces have several materials
    visit_expanded(scene, [&](const Part& part, const Surface& surface, const Affine& to_world, ModifierId modifier) {
        if (modifier == void_modifier)
            return;
        const std::string& name = scene.modifiers[static_cast<std::size_t>(modifier)].name;
        if (!matches(layer, name) && !matches(split_layer, name))
            return;
        if (surface.shape == Shape::polygon) {
            const Polygon& polygon = part.polygons[surface.index];
            std::vector<Point> corners;
            for (std::uint32_t i = 0; i < polygon.count; ++i)
                corners.push_back(to_world.point(part.points[polygon.first + i]));
            add_patch(patches, std::move(corners));
        } else if (surface.shape == Shape::mesh) {
            const Mesh& mesh = *part.meshes[surface.index];
            for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
                add_patch(patches, {to_world.point(mesh.points[mesh.triangles[i]]),
                                    to_world.point(mesh.points[mesh.triangles[i + 1]]),
                                    to_world.point(mesh.points[mesh.triangles[i + 2]])});
        }
    });
    return patches;
}

bool covers(const Patch& patch, double x, double y)
{
    bool inside = false;
    for (std::size_t i = 0, j = patch.corners.size() - 1; i < patch.corners.size(); j = i++) {
        const Point &a = patch.corners[i], &b = patch.corners[j];
        if ((a.y > y) != (b.y > y) && x < (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

double height_at(const Patch& patch, double x, double y)
{
    const Vec3 n = polygon_area_vector(patch.corners.data(), patch.corners.size());
    const Point& p = patch.corners[0];
    return p.z - (n.x * (x - p.x) + n.y * (y - p.y)) / n.z;
}

/// Two surfaces of a layer closer than this, one above the other, are the two faces of one slab: the upper counts.
constexpr double storey_gap_m = 1.0;

std::vector<double> floor_heights(const std::vector<Patch>& patches, double x, double y)
{
    std::vector<double> heights;
    for (const Patch& patch : patches)
        if (x >= patch.box.low.x && x <= patch.box.high.x && y >= patch.box.low.y && y <= patch.box.high.y &&
            covers(patch, x, y))
            heights.push_back(height_at(patch, x, y));
    std::sort(heights.begin(), heights.end());
    std::vector<double> floors;
    for (std::size_t i = 0; i < heights.size(); ++i)
        if (i + 1 == heights.size() || heights[i + 1] - heights[i] > storey_gap_m)
            floors.push_back(heights[i]);
    return floors;
}

struct CellCount {
    int rows, columns;
};

CellCount count_cells(double width, double depth, double spacing, const std::string& name)
{
    const double columns = std::fmax(1, std::round(width / spacing)), rows = std::fmax(1, std::round(depth / spacing));
    if (!(columns * rows <= most_cells))
        throw InputError{"grid " + name,
                         fmt::format("has {:.3g} cells, expected at most {:.0f}", columns * rows, most_cells),
                         "use a wider spacing"};
    return {static_cast<int>(rows), static_cast<int>(columns)};
}

void add_row_block(SensorGrid& grid, int rows)
{
    grid.rows += rows;
    grid.cells.resize(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns), -1);
}

SensorGrid layer_grid(const GridRequest& request, const Scene& scene)
{
    const std::vector<Patch> patches = horizontal_patches(scene, request.layer);
    if (patches.empty())
        throw InputError{"grid " + request.name, fmt::format("layer \"{}\" has no horizontal surface", request.layer),
                         "list the layers with `lightwell layers`, or use plane:z,x0,y0,x1,y1"};
    Box box;
    for (const Patch& patch : patches)
        box.extend(patch.box);
    const auto [rows, columns] =
        count_cells(box.high.x - box.low.x, box.high.y - box.low.y, request.spacing_m, request.name);
    SensorGrid grid{request.name, {}, 0, columns, {}, request.spacing_m};
    // One block of rows for each storey, lowest first: a cell of another storey lies in another block.
    std::vector<double> storeys;
    const double dx = (box.high.x - box.low.x) / columns, dy = (box.high.y - box.low.y) / rows;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double x = box.low.x + (column + 0.5) * dx, y = box.low.y + (row + 0.5) * dy;
            for (const double z : floor_heights(patches, x, y)) {
                const auto storey = std::find_if(storeys.begin(), storeys.end(),
                                                 [&](double s) { return std::fabs(s - z) <= storey_gap_m; });
                const auto block = static_cast<int>(storey - storeys.begin());
                if (storey == storeys.end()) {
                    storeys.push_back(z);
                    add_row_block(grid, rows);
                }
                const auto cell = static_cast<std::size_t>(block * rows + row) * static_cast<std::size_t>(columns) +
                                  static_cast<std::size_t>(column);
                grid.cells[cell] = static_cast<int>(grid.sensors.size());
                grid.sensors.push_back({{x, y, z + request.height_m}, {0, 0, 1}});
            }
        }
    return grid;
}

SensorGrid plane_grid(const GridRequest& request, const Scene& scene)
{
    const auto [z, x0, y0, x1, y1] = request.plane;
    const Box around = bounds(scene);
    if (!around.empty() && (std::fmax(x0, x1) < around.low.x || std::fmin(x0, x1) > around.high.x ||
                            std::fmax(y0, y1) < around.low.y || std::fmin(y0, y1) > around.high.y))
        throw InputError{
            "grid " + request.name,
            fmt::format("the plane {},{}..{},{} lies off the building, which is {:.6g},{:.6g}..{:.6g},{:.6g} m", x0, y0,
                        x1, y1, around.low.x, around.low.y, around.high.x, around.high.y),
            "give coordinates in metres within the building"};
    const auto [rows, columns] = count_cells(std::fabs(x1 - x0), std::fabs(y1 - y0), request.spacing_m, request.name);
    SensorGrid grid{request.name, {}, 0, columns, {}, request.spacing_m};
    add_row_block(grid, rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            grid.cells[grid.sensors.size()] = static_cast<int>(grid.sensors.size());
            grid.sensors.push_back({{std::fmin(x0, x1) + (column + 0.5) * std::fabs(x1 - x0) / columns,
                                     std::fmin(y0, y1) + (row + 0.5) * std::fabs(y1 - y0) / rows, z},
                                    {0, 0, 1}});
        }
    return grid;
}

SensorGrid file_grid(const GridRequest& request)
{
    const MappedFile file{request.file};
    SensorGrid grid{request.name, {}, 0, 0, {}, 0};
    std::size_t line = 0;
    for (std::string_view rest = file.bytes(); !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::vector<std::string_view> words = split(rest.substr(0, end), " \t\r,");
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++line;
        if (words.empty() || words[0].starts_with('#'))
            continue;
        double number[6] = {};
        bool good = words.size() == 6;
        for (std::size_t i = 0; good && i < 6; ++i) {
            const auto value = parse_double(words[i]);
            good = value && std::isfinite(*value);
            number[i] = value.value_or(0);
        }
        const Vec3 normal{number[3], number[4], number[5]};
        if (!good || length(normal) == 0)
            throw InputError{fmt::format("{}:{}", request.file, line), "expected six finite numbers: x y z nx ny nz",
                             "the normal must not be zero"};
        grid.sensors.push_back({{number[0], number[1], number[2]}, normalized(normal)});
    }
    return grid;
}

} // namespace

GridRequest parse_grid(const std::string& text)
{
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
        reject_form(text);
    const std::string kind = text.substr(0, colon);
    std::string rest = text.substr(colon + 1);
    GridRequest request;
    request.name = text;
    if (kind == "file") {
        request.kind = GridRequest::Kind::file;
        request.file = rest;
        return request;
    }
    const std::size_t slash = rest.rfind('/');
    if (slash != std::string::npos && parse_double(std::string_view(rest).substr(slash + 1))) {
        request.spacing_m = positive(text, std::string_view(rest).substr(slash + 1), "spacing");
        rest.resize(slash);
    }
    if (kind == "layer") {
        const std::size_t at = rest.rfind('@');
        const auto height =
            at == std::string::npos ? std::optional<double>(0) : parse_double(std::string_view(rest).substr(at + 1));
        if (!height || !std::isfinite(*height))
            reject_form(text);
        request.layer = rest.substr(0, at);
        request.height_m = *height;
        return request;
    }
    const std::vector<std::string_view> words = split(rest, ",");
    if (kind != "plane" || words.size() != 5)
        reject_form(text);
    request.kind = GridRequest::Kind::plane;
    for (std::size_t i = 0; i < 5; ++i) {
        const auto value = parse_double(words[i]);
        if (!value || !std::isfinite(*value))
            reject_form(text);
        request.plane[i] = *value;
    }
    return request;
}

SensorGrid make_grid(const GridRequest& request, const Scene& scene)
{
    if (!(request.spacing_m > 0))
        throw InputError{"grid " + request.name, fmt::format("spacing is {}, expected > 0 m", request.spacing_m)};
    SensorGrid grid = request.kind == GridRequest::Kind::layer   ? layer_grid(request, scene)
                      : request.kind == GridRequest::Kind::plane ? plane_grid(request, scene)
                                                                 : file_grid(request);
    if (grid.sensors.empty())
        throw InputError{"grid " + request.name, "has no sensor", "use a finer spacing or another place"};
    return grid;
}

} // namespace lightwell
