#include "importers/export/faces.h"

#include "engine/base/frame.h"

#include <algorithm>
#include <tuple>

namespace lightwell {
namespace {

int chords_of_turn(double radius, double tolerance)
{
    constexpr int fewest = 8, most = 4096;
    const double ratio = std::clamp(1 - tolerance / radius, -1.0, 1.0);
    const double count = ratio < 1 ? std::ceil(pi / std::acos(ratio)) : most;
    return static_cast<int>(std::clamp(count, static_cast<double>(fewest), static_cast<double>(most)));
}

/// Chords of the part of a turn that a surface covers.
int chords_of(const Sector& sector, int of_turn)
{
    return std::max(1, static_cast<int>(std::ceil(of_turn * sector.share())));
}

Point on_circle(const Point& centre, const Frame& frame, const Sector& sector, double radius, int i, int count)
{
    const double angle = sector.is_whole() ? 2 * pi * (i % count) / count : sector.sweep_rad * i / count;
    return centre + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * radius;
}

/// Both directions of an axis have one frame, so that a side and its caps share their corners to the last bit: a lamp
/// that is closed stays closed.
struct Turn {
    Frame frame;
    bool backwards; ///< seen along the axis that was given
};
Turn turn_about(const Sector& sector, const Direction& axis)
{
    if (!sector.is_whole())
        return {sector_frame(sector, axis), false};
    const bool backwards = std::tie(axis.x, axis.y, axis.z) < std::make_tuple(0.0, 0.0, 0.0);
    const Vec3 no_minus_zero; // which frame_about() would tell from zero
    return {frame_about((backwards ? -axis : axis) + no_minus_zero), backwards};
}

std::vector<Face> cone_faces(const Cone& cone, bool inwards, int of_turn)
{
    const Turn turn = turn_about(cone.sector, normalized(cone.ends[1] - cone.ends[0]));
    const int count = chords_of(cone.sector, of_turn);
    const auto at = [&](int end, int i) {
        return on_circle(cone.ends[end], turn.frame, cone.sector, cone.radii[end], i, count);
    };
    std::vector<Face> faces;
    for (int i = 0; i < count; ++i) {
        Face face{at(0, i)};
        if (cone.radii[0] > 0)
            face.push_back(at(0, i + 1));
        face.push_back(at(1, i + 1));
        if (cone.radii[1] > 0)
            face.push_back(at(1, i));
        if (inwards != turn.backwards)
            std::reverse(face.begin(), face.end());
        faces.push_back(std::move(face));
    }
    return faces;
}

std::vector<Face> ring_faces(const Ring& ring, double tolerance)
{
    const Turn turn = turn_about(ring.sector, ring.normal);
    const int count = chords_of(ring.sector, chords_of_turn(ring.outer_radius, tolerance));
    const auto at = [&](double radius, int i) {
        return on_circle(ring.centre, turn.frame, ring.sector, radius, i, count);
    };
    std::vector<Face> faces;
    for (int i = 0; i < count; ++i) {
        Face face{at(ring.outer_radius, i), at(ring.outer_radius, i + 1)};
        if (ring.inner_radius > 0)
            face.push_back(at(ring.inner_radius, i + 1));
        face.push_back(at(ring.inner_radius, i));
        if (turn.backwards)
            std::reverse(face.begin(), face.end());
        faces.push_back(std::move(face));
    }
    return faces;
}

/// Rows of quadrilaterals between circles of latitude, triangles at the poles.
std::vector<Face> sphere_faces(const Sphere& sphere, bool inwards, double tolerance)
{
    const int count = chords_of_turn(sphere.radius, tolerance), rows = std::max(4, count / 2);
    std::vector<Face> faces;
    const auto circle = [&](int row) {
        const double angle = pi * row / rows;
        const double radius = row == 0 || row == rows ? 0 : sphere.radius * std::sin(angle);
        return std::pair{sphere.centre - Vec3{0, 0, sphere.radius * std::cos(angle)}, radius};
    };
    for (int row = 0; row < rows; ++row) {
        const auto [low, low_radius] = circle(row);
        const auto [high, high_radius] = circle(row + 1);
        const std::vector<Face> strip = cone_faces({{low, high}, {low_radius, high_radius}}, inwards, count);
        faces.insert(faces.end(), strip.begin(), strip.end());
    }
    return faces;
}

std::vector<Face> mesh_faces(const Mesh& mesh)
{
    std::vector<Face> faces;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        faces.push_back(
            {mesh.points[mesh.triangles[i]], mesh.points[mesh.triangles[i + 1]], mesh.points[mesh.triangles[i + 2]]});
    return faces;
}

} // namespace

std::vector<Face> faces_of(const Part& part, const Surface& surface, double chord_tolerance_m, bool& approximated)
{
    const auto side = [&](const Cone& cone, bool inwards) {
        return cone_faces(cone, inwards, chords_of_turn(std::fmax(cone.radii[0], cone.radii[1]), chord_tolerance_m));
    };
    const auto round = [&](std::vector<Face> faces) {
        approximated = true;
        return faces;
    };
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[surface.index];
        const auto first = part.points.begin() + polygon.first;
        return {Face(first, first + polygon.count)};
    }
    case Shape::mesh:
        return mesh_faces(*part.meshes[surface.index]);
    case Shape::sphere:
    case Shape::bubble:
        return round(sphere_faces(part.spheres[surface.index], surface.shape == Shape::bubble, chord_tolerance_m));
    case Shape::cone:
    case Shape::cylinder:
        return round(side(part.cones[surface.index], false));
    case Shape::cup:
    case Shape::tube:
        return round(side(part.cones[surface.index], true));
    case Shape::ring:
        return round(ring_faces(part.rings[surface.index], chord_tolerance_m));
    case Shape::source:
    case Shape::instance:
        break;
    }
    return {};
}

