#pragma once

#include "engine/simulate/simulate.h"
#include "importers/importer.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace lightwell {

struct SceneWords;
struct SkyWords;

/// How to read a CAD file: `--unit`, `--up`, `--keep-triangles`, `--crease-angle`, `--extrude`.
struct ImportWords {
    std::string unit, up;
    bool keep_triangles = false;
    std::optional<double> crease_angle_deg;
    std::vector<std::string> extrude; ///< LAYER=HEIGHT
};
void add_import_words(CLI::App& command, ImportWords& words);
ImportOptions import_options(const ImportWords& words);

/// The sky of a CAD scene: `--sky`, `--place`, `--time`, `--north`, `--turbidity`, `--ground`.
void add_sky_words(CLI::App& command, SkyWords& words);
/// The scene itself, `--map`, and all of the above.
void add_scene_words(CLI::App& command, SceneWords& words);

/// How much work: `--accuracy`, `--quality`, `--samples`, `--seed`, `--threads`, `--without`.
struct EffortWords {
    double accuracy = 0;
    int samples = 0;
    std::uint64_t seed = 1;
    int threads = 0;
    bool unbiased = false;
    bool plan = false;
    double time_s = 0;        ///< wanted; 0: an accuracy is
    std::string ambient_file; ///< empty: none
    Techniques techniques = {};
    Preparation preparation = {};
    bool accuracy_given = false; ///< by `--accuracy` or `--quality`
    std::string quality;         ///< empty: not given
};
PictureSettings picture_settings(const EffortWords& words, int width, int height);
GridSettings grid_settings(const EffortWords& words);
/// `--within`, and `--time`, for what makes pictures and maps.
/// @param sky  where `--time` is the moment of the sky as well: told apart by their form; may be null
void add_time_words(CLI::App& command, EffortWords& words, SkyWords* sky);
/// `--ambient-file`.
void add_ambient_file(CLI::App& command, EffortWords& words);
/// `--secondary`.
void add_secondary_words(CLI::App& command, EffortWords& words);
/// To be called when all words are read.
/// @throws CLI::ValidationError for wishes that contradict each other
void check_effort(const EffortWords& words);
/// `--unbiased`, for pictures.
void add_unbiased_flag(CLI::App& command, EffortWords& words);
/// `--plan`: predict cost and error before the run.
void add_plan_flag(CLI::App& command, EffortWords& words);
/// @param accuracy  the default, relative
void add_effort_words(CLI::App& command, EffortWords& words, double accuracy);

/// The words that repeat a result to the bit.
std::string replay_words(double accuracy, int samples, std::uint64_t seed);
/// How many processors a number of threads stands for; 0: all.
int processors(int threads);
/// What a quality means where this accuracy is usual.
/// @throws CLI::ValidationError for a name that is none
double accuracy_of_quality(const std::string& name, double usual);
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
