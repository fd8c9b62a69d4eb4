#include "engine/base/duration.h"
#include "engine/base/text.h"
#include "engine/simulate/technique_names.h"
#include "plugins/cli/options.h"
#include "plugins/cli/sky_words.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <thread>

namespace lightwell {
namespace {

/// `--quality` in multiples of the command's usual accuracy: each step takes about sixteen times the work.
struct Quality {
    const char* name;
    double multiple;
};
constexpr Quality qualities[] = {{"draft", 4}, {"normal", 1}, {"fine", 0.25}};

void add_without(CLI::App& command, EffortWords& words)
{
    std::string names;
    for (const TechniqueName& technique : technique_names())
        names.append(names.empty() ? "" : ", ").append(technique.name);
    command
        .add_option_function<std::string>(
            "--without",
            [&words](const std::string& list) {
                for (const std::string_view name : split(list, ","))
                    switch_off(std::string(name), words.techniques, words.preparation);
            },
            "switches techniques off, to see what each buys, with commas: " + names)
        ->type_name("NAMES");
}

/// What pictures and grids have in common.
template <class Settings>
Settings settings_of(const EffortWords& words)
{
    Settings settings;
    settings.samples = words.samples;
    settings.accuracy = words.accuracy;
    settings.seed = words.seed;
    settings.threads = words.threads;
    settings.unbiased = words.unbiased;
    settings.techniques = words.techniques;
    settings.ambient_file.file = words.ambient_file;
    return settings;
}

} // namespace

double accuracy_of_quality(const std::string& name, double usual)
{
    std::string known;
    for (const Quality& quality : qualities) {
        if (name == quality.name)
            return usual * quality.multiple;
        known.append(known.empty() ? "" : ", ").append(quality.name);
    }
    throw CLI::ValidationError("--quality", "\"" + name + "\" is no quality; expected one of " + known);
}

void add_effort_words(CLI::App& command, EffortWords& words, double accuracy)
{
    words.accuracy = accuracy;
    const auto set = [&words](double wanted) {
        words.accuracy = wanted;
        words.accuracy_given = true;
    };
    CLI::Option* percent = command.add_option_function<std::string>(
        "--accuracy", [set](const std::string& text) { set(parse_accuracy(text)); },
        "wanted standard error, relative, as median over the result: 5% or 0.05 (default " + shortest(accuracy) + ")");
    percent->type_name("PERCENT");
    command
        .add_option_function<std::string>(
            "--quality",
            [set, accuracy, &words](const std::string& name) {
                set(accuracy_of_quality(name, accuracy));
                words.quality = name;
            },
            "an accuracy by name: draft " + shortest(400 * accuracy) + "%, normal " + shortest(100 * accuracy) +
                "%, fine " + shortest(25 * accuracy) + "%")
        ->excludes(percent)
        ->type_name("NAME");
    command
        .add_option("--samples", words.samples,
                    "paths per pixel or sensor, instead of as many as the accuracy takes; ambient light still follows "
                    "the accuracy")
        ->check(CLI::Range(1, 1 << 24))
        ->type_name("N");
    command.add_option("--seed", words.seed, "of the random numbers; the same seed gives the same bits (default 1)")
        ->type_name("N");
    command.add_option("--threads", words.threads, "0: all processors; the result does not depend on it")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    add_without(command, words);
}

void add_unbiased_flag(CLI::App& command, EffortWords& words)
{
    command.add_flag("--unbiased", words.unbiased,
                     "plain path tracing: nothing is stored and interpolated, only noise");
}

void add_plan_flag(CLI::App& command, EffortWords& words)
{
    command.add_flag("--plan", words.plan,
                     "first predicts cost and error; they stand beside what was reached in NAME.run.json");
}

void add_time_words(CLI::App& command, EffortWords& words, SkyWords* sky)
{
    const auto wish = [&words](const std::string& text) {
        const std::optional<double> seconds = parse_duration(text);
        if (!seconds)
            throw CLI::ValidationError("--within", "\"" + text + "\" is no time; expected 60s, 5min or 2h");
        words.time_s = *seconds;
    };
    command.add_option_function<std::string>("--within", wish, "the best result in this time: 60s, 5min, 2h")
        ->type_name("TIME");
    if (sky == nullptr) {
        command.add_option_function<std::string>("--time", wish, "the same as --within")->type_name("TIME");
        return;
    }
    command.remove_option(command.get_option("--time"));
    command
        .add_option_function<std::vector<std::string>>(
            "--time",
            [wish, sky](const std::vector<std::string>& texts) {
                for (const std::string& text : texts)
                    if (parse_duration(text))
                        wish(text);
                    else
                        sky->time = text;
            },
            "moment of the sky with its offset from UTC: 2026-03-21T12:00+01:00; or, as 60s, the same as --within")
        ->allow_extra_args(false)
        ->type_name("ISO");
}

void add_ambient_file(CLI::App& command, EffortWords& words)
{
    command
        .add_option("--ambient-file", words.ambient_file,
                    "ambient light kept for the next view or run, and shared with others at work: taken from this "
                    "file and added to it")
        ->type_name("FILE");
}

void add_secondary_words(CLI::App& command, EffortWords& words)
{
    command
        .add_option_function<std::string>(
            "--secondary",
            [&words](const std::string& list) {
                SecondarySettings& secondary = words.preparation.secondary;
                secondary.modifiers.clear();
                secondary.all_panes = list == "auto";
                if (list == "auto" || list == "none")
                    return;
                for (const std::string_view name : split(list, ","))
                    secondary.modifiers.emplace_back(name);
            },
            "openings that rays are aimed at for light that was scattered behind them: none (the default), auto (large "
            "panes that far more light comes through from one side), or names of panes and illums, with commas")
        ->type_name("none|auto|NAME,...");
}

void check_effort(const EffortWords& words)
{
    if (words.time_s > 0 && (words.accuracy_given || words.samples > 0))
        throw CLI::ValidationError("--within", "a time and an accuracy, quality or number of samples contradict each "
                                               "other; give one");
    if (words.ambient_file.empty())
        return;
    if (words.unbiased || !words.techniques.deep_field)
        throw CLI::ValidationError("--ambient-file", "plain path tracing keeps no ambient light; leave out "
                                                     "--unbiased and --without ambient, or the file");
    if (words.time_s > 0)
        throw CLI::ValidationError("--ambient-file", "kept light has one accuracy, which a time does not say; give "
                                                     "--accuracy or --quality");
}

PictureSettings picture_settings(const EffortWords& words, int width, int height)
{
    auto settings = settings_of<PictureSettings>(words);
    settings.width = width;
    settings.height = height;
    return settings;
}

GridSettings grid_settings(const EffortWords& words)
{
    return settings_of<GridSettings>(words);
}

std::string replay_words(double accuracy, int samples, std::uint64_t seed)
{
    return "--accuracy " + shortest(accuracy) + " --samples " + std::to_string(samples) + " --seed " +
           std::to_string(seed);
}

int processors(int threads)
{
    return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace lightwell
