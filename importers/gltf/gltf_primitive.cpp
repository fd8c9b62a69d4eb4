#include "importers/gltf/gltf_primitive.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_accessor.h"
#include "importers/gltf/gltf_codecs.h"

#include <cmath>
#include <limits>

namespace lightwell {
namespace {

constexpr int mode_strip = 5, mode_fan = 6;
/// Normals this near to their triangle's own are its own, rounded to bytes or packed.
constexpr double face_normal_tolerance = 1e-2;
/// Area below this share of the squared longest edge is rounding error of single precision, not a surface.
constexpr double zero_area_tolerance = 1e-12;

/// Values by attribute and the order of the corners, from accessors or from packed data.
struct Source {
    std::vector<double> positions, normals, texture;
    std::vector<std::uint32_t> corners;
};

std::vector<double> optional_numbers(const GltfDocument& document, const GltfPrimitive& primitive, const char* name,
                                     int components, std::size_t count)
{
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end())
        return {};
    std::vector<double> numbers = read_numbers(document, found->second, components);
    if (numbers.size() != count * static_cast<std::size_t>(components))
        throw InputError(document.name + ": accessor " + std::to_string(found->second),
                         std::string(name) + " has " +
                             std::to_string(numbers.size() / static_cast<std::size_t>(components)) +
                             " elements, POSITION has " + std::to_string(count));
    return numbers;
}

Source from_accessors(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end())
        throw InputError(document.name, "primitive without POSITION");
    Source source;
    source.positions = read_numbers(document, position->second, 3);
    const std::size_t count = source.positions.size() / 3;
    source.normals = optional_numbers(document, primitive, "NORMAL", 3, count);
    source.texture = optional_numbers(document, primitive, "TEXCOORD_0", 2, count);
    if (primitive.indices >= 0) {
        source.corners = read_indices(document, primitive.indices);
        return source;
    }
    source.corners.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        source.corners[i] = static_cast<std::uint32_t>(i);
    return source;
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
    for (const auto& [name, id] : primitive.draco->attributes)
        if (name == "POSITION" || name == "NORMAL" || name == "TEXCOORD_0")
            wanted[name] = id;
    DracoMesh packed = unpack_draco(document.views[static_cast<std::size_t>(view)].bytes, wanted, place);
    for (const auto& [name, components] : packed.components)
        if (components != (name == "TEXCOORD_0" ? 2 : 3))
            throw InputError(place, name + " has " + std::to_string(components) + " components");
    if (packed.values["POSITION"].empty())
        throw InputError(place, "Draco data without POSITION");
    return {std::move(packed.values["POSITION"]), std::move(packed.values["NORMAL"]),
            std::move(packed.values["TEXCOORD_0"]), std::move(packed.triangles)};
}

/// Source  glTF 2.0 specification, 3.7.2.1: strips turn every second triangle, fans share their first corner
std::vector<std::uint32_t> unrolled(const std::vector<std::uint32_t>& corners, int mode)
{
    if (mode != mode_strip && mode != mode_fan) {
        std::vector<std::uint32_t> whole = corners;
        whole.resize(corners.size() / 3 * 3);
        return whole;
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

Vec3 vector_at(const std::vector<double>& numbers, std::size_t index)
{
    return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
}

/// The corners of triangles that have an area.
/// @throws InputError when a corner is not at a finite place
std::vector<std::uint32_t> with_area(const std::vector<double>& positions, const std::vector<std::uint32_t>& corners,
                                     const std::string& place)
{
    std::vector<std::uint32_t> kept;
    kept.reserve(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const Point a = vector_at(positions, corners[i]), b = vector_at(positions, corners[i + 1]),
                    c = vector_at(positions, corners[i + 2]);
        if (!is_finite(a) || !is_finite(b) || !is_finite(c))
            throw InputError(place, "coordinates of triangle " + std::to_string(i / 3) + " are not finite");
        const double longest = std::fmax(length(b - a), std::fmax(length(c - b), length(a - c)));
        if (length(cross(b - a, c - a)) > zero_area_tolerance * longest * longest)
            kept.insert(kept.end(), {corners[i], corners[i + 1], corners[i + 2]});
    }
    return kept;
}

/// The triangles with the points they use and no others: primitives often share one long list of vertices.
Mesh compact_mesh(const Source& source, const std::vector<std::uint32_t>& corners)
{
    constexpr std::uint32_t not_yet = std::numeric_limits<std::uint32_t>::max();
    const std::size_t count = source.positions.size() / 3;
    const bool with_normals = source.normals.size() == 3 * count, with_texture = source.texture.size() == 2 * count;
    Mesh mesh;
    std::vector<std::uint32_t> place(count, not_yet);
    mesh.triangles.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
        if (place[corner] == not_yet) {
            place[corner] = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(vector_at(source.positions, corner));
            if (with_normals) {
                const Vec3 normal = vector_at(source.normals, corner);
                mesh.normals.push_back(is_finite(normal) ? normalized(normal) : Vec3{});
            }
            for (std::size_t i = 0; with_texture && i < 2; ++i) {
                const double value = source.texture[2 * std::size_t{corner} + i];
                mesh.texture.push_back(std::isfinite(value) ? value : 0);
            }
        }
        mesh.triangles.push_back(place[corner]);
    }
    return mesh;
}

/// Normals that only repeat the planes of the triangles say nothing; missing ones take the plane of a triangle.
void settle_normals(Mesh& mesh)
{
    bool bent = false;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Point& a = mesh.points[mesh.triangles[i]];
        const Direction front =
            normalized(cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a));
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

GltfTriangles read_triangles(const GltfDocument& document, const GltfPrimitive& primitive)
{
    const Source source = primitive.draco ? from_draco(document, primitive) : from_accessors(document, primitive);
    const std::size_t count = source.positions.size() / 3;
    for (const std::uint32_t corner : source.corners)
        if (corner >= count)
            throw InputError(document.name + ": accessor " + std::to_string(primitive.indices),
                             "index " + std::to_string(corner) + " of " + std::to_string(count) + " vertices");
    GltfTriangles result;
    const std::vector<std::uint32_t> corners = unrolled(source.corners, primitive.draco ? 4 : primitive.mode);
    const std::vector<std::uint32_t> kept = with_area(source.positions, corners, document.name);
    result.without_area = (corners.size() - kept.size()) / 3;
    result.mesh = compact_mesh(source, kept);
    if (!result.mesh.normals.empty())
        settle_normals(result.mesh);
    return result;
}

} // namespace lightwell
