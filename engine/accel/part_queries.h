#pragma once

#include "engine/accel/flat_test.h"
#include "engine/accel/ray_queries.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

struct RTCSceneTy;
struct RTCDeviceTy;

/// \file What the folder's own files share; nothing outside engine/accel includes it.
namespace lightwell {

struct PartQueries;
struct MeshGeometry;

/// One surface of a Part as its leaf test sees it, so that the test touches as little memory as possible.
struct Leaf {
    std::uint32_t surface; ///< into Part::surfaces
    std::uint32_t index;   ///< into the array of its shape
    Shape shape;
};
struct PlacedInstance {
    Affine to_local;
    double stretch; ///< metres of the parent per metre of the prototype, at most
};

/// Transparent surfaces that a shadow ray passes, to be multiplied in order of distance: the product must not
/// depend on the order of visits. Beyond the room for that, the order costs the last bits.
class PassedSurfaces {
public:
    void add(double t, Spectrum transmittance)
    {
        if (count_ < room)
            passed_[count_++] = {t, transmittance.r, transmittance.g, transmittance.b};
        else
            overflow_ *= transmittance;
    }
    Spectrum product()
    {
        std::sort(passed_, passed_ + count_, [](const Passed& a, const Passed& b) { return a.t < b.t; });
        Spectrum left = overflow_;
        for (std::size_t i = 0; i < count_; ++i)
            left *= Spectrum{passed_[i].r, passed_[i].g, passed_[i].b};
        return left;
    }

private:
    struct Passed {
        double t, r, g, b;
    };
    static constexpr std::size_t room = 32;
    Passed passed_[room]; // not initialised: most shadow rays pass nothing
    std::size_t count_ = 0;
    Spectrum overflow_ = Spectrum::grey(1);
};

/// What all levels of one query share.
struct Trace {
    double t_max;
    Hit* hit = nullptr;
    const MeshGeometry* mesh = nullptr; ///< of the best hit
    bool backs_unseen = false;          ///< surfaces met from behind are not there
    bool opaque = false;
    PassedSurfaces* passed = nullptr; ///< of a transmittance query
    bool* illum_front = nullptr;      ///< of a transmittance query: see RayQueries::transmittance()
};

/// One level of instancing within a query.
struct Level {
    const PartQueries* part;
    Trace* trace;
    Point origin;
    Vec3 direction;
    double inverse_square;  ///< 1 / |direction|^2
    mutable RayFrame frame; ///< made when the first flat surface is met
    mutable bool has_frame;
    double float_t_per_t, t_shift; ///< Embree's t = (t - shift) * factor
    const Level* outer;
    const Instance* instance; ///< that leads to this level; null in the root
    std::uint64_t path;
    double stretch; ///< world metres per metre of this level
};

struct MeshGeometry {
    const PartQueries* part;
    std::uint32_t surface;
    std::vector<Direction> face_normals;
};

struct PartQueries {
    const Scene* scene = nullptr;
    const Part* part = nullptr;
    RTCSceneTy* embree = nullptr;
    const std::vector<PartQueries>* prototypes = nullptr;
    const std::vector<std::uint8_t>* see_through = nullptr;  ///< by modifier
    const std::vector<std::uint8_t>* unseen_backs = nullptr; ///< by modifier; all 0 where backs are seen
    const std::vector<const Material*>* materials = nullptr;
    const std::vector<ModifierId>* alternates = nullptr; ///< by modifier: what shadow rays meet for an Illum
    const VariedMaterials* varied = nullptr;
    Box box;
    Point centre;
    double scale = 1; ///< power of two: (p - centre) * scale lies within [-1, 1]
    std::vector<Leaf> leaves;
    std::vector<Direction> polygon_normals;
    std::vector<PlacedInstance> placed; ///< by instance
    std::vector<Box> instance_boxes;
    std::vector<std::unique_ptr<MeshGeometry>> meshes;

    PartQueries() = default;
    PartQueries(const PartQueries&) = delete;
    PartQueries& operator=(const PartQueries&) = delete;
    PartQueries(PartQueries&& other) noexcept { *this = std::move(other); }
    PartQueries& operator=(PartQueries&&) noexcept = default;
};

/// The start of a query in a part's frame.
Level make_level(const PartQueries& queries, Trace& trace, const Point& origin, const Vec3& direction);
/// Visits the surfaces of a part along the level's ray (embree_part.cpp).
void run(const PartQueries& queries, Level& level);

/// The exact tests (surface_tests.cpp): what they find goes to the level's Trace.
void test_leaf(const Level& level, const Leaf& leaf);
void test_triangle(const Level& level, const MeshGeometry& geometry, std::uint32_t triangle);
/// Normals and error of a hit found at this level, and where it lies in the frame of its part.
void describe(const Level& level, Hit& hit, const MeshGeometry* mesh);

/// Boxes, normals and inverse maps of a part; its prototypes come first.
void prepare_part(PartQueries& queries, const std::vector<Box>& prototype_boxes);
void build_part(PartQueries& queries, RTCDeviceTy* device);

/// Straight transmittance of a surface that a shadow ray has met.
/// @param direction    of the ray, unit
/// @param illum_front  see RayQueries::transmittance()
Spectrum passage(Hit& hit, const Direction& direction, double distance_m, const PartQueries& queries,
                 bool* illum_front) noexcept;

} // namespace lightwell
