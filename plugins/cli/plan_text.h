#pragma once

#include "engine/plan/plan.h"
#include "plugins/cli/forecast.h"

#include <optional>
#include <string>

namespace lightwell {

/// Which accuracy a given time buys.
struct TimeOffer {
    double cpu_seconds = 0, accuracy = 0;
};

/// A page for people: the scene, the stages, what is not modelled, what it will take.
/// @param explain  also the stages that are off
std::string plan_text(const Plan& plan, const std::optional<Forecast>& forecast, const std::optional<TimeOffer>& offer,
                      bool explain);
/// The same as JSON, complete.
std::string plan_json(const Plan& plan, const std::optional<Forecast>& forecast, const std::optional<TimeOffer>& offer);

} // namespace lightwell
