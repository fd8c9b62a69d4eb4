#include "engine/sources/source_list.h"

#include "engine/base/frame.h"
#include "engine/geometry/triangulate.h"
#include "engine/sources/placed_surfaces.h"
#include "materials/emission.h"

namespace lightwell {
namespace {

/// Wider distant sources are part of the sky: one sample a point cannot tell their brightness.
constexpr double widest_sun_deg = 12;

bool is_rectangle(const std::vector<Point>& p)
{
    if (p.size() != 4)
        return false;
    const Vec3 a = p[1] - p[0], b = p[3] - p[0];
    const double slack = 1e-9 * length(a) * length(b);
    return length(p[2] - p[1] - b) <= 1e-9 * length(b) && std::fabs(dot(a, b)) <= slack && slack > 0;
}

void add_triangle(FlatEmitter& emitter, const Point& a, const Point& b, const Point& c)
{
    const double area = 0.5 * length(cross(b - a, c - a));
    if (!(area > 0))
        return;
    emitter.corners.insert(emitter.corners.end(), {a, b, c});
    emitter.summed_area.push_back((emitter.summed_area.empty() ? 0 : emitter.summed_area.back()) + area);
}

/// A mirrored map turns a triangle's order of corners round; the front must stay where it was.
FlatEmitter flat_emitter(const std::vector<Point>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                         bool mirrored)
{
    FlatEmitter emitter;
    for (const auto& t : triangles)
        add_triangle(emitter, corners[t[0]], corners[t[mirrored ? 2 : 1]], corners[t[mirrored ? 1 : 2]]);
    return emitter;
}

/// The same outline without corners that lie in the middle of a straight edge: drawings have many, and without them a
/// lamp may be a rectangle or have few enough triangles for a closed form.
std::vector<Point> turning_corners(const std::vector<Point>& corners)
{
    constexpr double straight = 1e-12; // sine of the turn
    std::vector<Point> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 before = corners[i] - (kept.empty() ? corners.back() : kept.back());
        const Vec3 after = corners[(i + 1) % corners.size()] - corners[i];
        const double both = length(before) * length(after);
        const bool goes_on = dot(before, after) >= 0 && length(cross(before, after)) <= straight * both;
        if (!goes_on)
            kept.push_back(corners[i]);
    }
    return kept.size() < 3 ? corners : kept;
}

FlatEmitter polygon_emitter(const Part& part, const Polygon& polygon, const Affine& to_world)
{
    std::vector<Point> corners;
    for (std::uint32_t i = 0; i < polygon.count; ++i)
        corners.push_back(to_world.point(part.points[polygon.first + i]));
    corners = turning_corners(corners);
    const bool mirrored = to_world.determinant() < 0;
    if (is_rectangle(corners)) {
        FlatEmitter emitter;
        emitter.rectangle = true;
        emitter.corners = {corners[0], corners[mirrored ? 3 : 1], corners[mirrored ? 1 : 3]};
        emitter.summed_area = {length(cross(corners[1] - corners[0], corners[3] - corners[0]))};
        return emitter;
    }
    return flat_emitter(corners, triangulate(corners.data(), corners.size()), mirrored);
}

FlatEmitter mesh_emitter(const Mesh& mesh, const Affine& to_world)
{
    std::vector<Point> corners;
    for (const Point& p : mesh.points)
        corners.push_back(to_world.point(p));
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    return flat_emitter(corners, triangles, to_world.determinant() < 0);
}

} // namespace

SourceSample SunSource::sample(UnitSquare u) const noexcept
{
    const SampledDirection d = uniform_cone(disc.to_source, 0.5 * disc.full_angle_deg * radians_per_degree, u);
    return {d.direction, infinity, d.density_per_sr, radiance};
}

double SunSource::density_per_sr(const Direction& direction) const noexcept
{
    const Vec3 apart = direction - disc.to_source;
    const double half = 0.5 * disc.full_angle_deg * radians_per_degree, chord = 2 * std::sin(0.5 * half);
    return dot(apart, apart) <= chord * chord ? 1 / cone_solid_angle_sr(half) : 0;
}

