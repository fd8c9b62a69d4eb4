#include "importers/gltf/gltf_primitive.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_accessor.h"
#include "importers/gltf/gltf_codecs.h"
#include "importers/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace lightwell {
namespace {

constexpr int mode_strip = 5, mode_fan = 6;
/// Normals this near to their triangle's own are its own, rounded to bytes or packed.
constexpr double face_normal_tolerance = 1e-2;
/// Area below this share of the squared longest edge is rounding error of single precision, not a surface.
constexpr double zero_area_tolerance = 1e-12;

/// Values by attribute and the order of the corners, from accessors or from packed data.
struct Source {
    std::vector<Point> points;
    std::vector<Vec3> normals;   ///< empty, or one for each point
    std::vector<double> texture; ///< empty, or two for each point
    std::vector<std::uint32_t> corners;
};

/// @throws InputError unless there is one value for each point
void check_count(const GltfDocument& document, const char* name, int accessor, std::size_t values, std::size_t points)
{
    if (values != points)
        throw InputError(document.name + ": accessor " + std::to_string(accessor),
                         std::string(name) + " has " + std::to_string(values) + " elements, POSITION has " +
                             std::to_string(points));
}

/// Of the corners' coordinates that lay the pictures of the material; the first where no picture is laid.
std::string name_of_coordinates(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const auto material = static_cast<std::size_t>(primitive.material);
    const bool known = primitive.material >= 0 && material < document.materials.size();
    return "TEXCOORD_" + std::to_string(known ? std::max(0, coordinates_of(document.materials[material])) : 0);
}

/// Coordinates that lay no picture only keep the triangles of a wall apart.
bool needs_coordinates(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const auto material = static_cast<std::size_t>(primitive.material);
    return primitive.material >= 0 && material < document.materials.size() &&
           coordinates_of(document.materials[material]) >= 0;
}

Source from_accessors(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const auto accessor_of = [&](const char* name) {
        const auto found = primitive.attributes.find(name);
        return found == primitive.attributes.end() ? -1 : found->second;
    };
    if (primitive.attributes.count("POSITION") == 0)
        throw InputError(document.name, "primitive without POSITION");
    Source source;
    source.points = read_vectors(document, accessor_of("POSITION"));
    const std::size_t count = source.points.size();
    if (primitive.attributes.count("NORMAL") > 0) {
        source.normals = read_vectors(document, accessor_of("NORMAL"));
        check_count(document, "NORMAL", accessor_of("NORMAL"), source.normals.size(), count);
    }
    const std::string coordinates = name_of_coordinates(document, primitive);
    if (primitive.attributes.count(coordinates) > 0) {
        source.texture = read_numbers(document, accessor_of(coordinates.c_str()), 2);
        check_count(document, coordinates.c_str(), accessor_of(coordinates.c_str()), source.texture.size() / 2, count);
    }
    if (primitive.indices >= 0) {
        source.corners = read_indices(document, primitive.indices);
        return source;
    }
    source.corners.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        source.corners[i] = static_cast<std::uint32_t>(i);
    return source;
}

std::vector<Vec3> as_vectors(const std::vector<double>& numbers)
{
    std::vector<Vec3> vectors(numbers.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return vectors;
}

Source from_draco(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const int view = primitive.draco->view;
    const std::string place = document.name + ": buffer view " + std::to_string(view);
    if (view < 0 || static_cast<std::size_t>(view) >= document.views.size())
        throw InputError(place, "is not there");
    if (!document.views[static_cast<std::size_t>(view)].fault.empty())
        throw InputError(place, document.views[static_cast<std::size_t>(view)].fault);
    std::map<std::string, int> wanted;
    const std::string coordinates = name_of_coordinates(document, primitive);
    for (const auto& [name, id] : primitive.draco->attributes)
        if (name == "POSITION" || name == "NORMAL" || name == coordinates)
            wanted[name] = id;
    DracoMesh packed = unpack_draco(document.views[static_cast<std::size_t>(view)].bytes, wanted, place);
    for (const auto& [name, components] : packed.components)
        if (components != (name == coordinates ? 2 : 3))
            throw InputError(place, name + " has " + std::to_string(components) + " components");
    if (packed.values["POSITION"].empty())
        throw InputError(place, "Draco data without POSITION");
    return {as_vectors(packed.values["POSITION"]), as_vectors(packed.values["NORMAL"]),
            std::move(packed.values[coordinates]), std::move(packed.triangles)};
}

/// Source  glTF 2.0 specification, 3.7.2.1: strips turn every second triangle, fans share their first corner
std::vector<std::uint32_t> unrolled(std::vector<std::uint32_t> corners, int mode)
{
    if (mode != mode_strip && mode != mode_fan) {
        corners.resize(corners.size() / 3 * 3);
        return corners;
    }
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        if (mode == mode_strip)
            triangles.insert(triangles.end(), {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
        else
            triangles.insert(triangles.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return triangles;
}

/// Drops the triangles that have no area.
/// @throws InputError when a corner is not at a finite place
void keep_with_area(const std::vector<Point>& points, std::vector<std::uint32_t>& corners, const std::string& place)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const Point &a = points[corners[i]], &b = points[corners[i + 1]], &c = points[corners[i + 2]];
        const Vec3 ab = b - a, bc = c - b, ca = a - c, twice_area = cross(ab, ca);
        const double squared = std::fmax(dot(ab, ab), std::fmax(dot(bc, bc), dot(ca, ca)));
        if (!(squared < infinity)) // NaN as well
            throw InputError(place, "coordinates of triangle " + std::to_string(i / 3) + " are not finite");
        if (!(dot(twice_area, twice_area) > zero_area_tolerance * squared * (zero_area_tolerance * squared)))
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            corners[kept + k] = corners[i + k];
        kept += 3;
    }
    corners.resize(kept);
}

/// Drops the points that no corner uses: primitives often share one long list of them.
void keep_used(Source& source)
{
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    const std::size_t count = source.points.size();
    std::vector<std::uint32_t> place(count, unused);
    for (const std::uint32_t corner : source.corners)
        place[corner] = 0;
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (place[i] == unused)
            continue;
        place[i] = kept;
        if (kept == i) {
            ++kept;
            continue;
        }
        source.points[kept] = source.points[i];
        if (!source.normals.empty())
            source.normals[kept] = source.normals[i];
        for (std::size_t k = 0; k < 2 && !source.texture.empty(); ++k)
            source.texture[2 * std::size_t{kept} + k] = source.texture[2 * i + k];
        ++kept;
    }
    if (kept == count)
        return;
    source.points.resize(kept);
    source.normals.resize(source.normals.empty() ? 0 : kept);
    source.texture.resize(source.texture.empty() ? 0 : 2 * std::size_t{kept});
    for (std::uint32_t& corner : source.corners)
        corner = place[corner];
}

/// Texture coordinates with v upwards, as everywhere inside; the format has it downwards.
void turn_texture(std::vector<double>& texture)
{
    for (std::size_t i = 0; i + 1 < texture.size(); i += 2) {
        texture[i] = std::isfinite(texture[i]) ? texture[i] : 0;
        texture[i + 1] = std::isfinite(texture[i + 1]) ? 1 - texture[i + 1] : 0;
    }
}

Direction front_of(const Mesh& mesh, std::size_t i)
{
    const Point& a = mesh.points[mesh.triangles[i]];
    return normalized(cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a));
}

/// Normals that only repeat the planes of the triangles say nothing; missing ones take the plane of a triangle.
void settle_normals(Mesh& mesh)
{
    bool missing = false, bent = false;
    for (Direction& normal : mesh.normals) {
        normal = is_finite(normal) ? normalized(normal) : Vec3{};
        missing = missing || normal == Vec3{};
    }
    for (std::size_t i = 0; i < mesh.triangles.size() && (missing || !bent); i += 3) {
        const Direction front = front_of(mesh, i);
        for (std::size_t k = 0; k < 3; ++k) {
            Direction& normal = mesh.normals[mesh.triangles[i + k]];
            if (normal == Vec3{})
                normal = front;
            bent = bent || max_abs(normal - front) > face_normal_tolerance;
        }
    }
    if (!bent)
        mesh.normals.clear();
}

} // namespace

