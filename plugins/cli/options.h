#pragma once

#include "importers/importer.h"

#include <functional>
#include <string>
#include <utility>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace lightwell {

struct SceneWords;
struct SkyWords;

/// How to read a CAD file: `--unit`, `--up`.
struct ImportWords {
    std::string unit, up;
};
void add_import_words(CLI::App& command, ImportWords& words);
ImportOptions import_options(const ImportWords& words);

/// The sky of a CAD scene: `--sky`, `--place`, `--time`, `--north`, `--turbidity`, `--ground`.
void add_sky_words(CLI::App& command, SkyWords& words);
/// The scene itself, `--map`, and all of the above.
void add_scene_words(CLI::App& command, SceneWords& words);

/// How much work: `--accuracy`, `--samples`, `--seed`, `--threads`.
struct EffortWords {
    double accuracy = 0;
    int samples = 0;
    std::uint64_t seed = 1;
    int threads = 0;
    bool unbiased = false;
    bool plan = false;
};
/// `--unbiased`, for pictures.
void add_unbiased_flag(CLI::App& command, EffortWords& words);
/// `--plan`: predict cost and error before the run.
void add_plan_flag(CLI::App& command, EffortWords& words);
/// @param accuracy  the default, relative
void add_effort_words(CLI::App& command, EffortWords& words, double accuracy);

/// "5%" or "0.05".
/// @throws CLI::ValidationError unless it lies between 0 and 1
double parse_accuracy(const std::string& text);
/// "X0,Y0,X1,Y1": columns X0 to X1 - 1 and rows Y0 to Y1 - 1 of a picture, row 0 at the top.
struct RegionWords {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
/// @throws CLI::ValidationError unless 0 <= X0 < X1 <= 32768 and the same for Y
RegionWords parse_region(const std::string& text);
/// "960x540": width and height in pixels.
/// @throws CLI::ValidationError unless both are in 1 ... 32768
std::pair<int, int> parse_size(const std::string& text);

} // namespace lightwell
