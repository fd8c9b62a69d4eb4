#include "plugins/commands/radiance_settings.h"

#include "engine/base/text.h"
#include "plugins/commands/command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string_view>

namespace lightwell::commands {
namespace {

/// Options that other programs follow and whose purpose the engine reaches by itself, with the number of their values.
struct Accepted {
    std::string_view name;
    int values;
};
constexpr std::array<Accepted, 27> accepted{
    {{"-as", 1}, {"-ar", 1}, {"-aw", 1}, {"-st", 1}, {"-ss", 1}, {"-lr", 1}, {"-lw", 1}, {"-dj", 1}, {"-ds", 1},
     {"-dt", 1}, {"-dc", 1}, {"-dr", 1}, {"-dp", 1}, {"-ms", 1}, {"-mg", 1}, {"-am", 1}, {"-ae", 1}, {"-ai", 1},
     {"-aE", 1}, {"-aI", 1}, {"-me", 3}, {"-ma", 3}, {"-ap", 1}, {"-cs", 1}, {"-cw", 2}, {"-co", 0}, {"-pm", 1}}};
constexpr std::array<std::string_view, 2> accepted_switches{"-u", "-dv"};

[[noreturn]] void refuse(const std::string& word)
{
    throw Fatal("command line error at '" + word + "'");
}

} // namespace

const std::string& OptionReader::take()
{
    return words_[next_++];
}

const std::string& OptionReader::value(const std::string& option)
{
    if (!more())
        refuse(option);
    return take();
}

double OptionReader::number(const std::string& option)
{
    const auto number = parse_double(value(option));
    if (!number || !std::isfinite(*number))
        refuse(option);
    return *number;
}

int OptionReader::integer(const std::string& option)
{
    const double value = number(option);
    if (!(std::fabs(value) < 1e9) || value != std::nearbyint(value))
        refuse(option);
    return static_cast<int>(value);
}

std::optional<bool> switch_of(const std::string& word, const std::string& name, bool before)
{
    if (word == name)
        return !before;
    if (word.size() != name.size() + 1 || word.rfind(name, 0) != 0)
        return std::nullopt;
    const char sign = word.back();
    if (std::string_view("+1yYtT").find(sign) != std::string_view::npos)
        return true;
    if (std::string_view("-0nNfF").find(sign) != std::string_view::npos)
        return false;
    return std::nullopt;
}

bool read_setting(OptionReader& words, RadianceSettings& settings)
{
    const std::string word = words.peek();
    if (const auto on = switch_of(word, "-i", settings.irradiance)) {
        words.take();
        settings.irradiance = *on;
        return true;
    }
    if (const auto on = switch_of(word, "-w", settings.warnings)) {
        words.take();
        settings.warnings = *on;
        return true;
    }
    if (const auto on = switch_of(word, "-bv", settings.backs_seen)) {
        words.take();
        settings.backs_seen = *on;
        return true;
    }
    if (word == "-ab") {
        settings.ambient_bounces = (words.take(), words.integer(word));
    } else if (word == "-aa") {
        settings.ambient_accuracy = (words.take(), words.number(word));
    } else if (word == "-ad") {
        settings.ambient_divisions = (words.take(), words.integer(word));
    } else if (word == "-af") {
        settings.ambient_file = (words.take(), words.value(word));
    } else if (word == "-n") {
        settings.processes = (words.take(), words.integer(word));
    } else if (word == "-av") {
        words.take();
        const double r = words.number(word), g = words.number(word);
        settings.ambient_value = {r, g, words.number(word)};
    } else {
        const auto* known =
            std::find_if(accepted.begin(), accepted.end(), [&](const Accepted& a) { return a.name == word; });
        const bool is_switch =
            std::any_of(accepted_switches.begin(), accepted_switches.end(),
                        [&](std::string_view name) { return switch_of(word, std::string(name), false).has_value(); });
        if (known == accepted.end() && !is_switch)
            return false;
        words.take();
        for (int i = 0; known != accepted.end() && i < known->values; ++i)
            words.value(word);
        settings.without_effect.push_back(word);
    }
    if (settings.ambient_bounces < 0 || settings.ambient_divisions < 0 || !(settings.ambient_accuracy >= 0))
        refuse(word);
    return true;
}

double native_accuracy(const RadianceSettings& settings) noexcept
{
    constexpr double finest = 0.005, coarsest = 0.1, of_one_division = 0.7;
    return std::clamp(of_one_division / std::sqrt(std::max(1, settings.ambient_divisions)), finest, coarsest);
}

Preparation preparation_for(const RadianceSettings& settings)
{
    Preparation preparation;
    preparation.backs_unseen = !settings.backs_seen;
    if (settings.ambient_bounces == 0 || settings.ambient_divisions == 0)
        preparation.ambient_limit = {0, settings.ambient_value};
    else if (settings.ambient_accuracy == 0)
        preparation.ambient_limit = {settings.ambient_bounces, settings.ambient_value};
    return preparation;
}

RaySettings ray_settings(const RadianceSettings& settings)
{
    RaySettings rays;
    rays.accuracy = native_accuracy(settings);
    rays.unbiased = settings.ambient_accuracy == 0;
    rays.threads = settings.processes;
    rays.ambient_file.file = settings.ambient_file;
    if (settings.ambient_bounces == 0 || settings.ambient_divisions == 0)
        rays.constant_ambient = settings.ambient_value;
    return rays;
}

} // namespace lightwell::commands