void map_faces(std::vector<Face>& faces, const Affine& map)
{
    if (map == Affine{})
        return;
    const bool mirrored = map.determinant() < 0;
    for (Face& face : faces) {
        for (Point& corner : face)
            corner = map.point(corner);
        if (mirrored)
            std::reverse(face.begin(), face.end());
    }
}

const SurfaceKey& key_of(const Imported& model, ModifierId modifier)
{
    static const SurfaceKey none{"0", {}, {}, {}, {}, {}};
    const auto index = static_cast<std::size_t>(modifier);
    return modifier == void_modifier || index >= model.keys.size() ? none : model.keys[index];
}

const Material* material_of(const Imported& model, ModifierId modifier)
{
    if (modifier == void_modifier)
        return nullptr;
    if (const Material* assigned = resolve(model.scene, modifier).material)
        return assigned;
    const std::string& name = key_of(model, modifier).material;
    const auto own = std::find_if(model.file_materials.begin(), model.file_materials.end(),
                                  [&](const auto& entry) { return entry.first == name; });
    return own == model.file_materials.end() ? nullptr : &own->second;
}

std::string material_name_of(const Imported& model, ModifierId modifier)
{
    for (ModifierId id = modifier; id != void_modifier;) {
        const Modifier& entry = model.scene.modifiers[static_cast<std::size_t>(id)];
        if (std::holds_alternative<Material>(entry.what))
            return entry.name;
        const auto* alias = std::get_if<Alias>(&entry.what);
        id = alias ? alias->target : void_modifier;
    }
    return key_of(model, modifier).material;
}

Spectrum shown_colour(const Imported& model, ModifierId modifier)
{
    Spectrum colour = key_of(model, modifier).colour.value_or(Spectrum::grey(0.5));
    if (const Material* material = material_of(model, modifier)) {
        const auto* glass = std::get_if<Glass>(material);
        colour = to_rec709(glass ? glass->transmissivity : typical_reflectance(*material));
    }
    const auto unit = [](double x) { return x > 0 ? std::fmin(x, 1) : 0.0; };
    return {unit(colour.r), unit(colour.g), unit(colour.b)};
}

} // namespace lightwell
