#include "engine/sky/measured_sky.h"
#include "importers/generators/sky_words.h"

#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

std::string usage_of(const std::string& program)
{
    return fmt::format("Usage: {0} month day hour [options]\n   Or: {0} -ang altitude azimuth [options]\n   Or: {0} "
                       "-defaults\n",
                       program);
}

constexpr const char* defaults = R"(+s				# Sunny sky with sun
-g 0.200000			# Ground plane reflectance
-t 2.450000			# Atmospheric turbidity
-a 37.815214			# Site latitude (degrees)
-o 122.040010			# Site longitude (degrees)
-m 120.000000			# Standard meridian (degrees)
)";

void read_option(const std::string& option, WordReader& words, SkyMoment& moment, SkyOptions& sky,
                 MeasuredLight& measured)
{
    if (option == "-s" || option == "+s" || option == "-i" || option == "+i") {
        sky.kind = option[1] == 's' ? CieSky::clear : CieSky::intermediate;
        sky.with_sun = option[0] == '+';
    } else if (option == "-c" || option == "+c") {
        sky.kind = CieSky::overcast;
    } else if (option == "-u" || option == "+u") {
        sky.kind = CieSky::uniform;
    } else if (option == "-g") {
        sky.ground_reflectance = words.number("ground reflectance");
    } else if (option == "-t") {
        sky.turbidity = words.number("turbidity");
    } else if (option == "-b" || option == "-B") {
        const double value = words.number("zenith or diffuse value");
        measured.zenith = option == "-b" ? std::optional(value) : std::nullopt;
        measured.diffuse_W_per_m2 = option == "-B" ? std::optional(value) : std::nullopt;
    } else if (option == "-r" || option == "-R") {
        const double value = words.number("solar value");
        measured.half_degree_sun = option == "-r" ? std::optional(value) : std::nullopt;
        measured.direct_W_per_m2 = option == "-R" ? std::optional(value) : std::nullopt;
    } else if (!moment.option(option, words)) {
        throw BadWords("Use error - unknown option: " + option);
    }
}

int number_of(CieSky kind)
{
    return kind == CieSky::clear ? 1 : kind == CieSky::overcast ? 2 : kind == CieSky::uniform ? 3 : 4;
}

void append_sky(std::string& text, const SkyModel& sky)
{
    text += "\nvoid brightfunc skyfunc\n2 skybr skybright.cal\n0\n";
    if (sky.kind == CieSky::overcast || sky.kind == CieSky::uniform)
        text += fmt::format("3 {} {:.3e} {:.3e}\n", number_of(sky.kind), sky.zenith, sky.ground);
    else
        text += fmt::format("7 {} {:.3e} {:.3e} {:.3e} {:f} {:f} {:f}\n", number_of(sky.kind), sky.zenith, sky.ground,
                            sky.normalization, sky.to_sun.x, sky.to_sun.y, sky.to_sun.z);
}

} // namespace

GeneratorAnswer gensky(const std::vector<std::string>& words, const GeneratorInput&)
{
    return answered(words, usage_of(words[0]), [&](GeneratorAnswer& answer) {
        if (words.size() == 2 && words[1] == "-defaults") {
            answer.text = defaults;
            return;
        }
        WordReader reader(words);
        SkyMoment moment;
        SkyOptions options;
        MeasuredLight measured;
        moment.read(reader);
        while (reader.more())
            read_option(reader.word("option"), reader, moment, options, measured);
        moment.settle(words[0], answer);
        const MeasuredSky found = make_measured_sky(options, measured, moment.to_sun());
        const SkyModel& sky = found.sky;
        answer.text = comment_of(words);
        if (!moment.by_angles) {
            answer.text += fmt::format("# Local solar time: {:.2f}\n", moment.solar_hour);
            answer.text +=
                fmt::format("# Solar altitude and azimuth: {:.1f} {:.1f}\n",
                            moment.sun.altitude_rad / radians_per_degree, moment.sun.azimuth_rad / radians_per_degree);
        }
        if (sky.to_sun.z < moment.to_sun().z) {
            const std::string reduced = "warning - sun too close to zenith, reducing altitude to 87 degrees\n";
            answer.messages += words[0] + ": " + reduced;
            answer.text += "# " + reduced;
        }
        answer.text += fmt::format("# Ground ambient level: {:.1f}\n", found.mean);
        if (sky.with_sun)
            append_sun(answer.text, fmt::format("{:.3e}", found.half_degree_sun), sky.to_sun, "0.5");
        append_sky(answer.text, sky);
    });
}

} // namespace lightwell
