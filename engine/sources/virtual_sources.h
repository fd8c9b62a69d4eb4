#pragma once

#include "engine/sources/source_list.h"
#include "engine/sources/virtual_mirrors.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace lightwell {

/// Mirrors one after the other, from the point that receives light towards its source.
struct Reflections {
    static constexpr int most = 12;
    std::array<std::int16_t, most> mirrors{};
    int count = 0;

    bool operator==(const Reflections&) const noexcept = default;
    bool operator<(const Reflections& other) const noexcept
    {
        return count != other.count ? count < other.count : mirrors < other.mirrors;
    }
    void add(int mirror) noexcept { mirrors[static_cast<std::size_t>(count++)] = static_cast<std::int16_t>(mirror); }
};

/// A ball for tests that may only err on the side of keeping.
struct Ball {
    Point centre;
    double radius_m = 0;
};

/// What all virtual sources behind the same mirrors share.
struct MirrorRoute {
    Reflections reflections;
    Affine unfold;                                ///< the receiver as the real source would see it
    Spectrum reflectance;                         ///< product
    std::array<Ball, Reflections::most> mirrors;  ///< where the receiver sees them, unfolded
    std::uint32_t first_image = 0, end_image = 0; ///< its images
};

/// A lamp or a sun as seen in mirrors.
struct VirtualSource {
    std::uint32_t route = 0;
    std::uint32_t source = 0; ///< index into the lamps or the suns
    bool is_sun = false;
    Ball ball;           ///< of a lamp: holds its image
    Direction to_sun;    ///< of a sun: towards the middle of its image
    double sin_half = 0; ///< of a sun: sine of its angular radius
};

struct VirtualSettings {
    int depth = 2;                  ///< mirrors one after the other, 0 to Reflections::most; 0: no virtual sources
    std::size_t most_images = 2048; ///< the strongest are kept; scattered rays find the others
};

/// Images of suns and lamps in flat mirrors and chains of mirrors, each with the volume in which it can be seen.
/// No image is left out because rays did not find it; what is beyond `most_images` is known as such to contains().
/// Source  Ward 1994, Section 3.4
class VirtualSources {
public:
    /// @throws InputError for a depth outside its range
    VirtualSources(const Scene& scene, const SourceList& sources, const VirtualSettings& settings);

    bool empty() const noexcept { return images_.empty(); }
    const MirrorSet& mirrors() const noexcept { return mirrors_; }
    const std::vector<VirtualSource>& images() const noexcept { return images_; }
    const std::vector<MirrorRoute>& routes() const noexcept { return routes_; }
    /// Images that were possible but are left to scattered rays.
    std::size_t left_out() const noexcept { return left_out_; }

    struct Candidate {
        std::uint32_t image;
        double potential;
    };
    /// The images of lamps, of suns, or of both that may shine on a point, in a fixed order.
    void candidates(const Receiver& receiver, bool lamps, bool suns, std::vector<Candidate>& found) const;
    /// Irradiance that an image would give without obstacles, roughly, W/m^2; 0 where it cannot give any.
    double potential(const VirtualSource& image, const Receiver& receiver) const noexcept;
    /// The image of a lamp or a sun behind these mirrors; -1 when there is none.
    int image_of(const Reflections& reflections, bool is_sun, int source) const noexcept;

private:
    struct Builder;
    bool may_see(const VirtualSource& image, const Point& from) const noexcept;

    const SourceList& sources_;
    MirrorSet mirrors_;
    std::vector<MirrorRoute> routes_;
    std::vector<VirtualSource> images_;
    std::map<Reflections, std::uint32_t> route_by_reflections_;
    std::size_t left_out_ = 0;
};

} // namespace lightwell