GltfTriangles read_triangles(const GltfDocument& document, const GltfPrimitive& primitive, const GltfPose& pose)
{
    Source source = primitive.draco ? from_draco(document, primitive) : from_accessors(document, primitive);
    const std::size_t count = source.points.size();
    if (source.normals.size() != count)
        source.normals.clear();
    if (source.texture.size() != 2 * count || !needs_coordinates(document, primitive))
        source.texture.clear();
    for (const std::uint32_t corner : source.corners)
        if (corner >= count)
            throw InputError(document.name + ": accessor " + std::to_string(primitive.indices),
                             "index " + std::to_string(corner) + " of " + std::to_string(count) + " vertices");
    if (pose.bends())
        take_pose(document, primitive, pose, source.points, source.normals);
    source.corners = unrolled(std::move(source.corners), primitive.draco ? 4 : primitive.mode);
    GltfTriangles result;
    const std::size_t before = source.corners.size();
    keep_with_area(source.points, source.corners, document.name);
    result.without_area = (before - source.corners.size()) / 3;
    keep_used(source);
    turn_texture(source.texture);
    result.mesh = {std::move(source.points), std::move(source.corners), std::move(source.normals),
                   std::move(source.texture)};
    if (!result.mesh.normals.empty())
        settle_normals(result.mesh);
    return result;
}

