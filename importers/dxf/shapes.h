#pragma once

#include "engine/base/transform.h"
#include "engine/scene/surface.h"
#include "importers/dxf/drawing.h"

#include <span>
#include <vector>

namespace lightwell::dxf {

/// What the entity itself does not say about its surfaces. Lengths in drawing units.
struct ShapeOptions {
    double chord_tolerance = 0; ///< > 0: largest distance between a curve and the flat facets that stand for it
    double raised_by = 0;       ///< thickness of level outlines that have none, upwards; 0: they stay lines
};

/// How far the surfaces of an entity are from what was drawn, in drawing units.
struct Deviations {
    std::size_t chords = 0; ///< flat facets that stand for curves
    double chord_error = 0; ///< largest distance between arc and facets
    std::size_t split_faces = 0;
    double out_of_plane = 0;         ///< largest distance of a corner from the mean plane of its face
    std::size_t limit_triangles = 0; ///< of subdivision meshes
    double limit_error = 0;          ///< largest distance between them and the smooth surface
    std::size_t patterns = 0;        ///< areas filled with a pattern of lines, taken as if they were painted
};

/// A facet takes some 200 bytes: 200 MB. Only a damaged radius or a tolerance without sense needs more; the curves of
/// an entity stop when they have more, and the drawing is refused.
inline constexpr std::size_t most_facets = 1'000'000;
/// So many more may a drawing have for each of its entities: that a file grows by some hundred bytes for each says that
/// the curves are meant.
inline constexpr std::size_t further_facets_for_each_entity = 64;

/// The surfaces of one entity, in the frame of the model or block it is drawn in and in drawing units. Reused from
/// entity to entity.
class Shapes {
public:
    void clear();
    bool empty() const { return sizes_.empty() && cones.empty() && rings.empty() && meshes.empty(); }

    /// Any number of corners in one plane; equal neighbours are merged, and nothing is added when no area is left.
    void add_polygon(std::span<const Point> corners);
    void add_polygon(std::initializer_list<Point> corners) { add_polygon(std::span{corners.begin(), corners.size()}); }
    /// Any number of corners; a face that is not flat is cut into triangles.
    void add_face(const std::vector<Point>& corners);
    /// A wall over each segment of a line. Nothing is added where a segment is parallel to the height.
    void add_walls(const std::vector<Point>& line, bool closed, const Vec3& height);
    /// Four corners that may be out of plane (then two triangles along the shorter diagonal) or cross (then the two
    /// triangles that meet at the crossing).
    void add_quad(const Point& a, const Point& b, const Point& c, const Point& d);
    /// The side of a cylinder with its axis from one end to the other, or part of it.
    void add_cylinder(const Point& from, const Point& to, double radius, Shape cylinder_or_tube,
                      const Sector& sector = {});
    /// The flat ends of a cylinder or tube, facing away from each other.
    void add_caps(const Point& centre, const Vec3& height, double inner_radius, double outer_radius);

    std::size_t polygon_count() const { return sizes_.size(); }
    /// Calls use(corners) for each polygon.
    template <class Use>
    void for_each_polygon(Use use) const
    {
        std::size_t at = 0;
        for (const std::uint32_t size : sizes_) {
            use(std::span<const Point>{points_.data() + at, size});
            at += size;
        }
    }

    std::vector<std::pair<Cone, Shape>> cones;
    std::vector<Ring> rings;
    std::vector<Mesh> meshes;
    Deviations deviations;

private:
    void cut_into_triangles(const std::vector<Point>& corners, double distance);

    std::vector<Point> points_;
    std::vector<std::uint32_t> sizes_;
};

/// Why an entity has no surfaces.
struct SkipReason {
    const char* text;
    bool loses_surfaces = false; ///< it would have some if it were modelled: a note says so
};
/// nullptr: the entity has surfaces.
using Reason = const SkipReason*;
inline constexpr SkipReason no_area{"it has no area"};
inline constexpr SkipReason thin{"no thickness and no width: a line has no area"};
inline constexpr SkipReason thin_curve{"a curve without thickness has no area"};

/// Why entities of a type that is not understood are left out.
Reason reason_of_type(const std::string& type);

/// The numbers of one entity by group code.
class Fields {
public:
    explicit Fields(Values values) : values_(values) {}
    /// The first value of that code.
    double get(int code, double otherwise = 0) const;
    int flags(int code) const { return static_cast<int>(get(code)); }
    /// Groups code, code + 10, code + 20.
    Vec3 point(int code, const Vec3& otherwise = {}) const;
    bool has(int code) const;
    Vec3 extrusion() const { return point(210, {0, 0, 1}); }

private:
    Values values_;
};

/// The points whose x has this group code, in the order of the file.
std::vector<Point> points_with(int code, Values values);
std::vector<double> numbers_with(int code, Values values);

/// The thickness of an entity, along the z axis of its object coordinates.
double thickness_of(const Fields& fields, const ShapeOptions& options);

/// Adds the surfaces of an entity that is neither an INSERT nor a LIGHT.
/// @return the reason when there are none
/// @throws InputError: an index or a count out of range
Reason add_shapes(const Drawing& drawing, const Entity& entity, const ShapeOptions& options, Shapes& shapes);

// One function for each family of entities, called by add_shapes().
Reason add_line(const Fields& fields, const ShapeOptions& options, Shapes& shapes);
Reason add_circle(const Fields& fields, const ShapeOptions& options, Shapes& shapes);
Reason add_arc(const Fields& fields, const ShapeOptions& options, Shapes& shapes);
Reason add_ellipse(const Fields& fields, const ShapeOptions& options, Shapes& shapes);
Reason add_spline(Values values, const ShapeOptions& options, Shapes& shapes);
Reason add_multiline(Values values, const ShapeOptions& options, Shapes& shapes);
Reason add_face(const Fields& fields, Shapes& shapes);
Reason add_solid(const Fields& fields, const ShapeOptions& options, Shapes& shapes);
Reason add_hatch(Values values, const ShapeOptions& options, Shapes& shapes);
Reason add_mesh(const Drawing& drawing, const Entity& entity, const ShapeOptions& options, Shapes& shapes);
Reason add_polyface(const Drawing& drawing, const Entity& entity, Shapes& shapes);
Reason add_polygon_mesh(const Drawing& drawing, const Entity& entity, Shapes& shapes);
Reason add_lwpolyline(Values values, const ShapeOptions& options, Shapes& shapes);
/// A POLYLINE in one plane.
Reason add_flat_polyline(Values values, const ShapeOptions& options, Shapes& shapes);
/// A POLYLINE in space.
Reason add_space_polyline(Values values, const ShapeOptions& options, Shapes& shapes);

/// The values of a POLYLINE before its vertices, and those of each vertex.
struct VertexList {
    explicit VertexList(Values values);
    Fields header;
    std::vector<Values> vertices; ///< without the leading vertex_begins
    std::vector<std::uint64_t> places;
};

} // namespace lightwell::dxf
