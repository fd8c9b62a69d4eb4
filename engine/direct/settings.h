#pragma once

#include <cstddef>

namespace lightwell {

/// How thoroughly lamps and suns are tested at the vertices that are seen directly. Each technique can be left out, to
/// see what it saves.
struct DirectSettings {
    double threshold =
        0.05;             ///< sources that could add less than this share of what was found stay untested; 0: test all
    double certainty = 1; ///< [0, 1]: of n sources, the next n^certainty decide whether the rest is worth testing
    double subdivision = 0.2; ///< size over distance of the pieces of a source without a closed form
    double penumbra_noise =
        0.05;           ///< relative noise aimed at where sources are partly hidden; sets shadow rays a source
    int most_rays = 16; ///< to one source, of each kind (probes; pieces)
    std::size_t most_lamps = 256;   ///< of a scene that are taken one by one; beyond, in groups
    std::size_t lamp_groups = 40;   ///< one lamp of each at random
    bool adaptive = true;           ///< false: every source is tested
    bool subdivide = true;          ///< false: one shadow ray a source
    bool analytic = true;           ///< false: irradiance from the samples alone, also where a closed form is known
    bool tree = true;               ///< false: every lamp is looked at
    bool sampled_remainder = false; ///< untested sources: one at random (unbiased) instead of by their history
    bool glow_radii = false;        ///< glows are tested within their radius alone, for comparison with other programs
};

} // namespace lightwell
