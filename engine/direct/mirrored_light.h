#pragma once

#include "engine/direct/direct_light.h"
#include "engine/sources/virtual_sources.h"

namespace lightwell {

/// The mirrors that a path has met since the vertex whose shadow rays it is weighed against.
///
/// Rules: a vertex that gathers begins a chain when the path leaves it by a lobe of finite width; a mirror adds to it;
/// straight passages leave it alone; any other reflection or refraction ends it, as does the start at the eye, so that
/// sources met from there on count in full.
class MirrorChain {
public:
    void begin() noexcept { *this = MirrorChain{true}; }
    void end() noexcept { *this = MirrorChain{false}; }
    /// @param mirror  from MirrorSet::mirror_at(); -1 ends the chain
    void reflect(int mirror) noexcept
    {
        if (!open_ || mirror < 0 || reflections_.count == Reflections::most)
            end();
        else
            reflections_.add(mirror);
    }
    /// The way from the vertex led through at least one mirror and nothing but mirrors.
    bool mirrored() const noexcept { return open_ && reflections_.count > 0; }
    const Reflections& reflections() const noexcept { return reflections_; }
    MirrorChain() = default;

private:
    explicit MirrorChain(bool open) noexcept : open_(open) {}
    bool open_ = false;
    Reflections reflections_;
};

/// How shadow rays to virtual sources were shared out at a vertex.
struct MirrorShares {
    Receiver receiver;
    double total = 0; ///< sum of the potentials
    int rays = 0;     ///< in all, by potential; for each candidate when `each`
    bool each = false;
};

/// Light from lamps and suns by way of flat mirrors, by shadow rays through the mirrors: the receiver is mirrored
/// instead of the source, so that extended sources and spotlights are themselves, and every mirror's outline clips.
/// Error: unbiased together with scattered rays that leave out what is answered(), or weigh it by shadow_ray_weight()
///        with the densities given here (tests/analytic/mirror_test.cpp)
/// Source  Ward 1994, Section 3.4
class MirroredLight {
public:
    MirroredLight(const VirtualSources& sources, const SourceList& real, const RayQueries& rays)
        : sources_(sources), real_(real), rays_(rays)
    {
    }

    /// @param wish  few candidates are all tested, of many some are chosen by potential; the sky is not asked
    Gathered gather(const Vertex& vertex, const GatherWish& wish, PathRandom& random, MirrorShares& shares) const;

    /// True when gather() answers for the light of a lamp or a sun that a path has met by way of these mirrors,
    /// wherever the path began.
    bool answered(const MirrorChain& chain, bool is_sun, int source) const noexcept;
    /// Density with which gather() would have aimed through the chain at the place where a ray has met a lamp; 0 when
    /// it could not.
    /// @param direction  of the ray, before the lamp
    double lamp_density(const MirrorShares& shares, const MirrorChain& chain, int lamp, const Direction& direction,
                        const Hit& hit) const noexcept;
    double sun_density(const MirrorShares& shares, const MirrorChain& chain, int sun,
                       const Direction& direction) const noexcept;

private:
    struct Task;
    SourceSample aim(const Task& task, const VirtualSource& image, UnitSquare u) const noexcept;
    void test(const Task& task, const VirtualSource& image, double rays, UnitSquare u) const;
    Spectrum seen(const Vertex& vertex, const MirrorRoute& route, const SourceSample& sample,
                  bool* illum_front) const noexcept;
    double rays_of(const MirrorShares& shares, const MirrorChain& chain, bool is_sun, int source) const noexcept;

    const VirtualSources& sources_;
    const SourceList& real_;
    const RayQueries& rays_;
};

} // namespace lightwell
