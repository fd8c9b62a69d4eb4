#pragma once

#include "engine/base/box.h"
#include "engine/base/transform.h"
#include "engine/scene/sector.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lightwell {

/// Index into Scene::modifiers.
using ModifierId = std::int32_t;
inline constexpr ModifierId void_modifier = -1;

enum class Shape : std::uint8_t { polygon, sphere, bubble, cone, cup, cylinder, tube, ring, source, mesh, instance };

/// One surface: which shape array of its Part holds the geometry, and what it is made of.
struct Surface {
    Shape shape;
    std::uint32_t index; ///< into the Part's array of that shape (cones hold cone, cup, cylinder and tube)
    ModifierId modifier; ///< its layer: the modifier's name is the layer's name
    std::string name;    ///< stable id: handle, node path or the identifier in the scene text
};

/// Any number of corners, planar, concave allowed; holes are joined to the outline by seams (two coincident edges
/// walked in opposite directions). The front is the side from which the corners run counter-clockwise.
struct Polygon {
    std::uint32_t first; ///< into Part::points
    std::uint32_t count; ///< >= 3
};

/// Sphere (normal outwards) or bubble (normal inwards).
struct Sphere {
    Point centre;
    double radius; ///< > 0
};

/// Side of a truncated cone without ends: cone and cylinder with the normal outwards, cup and tube inwards.
struct Cone {
    Point ends[2];
    double radii[2];    ///< >= 0, not both 0; equal for cylinder and tube
    Sector sector = {}; ///< about the axis from the first to the second end
};

/// Flat disc with an optional concentric hole.
struct Ring {
    Point centre;
    Direction normal;
    double inner_radius, outer_radius; ///< 0 <= inner < outer
    Sector sector = {};                ///< about the normal
};

/// Something so far away that only its direction counts: the sun, the sky.
struct DistantSource {
    Direction to_source;
    double full_angle_deg; ///< (0, 360]; 180 is a hemisphere
};

/// Triangles with shared corners; normals and texture coordinates per corner are optional. Shared by instances.
struct Mesh {
    std::vector<Point> points;
    std::vector<std::uint32_t> triangles; ///< three indices each into points
    std::vector<Direction> normals;       ///< empty, or one for each point (interpolated across triangles)
    std::vector<double> texture;          ///< empty, or u, v for each point
};

/// The modifier that an instance puts in the place of one that its prototype inherits (DXF layer 0, BYBLOCK).
struct Binding {
    ModifierId inherited; ///< a modifier of kind Inherited used in the prototype
    ModifierId actual;    ///< may itself be inherited, from the instance around this one
};

/// A copy of a prototype in place.
struct Instance {
    std::uint32_t prototype; ///< into Scene::prototypes
    Affine to_parent;        ///< any non-singular affine map
    std::vector<Binding> bindings;
};

/// A list of surfaces with their geometry in one frame: the scene itself, or a prototype for instances.
struct Part {
    std::string name;
    std::vector<Surface> surfaces;
    std::vector<Point> points; ///< corners of polygons
    std::vector<Polygon> polygons;
    std::vector<Sphere> spheres;
    std::vector<Cone> cones;
    std::vector<Ring> rings;
    std::vector<DistantSource> sources;
    std::vector<std::shared_ptr<const Mesh>> meshes;
    std::vector<Instance> instances;

    void add_polygon(const std::vector<Point>& corners, ModifierId modifier, std::string surface_name);
    /// Outline and holes become one polygon with seams; holes may run either way round.
    void add_polygon_with_holes(const std::vector<Point>& outline, const std::vector<std::vector<Point>>& holes,
                                ModifierId modifier, std::string surface_name);
    void add_sphere(const Sphere& sphere, Shape sphere_or_bubble, ModifierId modifier, std::string surface_name);
    void add_cone(const Cone& cone, Shape kind, ModifierId modifier, std::string surface_name);
    void add_ring(const Ring& ring, ModifierId modifier, std::string surface_name);
    void add_source(const DistantSource& source, ModifierId modifier, std::string surface_name);
    void add_mesh(std::shared_ptr<const Mesh> mesh, ModifierId modifier, std::string surface_name);
    void add_instance(Instance instance, std::string surface_name);
};

/// Area vector by Newell's rule: length = area for a planar outline, direction = front side. Corners are taken
/// relative to the first, so that far-away polygons keep their digits.
Vec3 polygon_area_vector(const Point* corners, std::size_t count) noexcept;
/// Area in m^2 of one surface in its part's frame; 0 for source and instance.
double surface_area_m2(const Part& part, const Surface& surface);
/// The part of a full turn that a ring or the side of a cone covers; of all other shapes a whole turn.
const Sector& sector_of(const Part& part, const Surface& surface) noexcept;
/// The smallest box around the image of one surface; empty for source and instance.
Box surface_bounds(const Part& part, const Surface& surface, const Affine& map = {});

} // namespace lightwell
