#pragma once

#include "engine/geometry/limit_surface.h"

#include <array>
#include <memory>

namespace lightwell {

/// A place in a quarter of a face: each coordinate in [0, 1].
using FacePlace = std::array<double, 2>;

/// The limit surface of a checked cage, face by face. A face of four corners has one patch; any other has a patch for
/// each corner, from the corner (0, 0) over the middle of the edge behind it (1, 0) to the middle of the face (1, 1).
class CageFaces {
public:
    struct Sample {
        Point point;
        Vec3 along_u, along_v; ///< derivatives; their cross product looks to the front
    };
    CageFaces(const SubdivisionCage& cage, const std::string& place);
    ~CageFaces();
    CageFaces(const CageFaces&) = delete;
    CageFaces& operator=(const CageFaces&) = delete;

    std::size_t creases_left_out() const;
    /// Makes a face the one that is asked. @return false when it has no limit surface (a hole)
    bool choose(std::size_t face);
    Point point(std::size_t patch, const FacePlace& at) const;
    Sample sample(std::size_t patch, const FacePlace& at) const;

private:
    struct Surfaces;
    std::unique_ptr<Surfaces> surfaces_;
};

} // namespace lightwell
