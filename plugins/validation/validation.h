#pragma once

#include "engine/base/progress.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// Parts of the simulation that a row depends on.
enum class Technique : unsigned {
    direct = 1,          ///< lamps and the sun by shadow rays
    sky = 2,             ///< sky and surroundings
    glass = 4,           ///< thin panes
    interreflection = 8, ///< diffuse surfaces that light each other
    specular = 16        ///< mirrors and dielectric bodies
};
constexpr unsigned operator|(Technique a, Technique b) noexcept
{
    return static_cast<unsigned>(a) | static_cast<unsigned>(b);
}

struct ValidationOptions {
    bool full = false;                  ///< the tolerances of the cases, detection rows to a standard error of 0.1 %
    std::optional<Technique> perturb{}; ///< self-test: 2 % wrong in the scene that is run, not in what is expected
    std::string only{};                 ///< run the cases whose id contains this
    bool only_detection = false;        ///< run only the rows that notice an error of 2 %
    int threads = 0;                    ///< 0: all processors; the result does not depend on it
    std::uint64_t seed = 1;
};

/// One comparison with a number that does not come from the engine.
struct ValidationRow {
    std::string case_id, quantity, unit;
    double expected = 0, found = 0;
    double half_width_95 = 0; ///< of the 95 % interval around `found`
    double tolerance = 0;     ///< in the unit of the row
    unsigned techniques = 0;  ///< of Technique
    bool detection = false;   ///< fine enough to notice an error of 2 % in each technique it contains
    bool passed = false;
    std::string reason; ///< why it did not pass
    double cpu_s = 0;   ///< processor seconds of its measurement

    double deviation() const noexcept { return found - expected; }
};

/// Runs the cases through the engine. A case that cannot run becomes a row that has not passed, with the reason.
/// A row passes when |found - expected| <= tolerance + 3 standard errors and the standard error <= tolerance / 3.
/// @throws InputError when no case is chosen, Cancelled when progress says stop
std::vector<ValidationRow> validate_engine(const ValidationOptions& options, const Progress& progress = {});
bool all_passed(const std::vector<ValidationRow>& rows);
/// The rows as a table for people, with a last line that counts.
std::string validation_table(const std::vector<ValidationRow>& rows);
/// Names of the techniques in a row, in a fixed order.
std::vector<std::string> technique_names(unsigned techniques);
/// @param name  also `ambient` for interreflection
/// @throws InputError that lists the names
Technique parse_perturbation(const std::string& name);

/// A value recomputed from its formula, without the engine: case, key as `sensor` or `angle.part`, value.
struct ReferenceValue {
    std::string case_id, key;
    double value;
};
std::vector<ReferenceValue> reference_values();

} // namespace lightwell
