#pragma once

#include "engine/plan/needs.h"
#include "engine/plan/surroundings.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// The parts of the simulation that a scene may or may not need.
enum class StageKind {
    lamps,                ///< shadow rays to lamps at finite distance
    adaptive_testing,     ///< the most promising lamps first, the remainder from their history
    spotlight_cones,      ///< lamps that only light a cone
    suns,                 ///< shadow rays to narrow distant sources
    sky,                  ///< wide distant sources
    openings,             ///< panes through which the sky is looked for
    virtual_sources,      ///< images of lamps and suns in flat mirrors
    secondary_sources,    ///< surfaces that the user chose as sources (illum)
    mirror_rays,          ///< single reflected rays
    glossy_rays,          ///< highlights of finite width
    transparent_bodies,   ///< refraction, absorption inside, total reflection
    diffuse_transmission, ///< translucent sheets
    interreflection,      ///< light by way of diffuse surfaces
    patterns              ///< radiance or colour that varies over a surface or with direction
};
std::string to_string(StageKind kind);

/// One part of the simulation: whether the scene needs it, and why, in a sentence.
struct Stage {
    StageKind kind;
    bool on = false;
    std::string reason;
};

/// What is not modelled, or only with more noise: where, and how much of the scene it concerns.
struct Omission {
    std::string what;
    std::string effect; ///< "no light is lost: ... more noise", or what is left out at most
};

struct PlanWish {
    double accuracy = 0.05; ///< relative
    int virtual_depth = 2;  ///< mirrors in a chain
};

/// What will be done for a scene, as plain data.
struct Plan {
    SceneNeeds needs;
    std::vector<Stage> stages; ///< every kind once, in the order of StageKind
    std::vector<Omission> omissions;
    int bounces = 0;  ///< beyond which less than the accuracy is left; paths are ended by roulette, not there
    int channels = 3; ///< 1 when nothing in the scene has a colour
    PlanWish wish;
    std::optional<Surroundings> surroundings; ///< of the places that are asked about

    bool uses(StageKind kind) const noexcept { return stages[static_cast<std::size_t>(kind)].on; }
};

/// @param surroundings  where known, decide how many bounces matter; else the mean reflectance by area does
/// @throws InputError for an accuracy outside (0, 1)
Plan plan_for(const SceneNeeds& needs, const PlanWish& wish, const std::optional<Surroundings>& surroundings = {});

/// "18 surfaces, 34.5 m2": for messages.
std::string to_text(const Usage& usage);

} // namespace lightwell
