#pragma once

#include "engine/base/progress.h"
#include "engine/simulate/simulate.h"

#include <string>
#include <vector>

namespace lightwell {

/// Part of an illuminance, with its own standard error.
struct Share {
    std::string name;
    double lux = 0, standard_error = 0;
};

/// What a layer's reflectance does to a sensor.
struct LayerEffect {
    std::string name;
    double reflectance = 0; ///< photopic, under diffuse light
    double lux_per_reflectance = 0, standard_error = 0;
};

struct ExplainSettings {
    double accuracy = 0.01; ///< wanted standard error of the whole, relative
    std::uint64_t seed = 1;
    int threads = 0;
    Preparation preparation = {};
};

/// Where the light of one sensor comes from. Each list of shares sums to the illuminance.
struct Explanation {
    Sensor sensor;
    double lux = 0, standard_error = 0;
    std::vector<Share> sources; ///< by layer of what emits
    std::vector<Share> layers;  ///< by what the sensor sees the light on; "straight from the sources" is one of them
    std::vector<Share> bounces; ///< by how often light was reflected or refracted; passing glass straight is none
    std::vector<LayerEffect> effects;
    std::uint64_t paths = 0;
};

/// Half width of a 95 % interval from a standard error of eight replicates.
double half_width_95(double standard_error) noexcept;

/// Plain path tracing, one run for each source, without bias.
/// Error: the standard errors stated; the derivative counts all that a layer reflects, its highlight with it
/// Source  a path's contribution is a product of reflectances, so that its logarithmic derivative by one of them is the
///         number of times that the path meets the layer
/// @throws InputError when nothing emits light, or a number of the sensor is not finite; Cancelled
Explanation explain(const Scene& scene, const Sensor& sensor, const ExplainSettings& settings,
                    const Progress& progress = {});

/// Tables for people: percentages with one digit that sum to 100.0.
std::string explanation_text(const Explanation& explanation);

/// Percentages with one digit, rounded so that they sum to 100.0 exactly.
std::vector<double> whole_percentages(const std::vector<Share>& shares);

} // namespace lightwell
