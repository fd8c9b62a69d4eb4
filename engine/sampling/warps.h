#pragma once

#include "engine/base/vector.h"

namespace lightwell {

/// A direction with the density it was drawn with. A density of 0 means that there was nothing to sample.
struct SampledDirection {
    Direction direction;
    double density_per_sr = 0;
};

/// A point in the unit disc.
struct DiscPoint {
    double x = 0, y = 0;
};

/// Area-preserving map that keeps neighbours together, so that stratified squares stay stratified.
/// Density is 1/pi per unit area.  Source  Shirley, Chiu 1997
DiscPoint uniform_disc(UnitSquare u) noexcept;

/// Direction about +z with density cos/pi.
Direction cosine_hemisphere(UnitSquare u) noexcept;
/// @param cosine  of the angle to +z; 0 below the plane
constexpr double cosine_hemisphere_density_per_sr(double cosine) noexcept
{
    return cosine > 0 ? cosine / pi : 0;
}

/// Every direction, density 1/(4 pi).
Direction uniform_sphere(UnitSquare u) noexcept;

/// 4 pi sin^2(a/2): keeps its digits down to the smallest angle, where 1 - cos(a) is zero.
/// @param half_angle_rad  [0, pi]
double cone_solid_angle_sr(double half_angle_rad) noexcept;
/// Uniform in solid angle about a unit axis, density 1 / cone_solid_angle_sr().
SampledDirection uniform_cone(const Direction& axis, double half_angle_rad, UnitSquare u) noexcept;

/// Solid angle of a sphere seen from a point; 4 pi when the point is inside or on it.
double sphere_solid_angle_sr(const Point& from, const Point& centre, double radius_m) noexcept;
/// Uniform over the cone in which the sphere is seen; over all directions from inside.
/// Source  Shirley, Wang, Zimmerman 1996
SampledDirection sphere_seen_from(const Point& from, const Point& centre, double radius_m, UnitSquare u) noexcept;

/// Solid angle of the triangle from + (a, a + ab, a + ac); positive, whatever the order of the corners.
/// Error: relative 1e-12 down to 1e-30 sr, since the volume is formed from edges instead of corners.
/// Source  Van Oosterom, Strackee 1983, Eq. (8)
double triangle_solid_angle_sr(const Vec3& a, const Vec3& ab, const Vec3& ac) noexcept;

/// Uniform in area: density 1/area per m^2.
Point triangle_by_area(const Point& a, const Point& b, const Point& c, UnitSquare u) noexcept;

/// A flat piece and the point it is seen from: what turns a density per area into one per solid angle.
struct SeenPlane {
    Vec3 corner; ///< relative to the point
    Vec3 normal; ///< cross product of the edges; its length is the area of the parallelogram
    /// distance^2 / (area * cosine) for the direction's point in the plane; 0 where the direction misses the plane.
    double density_per_sr(const Direction& direction, double area_m2) const noexcept;
};

/// Below this solid angle the spherical maps lose digits to cancellation, while a plain sample by area is as good:
/// density varies over the piece by less than about its angular size.
inline constexpr double smallest_spherical_sr = 1e-5;

/// A triangle sampled uniformly in the solid angle it is seen in.
/// Source  Arvo 1995, "Stratified Sampling of Spherical Triangles"; by area below
///         smallest_spherical_sr; from a point nearly in its plane, by hemisphere, where what misses has density 0
class SphericalTriangle {
public:
    SphericalTriangle(const Point& from, const Point& a, const Point& b, const Point& c) noexcept;
    double solid_angle_sr() const noexcept { return solid_angle_sr_; }
    SampledDirection sample(UnitSquare u) const noexcept;
    /// @param direction  of a point of the triangle
    double density_per_sr(const Direction& direction) const noexcept;

private:
    enum class Way { by_area, by_solid_angle, by_hemisphere };
    SampledDirection sample_solid_angle(UnitSquare u) const noexcept;
    SampledDirection sample_hemisphere(UnitSquare u) const noexcept;

    SeenPlane plane_;
    Vec3 edge_b_, edge_c_; ///< b - a, c - a
    Direction to_a_, to_b_, to_c_;
    double solid_angle_sr_ = 0;
    double area_m2_ = 0;
    double alpha_rad_ = 0;  ///< angle at a on the unit sphere
    double cos_side_c_ = 1; ///< cosine of the side a-b
    Way way_ = Way::by_area;
};

/// A rectangle sampled uniformly in the solid angle it is seen in.
/// Source  Urena, Fajardo, King 2013; by area below smallest_spherical_sr, seen edge-on, or when the edges are not
///         at right angles (any parallelogram is served, with the density that goes with it)
class SphericalRectangle {
public:
    SphericalRectangle(const Point& from, const Point& corner, const Vec3& edge_x, const Vec3& edge_y) noexcept;
    double solid_angle_sr() const noexcept { return solid_angle_sr_; }
    SampledDirection sample(UnitSquare u) const noexcept;
    /// @param direction  of a point of the rectangle
    double density_per_sr(const Direction& direction) const noexcept;

private:
    Vec3 sample_in_frame(UnitSquare u) const noexcept;

    SeenPlane plane_;
    Vec3 edge_x_, edge_y_;
    Direction x_, y_, z_;                               ///< frame of the rectangle; z away from the point
    double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0; ///< extents in that frame, z0 < 0
    double b0_ = 0, b1_ = 0, k_ = 0;                    ///< constants of the map (Urena et al., Section 3)
    double solid_angle_sr_ = 0;
    double area_m2_ = 0;
    bool by_area_ = true;
};

} // namespace lightwell
