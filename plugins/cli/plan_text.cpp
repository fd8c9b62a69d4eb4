#include "plugins/cli/plan_text.h"

#include "plugins/cli/terminal.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <sstream>

namespace lightwell {
namespace {

std::string number(double value, const char* format = "%.3g")
{
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string percent(double share)
{
    return number(100 * share, "%.2g") + " %";
}

void add_scene(std::ostream& out, const Plan& plan)
{
    const SceneNeeds& n = plan.needs;
    out << "scene     " << number(n.surfaces, "%.15g") << " surfaces, " << number(n.area_m2) << " m2, mean reflectance "
        << number(n.mean_reflectance, "%.2f") << " (by area)\n";
    out << "light     ";
    if (!n.lit())
        out << "none";
    const char* between = "";
    if (n.lamps.surfaces > 0) {
        out << number(n.lamps.surfaces, "%.15g") << (n.lamps.surfaces == 1 ? " lamp, " : " lamps, ")
            << number(n.lamp_flux_lm, "%.4g") << " lm";
        between = "; ";
    }
    if (n.suns > 0) {
        out << between << n.suns << (n.suns == 1 ? " sun" : " suns");
        between = "; ";
    }
    if (n.wide_sources > 0)
        out << between << (n.patterned ? "sky of varying brightness" : "uniform sky");
    if (plan.surroundings)
        out << "\naround    "
            << (plan.surroundings->enclosed() ? "enclosed" : percent(plan.surroundings->open_share) + " open") << ", "
            << number(plan.surroundings->distance_m) << " m to what is met";
    out << "\ncolour    " << (plan.channels == 1 ? "all grey: one channel would do" : "three channels") << '\n';
}

void add_stages(std::ostream& out, const Plan& plan, bool explain)
{
    out << "\ndone\n";
    for (const Stage& stage : plan.stages)
        if (stage.on)
            out << "  " << to_string(stage.kind) << ": " << stage.reason << '\n';
    if (explain) {
        out << "\nnot needed, not built\n";
        for (const Stage& stage : plan.stages)
            if (!stage.on)
                out << "  " << to_string(stage.kind) << ": " << stage.reason << '\n';
    }
    if (!plan.omissions.empty())
        out << "\nnot modelled\n";
    for (const Omission& omission : plan.omissions)
        out << "  " << omission.what << ": " << omission.effect << '\n';
}

void add_offer(std::ostream& out, const TimeOffer& offer)
{
    out << "  " << duration_text(offer.cpu_seconds) << " of CPU time: ask for an accuracy of "
        << percent(offer.accuracy) << '\n';
}

nlohmann::ordered_json json_of(const Usage& usage)
{
    return {{"surfaces", usage.surfaces}, {"area_m2", usage.area_m2}};
}

nlohmann::ordered_json json_of(const Need& need)
{
    nlohmann::ordered_json json = json_of(need.usage);
    json["reflectance"] = need.reflectance;
    return json;
}

nlohmann::ordered_json json_of(const SceneNeeds& n)
{
    return {{"surfaces", n.surfaces},
            {"area_m2", n.area_m2},
            {"prototypes", n.prototypes},
            {"mean_reflectance", n.mean_reflectance},
            {"highest_reflectance", n.highest_reflectance},
            {"grey", n.grey},
            {"patterned", n.patterned},
            {"lamps", json_of(n.lamps)},
            {"lamp_flux_lm", n.lamp_flux_lm},
            {"spotlights", json_of(n.spotlights)},
            {"illums", json_of(n.illums)},
            {"suns", n.suns},
            {"wide_sources", n.wide_sources},
            {"diffuse_reflection", json_of(n.diffuse_reflection)},
            {"diffuse_transmission", json_of(n.diffuse_transmission)},
            {"glossy", json_of(n.glossy)},
            {"smooth", json_of(n.smooth)},
            {"panes", json_of(n.panes)},
            {"bodies", json_of(n.bodies)},
            {"planar_mirrors", json_of(n.planar_mirrors)},
            {"curved_mirrors", json_of(n.curved_mirrors)}};
}

} // namespace

std::string plan_text(const Plan& plan, const std::optional<Forecast>& forecast, const std::optional<TimeOffer>& offer,
                      bool explain)
{
    std::ostringstream out;
    add_scene(out, plan);
    add_stages(out, plan, explain);
    if (forecast)
        out << '\n' << to_text(*forecast);
    if (offer)
        add_offer(out, *offer);
    return out.str();
}

std::string plan_json(const Plan& plan, const std::optional<Forecast>& forecast, const std::optional<TimeOffer>& offer)
{
    nlohmann::ordered_json json;
    json["needs"] = json_of(plan.needs);
    if (plan.surroundings)
        json["surroundings"] = {{"open_share", plan.surroundings->open_share},
                                {"kept_per_bounce", plan.surroundings->kept_per_bounce},
                                {"distance_m", plan.surroundings->distance_m}};
    json["bounces"] = plan.bounces;
    json["channels"] = plan.channels;
    json["stages"] = nlohmann::ordered_json::array();
    for (const Stage& stage : plan.stages)
        json["stages"].push_back({{"stage", to_string(stage.kind)}, {"on", stage.on}, {"reason", stage.reason}});
    json["not_modelled"] = nlohmann::ordered_json::array();
    for (const Omission& omission : plan.omissions)
        json["not_modelled"].push_back({{"what", omission.what}, {"effect", omission.effect}});
    if (forecast) {
        const Prediction& p = forecast->prediction;
        json["expected"] = {{"of", forecast->of},
                            {"wanted_accuracy", forecast->wanted_accuracy},
                            {"cpu_seconds", p.cpu_seconds},
                            {"median_relative_error", p.error},
                            {"rays", std::round(p.rays)},
                            {"samples", p.samples},
                            {"pilot_cpu_seconds", p.pilot.seconds}};
    }
    if (offer)
        json["within_time"] = {{"cpu_seconds", offer->cpu_seconds}, {"accuracy", offer->accuracy}};
    return json.dump(2) + "\n";
}

} // namespace lightwell
