#pragma once

#include "engine/scene/scene.h"
#include "engine/simulate/simulate.h"
#include "plugins/validation/validation.h"

#include <functional>

namespace lightwell {

/// The factors of a deliberate error, for the test of the tests: 1 everywhere in an honest run.
struct Perturbation {
    double direct = 1, sky = 1, glass = 1, interreflection = 1, specular = 1;

    /// Lamp or sun of this luminance, cd/m^2.
    Light lamp(double luminance) const { return {Spectrum::grey(luminance * direct / lumens_per_watt)}; }
    /// Surroundings of this luminance.
    Glow surroundings(double luminance) const { return {Spectrum::grey(luminance * sky / lumens_per_watt), 0}; }
    /// Zenith radiance of a sky of this zenith luminance.
    double zenith(double luminance) const { return luminance * sky / lumens_per_watt; }
    Glass pane(double transmissivity, double index) const { return {Spectrum::grey(transmissivity * glass), index}; }
    /// Diffuse reflectance for which rho / (1 - rest rho), the reflected light when what comes back after one
    /// reflection is `rest` of it, changes by the factor.
    double reflectance(double rho, double rest) const
    {
        const double changed = interreflection * rho / (1 - rest * rho);
        return changed / (1 + rest * changed);
    }
    Mirror mirror(double reflectance) const { return {Spectrum::grey(reflectance * specular)}; }
    Plastic diffuse(double rho, double rest) const { return {Spectrum::grey(reflectance(rho, rest)), 0, 0}; }
};

struct WeightedSensor {
    Sensor sensor;
    double weight = 1;
};

/// How a check is measured.
enum class Method {
    plain, ///< path tracing, free of bias
    usual  ///< the engine as it is used, with ambient light kept in between: where paths are long
};

/// A quantity that the engine has to find: a weighted sum of illuminances, or the luminance in the middle of a view.
/// With `each`, as many quantities as sensors: the row shows the one that comes closest to its tolerance.
struct Check {
    std::string quantity;
    double expected = 0;
    double tolerance = 0; ///< in the unit of the quantity, at the highest accuracy
    std::vector<WeightedSensor> sensors = {};
    std::optional<View> view = {};
    bool detection = false;
    std::string unit = "lx";
    double quick_relative = 0.01; ///< least relative tolerance of a quick look
    bool only_full = false;       ///< too slow for a quick look
    bool exact = false;           ///< a view in which nothing is left to chance
    Method method = Method::plain;
    double tolerance_part = 0; ///< with `each`: relative tolerance of each, beside `tolerance`
    std::vector<double> each = {};
    std::vector<std::string> names = {}; ///< of the sensors, with `each`
};

/// One scene and what is measured in it.
struct Setup {
    std::function<Scene(const Perturbation&)> scene;
    std::vector<Check> checks;
    Preparation preparation = {};
};

/// Cases without a scene count something: they give their rows themselves.
using Count = std::function<ValidationRow(const ValidationOptions&)>;

struct Case {
    std::string id;
    unsigned techniques = 0;
    std::vector<Setup> setups = {};
    std::vector<std::pair<std::string, double>> references = {}; ///< key, value; the checks' own when empty
    Count count = {};
    /// Its setups and references where they take a while to find: called when they are needed.
    std::function<Case()> later = {};
    bool only_full = false; ///< the whole case
};

// One list each; validation.cpp puts them together.
std::vector<Case> lamp_cases();
std::vector<Case> form_factor_cases();
std::vector<Case> sun_cases();
std::vector<Case> sky_cases();
std::vector<Case> glass_cases();
std::vector<Case> dielectric_cases();
std::vector<Case> furnace_cases();
std::vector<Case> interreflection_cases();
std::vector<Case> mirror_cases();
std::vector<Case> leak_cases();
std::vector<Case> detection_cases();
std::vector<Case> electric_cases();
std::vector<Case> daylight_cases();
std::vector<Case> sky_model_cases();
std::vector<Case> radiosity_cases();

/// A check of one illuminance with a relative tolerance.
inline Check illuminance_check(std::string quantity, double expected, double relative, const Sensor& sensor)
{
    return {std::move(quantity), expected, relative * expected, {{sensor, 1}}, {}, false, "lx"};
}
/// A check of the luminance along one ray: the picture element is a millionth of a degree wide.
Check luminance_check(std::string quantity, double expected, double relative, const Point& from,
                      const Direction& direction);
/// The same checks, good for detecting errors of 2 %.
Check detecting(Check check);
/// `name` followed by the shortest decimal form of the number.
std::string numbered(const std::string& name, double number);

} // namespace lightwell