std::optional<Spectrum> mean_vertex_colour(const GltfDocument& document, const GltfPrimitive& primitive)
{
    constexpr int triangle_mode = 4;
    if (primitive.mode >= 0 && primitive.mode < triangle_mode)
        return {};
    Source source = from_accessors(document, primitive);
    const int accessor = primitive.attributes.at("COLOR_0");
    const std::vector<double> colours = read_numbers(document, accessor, 0);
    const std::size_t count = source.points.size(), width = count > 0 ? colours.size() / count : 0;
    if (count > 0 && width != 3 && width != 4)
        check_count(document, "COLOR_0", accessor, colours.size() / 3, count);
    const auto colour_of = [&](std::uint32_t corner) {
        const double* rgb = &colours[width * corner];
        return Spectrum{rgb[0], rgb[1], rgb[2]};
    };
    source.corners = unrolled(std::move(source.corners), primitive.mode);
    Spectrum sum;
    double whole = 0;
    for (std::size_t i = 0; i + 2 < source.corners.size(); i += 3) {
        const std::uint32_t *c = &source.corners[i], last = std::max({c[0], c[1], c[2]});
        if (last >= count)
            return {}; // refused where the triangles are made
        const Point& a = source.points[c[0]];
        const double area = length(cross(source.points[c[1]] - a, source.points[c[2]] - a)) / 2;
        if (!std::isfinite(area))
            return {};
        whole += area;
        sum += (colour_of(c[0]) + colour_of(c[1]) + colour_of(c[2])) * (area / 3);
    }
    const Spectrum mean = sum / whole;
    if (!(whole > 0) || !std::isfinite(mean.r) || !std::isfinite(mean.g) || !std::isfinite(mean.b))
        return {};
    return mean;
}

bool is_closed(const Mesh& mesh)
{
    // Corners of one place are one corner, however many normals or texture coordinates they have there.
    std::vector<std::uint32_t> order(mesh.points.size()), place(mesh.points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto key = [&](std::uint32_t i) { return std::tie(mesh.points[i].x, mesh.points[i].y, mesh.points[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> there, back;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = place[mesh.triangles[i + k]], b = place[mesh.triangles[i + (k + 1) % 3]];
            there.emplace_back(a, b);
            back.emplace_back(b, a);
        }
    std::sort(there.begin(), there.end());
    std::sort(back.begin(), back.end());
    return !there.empty() && there == back;
}

} // namespace lightwell
