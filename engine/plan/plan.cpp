#include "engine/plan/plan.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <cassert>
#include <fmt/format.h>

namespace lightwell {
namespace {

/// Fewer lamps than this are all tested: nothing is left to estimate.
constexpr double fewest_lamps_for_adaptive_testing = 4;

std::string percent(double share)
{
    return fmt::format("{:.3g} %", 100 * share);
}

std::string counted(double count, const char* one, const char* many)
{
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{:.15g} {}", count, many);
}

class Planner {
public:
    explicit Planner(Plan& plan) : plan_(plan), needs_(plan.needs) {}

    void add(StageKind kind, bool on, const std::string& reason)
    {
        assert(plan_.stages.size() == static_cast<std::size_t>(kind));
        plan_.stages.push_back({kind, on, reason});
    }
    void add_need(StageKind kind, const Need& need, const std::string& what, const char* none)
    {
        add(kind, static_cast<bool>(need), need ? fmt::format("{}: {}", to_text(need.usage), what) : none);
    }
    void sources();
    void mirrors();
    void scattering();
    void omissions();

private:
    std::string weakening() const
    {
        if (plan_.surroundings)
            return fmt::format("each bounce keeps {}", percent(plan_.surroundings->kept_per_bounce));
        return fmt::format("mean reflectance {:.2f}, highest {:.2f}", needs_.mean_reflectance,
                           needs_.highest_reflectance);
    }

    Plan& plan_;
    const SceneNeeds& needs_;
};

void Planner::sources()
{
    const double lamps = needs_.lamps.surfaces;
    add(StageKind::lamps, lamps > 0,
        lamps > 0 ? fmt::format("{}, {:.4g} lm: shadow rays", counted(lamps, "lamp", "lamps"), needs_.lamp_flux_lm)
                  : "no lamp");
    const bool adaptive = lamps + needs_.suns >= fewest_lamps_for_adaptive_testing;
    add(StageKind::adaptive_testing, adaptive,
        adaptive ? "the most promising lamps are tested first, the rest estimated from how often they were seen"
                 : "too few lamps to leave any untested");
    add(StageKind::spotlight_cones, needs_.spotlights.surfaces > 0,
        needs_.spotlights.surfaces > 0
            ? counted(needs_.spotlights.surfaces, "lamp lights", "lamps light") + " a cone; outside it no ray is spent"
            : "no lamp is limited to a cone");
    add(StageKind::suns, needs_.suns > 0,
        needs_.suns > 0 ? counted(needs_.suns, "sun", "suns") + ": shadow rays to the disc" : "no sun");
    add(StageKind::sky, needs_.wide_sources > 0,
        needs_.wide_sources > 0
            ? counted(needs_.wide_sources, "wide distant source", "wide distant sources") + ", sampled by brightness"
            : "no sky");
    const bool openings = needs_.panes && needs_.wide_sources > 0;
    add(StageKind::openings, openings,
        openings       ? fmt::format("panes ({}) show the sky: rays to it aim at them", to_text(needs_.panes.usage))
        : needs_.panes ? "panes, but no sky behind them"
                       : "no pane");
}

void Planner::mirrors()
{
    const bool narrow_sources = needs_.lamps.surfaces > 0 || needs_.suns > 0;
    const bool images = needs_.planar_mirrors && narrow_sources && plan_.wish.virtual_depth > 0;
    add(StageKind::virtual_sources, images,
        images                   ? fmt::format("flat mirrors ({}): images of lamps and suns, chains of {}",
                                               to_text(needs_.planar_mirrors.usage), plan_.wish.virtual_depth)
        : !needs_.planar_mirrors ? "no flat mirror"
        : !narrow_sources        ? "flat mirrors, but neither lamps nor suns"
                                 : "switched off");
    add(StageKind::secondary_sources, needs_.illums.surfaces > 0,
        needs_.illums.surfaces > 0 ? to_text(needs_.illums) + " chosen as secondary sources"
                                   : "none chosen (illum, --secondary)");
}

void Planner::scattering()
{
    const bool single = needs_.smooth || needs_.planar_mirrors || needs_.curved_mirrors || needs_.panes;
    add(StageKind::mirror_rays, single,
        single ? "mirrors, panes or smooth coatings: one reflected ray each" : "no mirror-like surface");
    add_need(StageKind::glossy_rays, needs_.glossy, "highlights, weighed against the lamps' shadow rays",
             "no glossy surface");
    add_need(StageKind::transparent_bodies, needs_.bodies, "refraction, absorption, total reflection",
             "no transparent body");
    add_need(StageKind::diffuse_transmission, needs_.diffuse_transmission, "light from both sides",
             "no translucent surface");
    const bool diffuse = needs_.diffuse_reflection || needs_.diffuse_transmission;
    add(StageKind::interreflection, diffuse,
        diffuse ? fmt::format("{}: after {} bounces less than {} is left", weakening(), plan_.bounces,
                              percent(plan_.wish.accuracy))
                : "no diffuse surface");
    add(StageKind::patterns, needs_.patterned,
        needs_.patterned ? "radiance varies with direction (sky)" : "no pattern");
}

void Planner::omissions()
{
    if (needs_.curved_mirrors) {
        const double share = needs_.curved_mirrors.reflectance * needs_.curved_mirrors.usage.area_m2 / needs_.area_m2;
        plan_.omissions.push_back(
            {"virtual sources of curved mirrors (" + to_text(needs_.curved_mirrors.usage) + ")",
             "no light is lost: scattered rays find it, with more noise; if light fell evenly it would be " +
                 percent(share) + " of all that surfaces receive"});
    }
    if (needs_.bodies && (needs_.lamps.surfaces > 0 || needs_.suns > 0))
        plan_.omissions.push_back({"light focused by transparent bodies (" + to_text(needs_.bodies.usage) + ")",
                                   "shadow rays stop at them; scattered rays find what passes, with more noise"});
    if (needs_.bodies)
        plan_.omissions.push_back({"spreading of colours by refraction",
                                   "the directions of colours differ by less than a degree; no light is lost"});
}

} // namespace

std::string to_string(StageKind kind)
{
    static constexpr const char* names[] = {"lamps",
                                            "adaptive testing",
                                            "spotlight cones",
                                            "suns",
                                            "sky",
                                            "openings",
                                            "virtual sources",
                                            "secondary sources",
                                            "mirror rays",
                                            "glossy rays",
                                            "transparent bodies",
                                            "diffuse transmission",
                                            "interreflection",
                                            "patterns"};
    return names[static_cast<std::size_t>(kind)];
}

std::string to_text(const Usage& usage)
{
    return counted(usage.surfaces, "surface", "surfaces") + fmt::format(", {:.3g} m2", usage.area_m2);
}

Plan plan_for(const SceneNeeds& needs, const PlanWish& wish, const std::optional<Surroundings>& surroundings)
{
    if (!(wish.accuracy > 0 && wish.accuracy < 1))
        throw InputError("plan", "accuracy is " + shortest(wish.accuracy) + ", expected above 0 and below 1",
                         "ask for 0.05 (5 %)");
    Plan plan;
    plan.needs = needs;
    plan.wish = wish;
    plan.surroundings = surroundings;
    plan.bounces =
        bounces_that_matter(surroundings ? surroundings->kept_per_bounce : needs.mean_reflectance, wish.accuracy);
    plan.channels = needs.grey ? 1 : 3;
    Planner planner(plan);
    planner.sources();
    planner.mirrors();
    planner.scattering();
    planner.omissions();
    return plan;
}

} // namespace lightwell
