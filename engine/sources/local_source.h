#pragma once

#include "engine/accel/ray_queries.h"
#include "engine/base/box.h"
#include "engine/base/spectrum.h"
#include "engine/sampling/warps.h"
#include "engine/scene/varied_materials.h"

#include <optional>
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

/// The light of a source whose patterns change it from point to point and from direction to direction.
struct VariedLight {
    const VariedMaterials* varied = nullptr; ///< null: it does not change
    ModifierId modifier = void_modifier;
    std::optional<Affine> to_part = {}; ///< into the frame of the part that is instanced
};

/// An emitting surface at a finite distance, instances resolved into the world frame.
class LocalSource {
public:
    using Shape = std::variant<FlatEmitter, SphereEmitter, RingEmitter, ConeEmitter>;
    LocalSource(Shape shape, const Material& material, VariedLight varied = {});

    /// Irradiance that the source would give without obstacles, roughly, W/m^2: never 0 where it can give any.
    double potential(const Point& at, const Direction& normal, bool transmits) const noexcept;
    /// Irradiance that the source gives without obstacles for a radiance of 1, sr; nothing where no closed form is at
    /// hand (beams, cones, meshes that are not flat, discs that the horizon cuts).
    /// Error: relative 1e-6 (tests/unit/sources/unoccluded_test.cpp)
    std::optional<double> projected_solid_angle_sr(const Point& at, const Direction& normal) const noexcept;
    /// The same from the middle of the source alone: for order and rough sums, whatever the shape; 0 outside a beam.
    /// Error: relative 1/3 (size / distance)^2
    double middle_solid_angle_sr(const Point& at, const Direction& normal) const noexcept;
    /// Largest extent over distance, at most 2.
    double seen_size(const Point& at) const noexcept;
    SourceSample sample(const Point& from, UnitSquare u) const noexcept;
    /// As sample(), for `count` points at once: what they share is worked out once.
    void sample(const Point& from, const UnitSquare* u, int count, SourceSample* samples) const noexcept;
    /// Density with which sample() finds the direction in which `hit` on this source was found.
    double density_per_sr(const Point& from, const Direction& direction, const Hit& hit) const noexcept;
    const Material& material() const noexcept { return *material_; }
    /// What it sends towards a point, for order and rough sums: of patterns the value at its middle.
    Spectrum typical_radiance(const Point& towards) const noexcept;
    /// Whether parts of the source lie on both sides of the plane through a point; cones by the ball that holds them.
    bool crosses_horizon(const Point& at, const Direction& normal) const noexcept;
    const Point& centre() const noexcept { return centre_; }
    double radius_m() const noexcept { return radius_m_; } ///< of a ball about the centre that holds the source
    /// What a tree over lamps needs to know: where it is and where it sends light.
    struct Reach {
        Box box;
        Direction axis;           ///< about which the light leaves
        double half_angle_rad;    ///< beyond which none does; pi: to all sides
        double strength_W_per_sr; ///< photopic radiance times area
    };
    Reach reach() const noexcept;
    /// Tells the processor that this source is wanted soon.
    void prefetch() const noexcept
    {
        constexpr std::size_t cache_line = 64;
        for (std::size_t at = 0; at < sizeof(LocalSource); at += cache_line)
            __builtin_prefetch(reinterpret_cast<const char*>(this) + at);
    }

private:
    struct Seen;
    bool round() const noexcept { return !std::holds_alternative<FlatEmitter>(shape_); }
    /// Not part of one; of other shapes than rings true.
    bool is_whole_ring() const noexcept
    {
        const auto* ring = std::get_if<RingEmitter>(&shape_);
        return ring == nullptr || ring->ring.sector.is_whole();
    }
    Spectrum varied_radiance(const Point& from, const Direction& to_light, double distance_m,
                             const Direction& normal) const noexcept;
    double mean_strength() const noexcept;
    SourceSample sample_seen(const Seen& seen, const Point& from, UnitSquare u) const noexcept;
    bool in_beam(const Vec3& to_centre, double distance, int widened) const noexcept;
    Shape shape_;
    const Material* material_;
    VariedLight varied_;
    Spectrum radiance_; ///< along the normal
    Box box_;
    Point centre_;
    double radius_m_ = 0; ///< of a sphere about the centre that holds the source
    double area_m2_ = 0;
    Direction facing_; ///< of flat shapes
    bool flat_ = false;
    bool closed_form_ = false; ///< for its irradiance
    double strength_ = 0;      ///< photopic radiance
    const Spotlight* beam_ = nullptr;
    Direction aim_;
    double half_beam_rad_ = pi, cos_half_beam_ = -1, sin_half_beam_ = 0;
};

} // namespace lightwell
