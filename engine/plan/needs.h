#pragma once

#include "engine/plan/usage.h"

#include <string>
#include <vector>

namespace lightwell {

/// Surfaces that a technique would work on.
struct Need {
    Usage usage;
    double reflectance = 0; ///< or transmittance: mean by area, photopic
    explicit operator bool() const noexcept { return usage.surfaces > 0; }
};

/// What a scene holds that light or the choice of techniques depends on, found once and without rays.
struct SceneNeeds {
    // How surfaces scatter.
    Need diffuse_reflection, diffuse_transmission;
    Need glossy; ///< highlights of finite width
    Need smooth; ///< mirror-like highlights of plastic, metal and trans: found by scattered rays
    Need panes;  ///< thin glass: shadow rays pass it
    Need bodies; ///< solid transparent bodies
    Need planar_mirrors;
    Need curved_mirrors; ///< no virtual source can stand for their images
    Usage passages;      ///< mist, antimatter and prisms: light goes on there by no lobe

    // What sends light.
    Usage lamps;      ///< Light, Illum, Glow and Spotlight at finite distance; the next three are among them
    Usage spotlights; ///< limited to a cone
    Usage illums;     ///< chosen as secondary sources
    Usage glows;
    double lamp_flux_lm = 0;
    int suns = 0;
    int wide_sources = 0;   ///< sky and ground
    bool patterned = false; ///< some radiance or colour varies by a pattern

    // Numbers.
    double surfaces = 0, area_m2 = 0;
    double mean_reflectance = 0;    ///< by area, photopic, without emitters and panes
    double highest_reflectance = 0; ///< of those that have at least a hundredth of the area
    bool grey = true;               ///< no material and no source has a colour: one channel would do
    std::size_t prototypes = 0;

    /// A path needs light to arrive at all.
    bool lit() const noexcept { return lamps.surfaces > 0 || suns > 0 || wide_sources > 0; }
    bool scatters() const noexcept { return diffuse_reflection || diffuse_transmission || glossy || smooth; }
    /// Light ends where it falls, and lamps and suns send all there is: shadow rays find everything.
    bool only_direct() const noexcept
    {
        const bool sent_on = scatters() || panes || bodies || planar_mirrors || curved_mirrors ||
                             passages.surfaces > 0 || illums.surfaces > 0 || patterned;
        return !sent_on && wide_sources == 0;
    }
};

/// @param scene  one that validate() has accepted
SceneNeeds needs_of(const Scene& scene);

/// Bounces after which what is left falls below a share of the whole: reflectance^n <= share.
/// Source  closed enclosure of uniform reflectance: the n-th bounce carries reflectance^n
int bounces_that_matter(double reflectance, double share) noexcept;

} // namespace lightwell
