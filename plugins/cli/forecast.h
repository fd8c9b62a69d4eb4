#pragma once

#include "engine/control/predict.h"

#include <string>

namespace lightwell {

/// What pilot runs say of one view or grid.
struct Forecast {
    std::string of;
    double items = 0; ///< sensors or pixels
    double wanted_accuracy = 0;
    Prediction prediction;
};

/// Pilot runs of about a second, with a line of progress.
Forecast forecast(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings);
Forecast forecast(const Simulation& simulation, const View& view, const PictureSettings& settings);

/// "expected, grid desk, 120 sensors" and what it will take, two lines.
std::string to_text(const Forecast& forecast);

} // namespace lightwell
