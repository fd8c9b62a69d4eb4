#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/base/spectrum.h"
#include "engine/sampling/warps.h"
#include "engine/scene/scene.h"

#include <variant>
#include <vector>

namespace lightwell {

/// What a shadow ray aims at: a direction, how far, and how likely it was.
struct SourceSample {
    Direction to_light;
    double distance_m = infinity;
    double density_per_sr = 0; ///< 0: nothing to aim at
    Spectrum radiance;         ///< towards the point, unoccluded
};

/// Emitting flat pieces: a rectangle, or triangles.
struct FlatEmitter {
    std::vector<Point> corners;      ///< three per triangle; or corner, end of edge x, end of edge y of a rectangle
    std::vector<double> summed_area; ///< up to and including each triangle
    bool rectangle = false;
};
struct SphereEmitter {
    Sphere sphere;
};
struct RingEmitter {
    Ring ring;
};
struct ConeEmitter {
    Cone cone;
    bool inwards;
};

/// An emitting surface at a finite distance, instances resolved into the world frame.
class LocalSource {
public:
    using Shape = std::variant<FlatEmitter, SphereEmitter, RingEmitter, ConeEmitter>;
    LocalSource(Shape shape, const Material& material);

    /// Irradiance that the source would give without obstacles, roughly, W/m^2: never 0 where it can give any.
    double potential(const Point& at, const Direction& normal, bool transmits) const noexcept;
    SourceSample sample(const Point& from, UnitSquare u) const noexcept;
    /// Density with which sample() finds the direction in which `hit` on this source was found.
    double density_per_sr(const Point& from, const Direction& direction, const Hit& hit) const noexcept;
    const Material& material() const noexcept { return *material_; }

private:
    Shape shape_;
    const Material* material_;
    Point centre_;
    double radius_m_ = 0; ///< of a sphere about the centre that holds the source
    double area_m2_ = 0;
    Direction facing_; ///< of flat shapes
    bool flat_ = false;
    double strength_ = 0; ///< photopic radiance
};

} // namespace lightwell