/// Lamps, in the order of the scene.
struct SourceList::Finder {
    SourceList& list;

    VariedLight light_of(const PlacedSurface& placed) const
    {
        if (!list.varied_->varies(placed.modifier))
            return {};
        const bool in_instance = placed.path != 0;
        return {list.varied_.get(), placed.modifier,
                in_instance ? std::optional(inverse(placed.to_world)) : std::nullopt};
    }
    void add(const PlacedSurface& placed)
    {
        const Part& part = placed.part;
        const Surface& surface = placed.surface;
        const Affine& to_world = placed.to_world;
        const double scale = similarity_scale(to_world);
        const auto keep = [&](LocalSource::Shape shape) {
            list.lamp_by_place_[place_key(placed.path, placed.index)] = static_cast<int>(list.lamps_.size());
            list.lamps_.emplace_back(std::move(shape), placed.material, light_of(placed));
        };
        if (surface.shape == Shape::polygon || surface.shape == Shape::mesh) {
            FlatEmitter emitter = surface.shape == Shape::polygon
                                      ? polygon_emitter(part, part.polygons[surface.index], to_world)
                                      : mesh_emitter(*part.meshes[surface.index], to_world);
            if (!emitter.summed_area.empty())
                keep(std::move(emitter));
            return;
        }
        // Round shapes under a map that is no similarity are not aimed at: scattered rays find them.
        if (!(scale > 0))
            return;
        if (surface.shape == Shape::sphere) {
            const Sphere& s = part.spheres[surface.index];
            keep(SphereEmitter{{to_world.point(s.centre), s.radius * scale}});
        } else if (surface.shape == Shape::ring) {
            const Ring& r = part.rings[surface.index];
            const Direction normal = transform_normal(to_world, r.normal);
            keep(RingEmitter{{to_world.point(r.centre), normal, r.inner_radius * scale, r.outer_radius * scale,
                              image_of(r.sector, r.normal, to_world, normal)}});
        } else if (surface.shape != Shape::bubble) {
            const Cone& c = part.cones[surface.index];
            const Vec3 axis = c.ends[1] - c.ends[0];
            keep(ConeEmitter{{{to_world.point(c.ends[0]), to_world.point(c.ends[1])},
                              {c.radii[0] * scale, c.radii[1] * scale},
                              image_of(c.sector, normalized(axis), to_world, normalized(to_world.vector(axis)))},
                             surface.shape == Shape::cup || surface.shape == Shape::tube});
        }
    }
    void add_all(const Scene& scene)
    {
        visit_placed(
            scene,
            [](const Material& material) {
                return is_emitter(material) && !is_only_seen(material) && !emitted_radiance(material).is_black();
            },
            [this](const PlacedSurface& placed) {
                add(placed);
                return true;
            });
    }
};

SourceList::SourceList(const Scene& scene, const RayQueries& rays) : varied_(std::make_unique<VariedMaterials>(scene))
{
    Finder{*this}.add_all(scene);
    lamp_tree_ = std::make_unique<LampTree>(lamps_);
    std::vector<const Surface*> wide;
    for (const Surface& surface : scene.root.surfaces) {
        if (surface.shape != Shape::source)
            continue;
        const DistantSource& source = scene.root.sources[surface.index];
        const Spectrum radiance = distant_radiance(scene, *varied_, source, surface.modifier, source.to_source);
        if (source.full_angle_deg > widest_sun_deg)
            wide.push_back(&surface);
        else if (!radiance.is_black())
            suns_.push_back({source, radiance});
    }
    sky_ = SkySource(scene, *varied_, wide);
    guide_ = std::make_unique<Guide>(scene, rays, sky_);
}

int SourceList::lamp_at(const Hit& hit) const noexcept
{
    const auto found = lamp_by_place_.find(place_key(hit.path, hit.surface));
    return found == lamp_by_place_.end() ? -1 : found->second;
}

} // namespace lightwell
