#include "plugins/cli/forecast.h"

#include "plugins/cli/terminal.h"

#include <cstdio>

namespace lightwell {

Forecast forecast(const Simulation& simulation, const SensorGrid& grid, const GridSettings& settings)
{
    ProgressLine line("plan");
    return {"grid " + grid.name + ", " + std::to_string(grid.sensors.size()) + " sensors",
            static_cast<double>(grid.sensors.size()), settings.accuracy,
            predict(simulation, grid, settings, usual_pilot_rays, line.progress())};
}

Forecast forecast(const Simulation& simulation, const View& view, const PictureSettings& settings)
{
    ProgressLine line("plan");
    return {"view " + view.name + ", " + std::to_string(settings.width) + " x " + std::to_string(settings.height),
            static_cast<double>(settings.width) * settings.height, settings.accuracy,
            predict(simulation, view, settings, usual_pilot_rays, line.progress())};
}

std::string to_text(const Forecast& forecast)
{
    const Prediction& p = forecast.prediction;
    char error[120];
    std::snprintf(error, sizeof error,
                  " of CPU time, median standard error %.2g %%, %d samples each (pilot runs: ", 100 * p.error,
                  p.samples);
    return "expected, " + forecast.of + "\n  " + duration_text(p.cpu_seconds) + error + duration_text(p.pilot.seconds) +
           ")\n";
}

} // namespace lightwell
