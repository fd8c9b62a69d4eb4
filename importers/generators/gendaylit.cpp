#include "engine/sky/measured_sky.h"
#include "engine/sky/perez_sky.h"
#include "importers/generators/sky_words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

std::string usage_of(const std::string& program)
{
    return fmt::format(
        "\nUsage: {0} month day hour [-y year] [options]\n   or: {0} -ang altitude azimuth [options]\n"
        "  with -P epsilon delta, the parameters of Perez\n"
        "    or -W direct-normal diffuse-horizontal irradiance (W/m^2)\n"
        "    or -L direct-normal diffuse-horizontal illuminance (lux)\n"
        "    or -G direct-horizontal diffuse-horizontal irradiance (W/m^2)\n"
        "    or -E global-horizontal irradiance (W/m^2)\n"
        "  -O 0|1|2  what the radiances are: visible W/(m^2 sr), solar W/(m^2 sr), cd/m^2\n"
        "  -g reflectance of the ground, -s or -c no sun, -w no warnings, -a -o -m place and meridian, west positive\n"
        "  -i minutes: where the sun rises or sets within them, it stands in the middle of the part that it is up\n",
        program);
}

constexpr const char* defaults = R"(-g 0.200000			# Ground plane reflectance
-t 0.100000			# Atmospheric betaturbidity
-a 37.815214			# Site latitude (degrees)
-o 122.040010			# Site longitude (degrees)
-m 120.000000			# Standard meridian (degrees)
)";

/// What is known of the light.
enum class Given { parameters, irradiance, illuminance, horizontal, total };
enum class Output { visible, solar, photometric };

struct Wish {
    Given given = Given::parameters;
    double first = 0, second = 0; ///< direct and diffuse, epsilon and delta, or all of it
    Output output = Output::visible;
    double ground_reflectance = 0.2;
    bool sun = true; ///< without it, it lights nothing, not even the ground
    bool warnings = true;
    bool coloured = false;
};

void read_option(const std::string& option, WordReader& words, SkyMoment& moment, Wish& wish)
{
    const std::pair<const char*, Given> pairs[] = {
        {"-P", Given::parameters}, {"-W", Given::irradiance}, {"-L", Given::illuminance}, {"-G", Given::horizontal}};
    for (const auto& [word, given] : pairs) {
        if (option != word)
            continue;
        wish.given = given;
        wish.first = words.number("first value");
        wish.second = words.number("second value");
        return;
    }
    if (option == "-E") {
        wish.given = Given::total;
        wish.first = words.number("irradiance");
    } else if (option == "-O") {
        wish.output = static_cast<Output>(words.count("kind of output", 0, 2));
    } else if (option == "-g") {
        wish.ground_reflectance = words.number("ground reflectance");
        if (!(wish.ground_reflectance >= 0 && wish.ground_reflectance <= 1))
            throw BadWords("Use error - ground reflectance is not in [0, 1]");
    } else if (option == "-s" || option == "-c") {
        wish.sun = false;
    } else if (option == "-w") {
        wish.warnings = false;
    } else if (option == "-i") {
        moment.interval_h = words.number("minutes") / 60;
        if (!(moment.interval_h >= 0 && moment.interval_h <= 24))
            throw BadWords("Use error - time interval is not between 0 and 1440 minutes");
    } else if (option == "-t") {
        words.number("turbidity"); // no sky of Perez depends on it
    } else if (option == "-C") {
        wish.coloured = true;
    } else if (!moment.option(option, words)) {
        throw BadWords("Use error - unknown option: " + option);
    }
}

/// One sky on its way from the words to the text.
class Daylight {
public:
    Daylight(const Wish& wish, const SkyMoment& moment, GeneratorAnswer& answer)
        : wish_(wish), answer_(answer), day_(moment.day_number()), zenith_(pi / 2 - moment.sun.altitude_rad)
    {
    }

    /// False when there is no such sky.
    bool settle()
    {
        if (wish_.given != Given::parameters && !positive_light())
            return false;
        switch (wish_.given) {
        case Given::parameters:
            weather_ = within_bounds({wish_.first, wish_.second});
            light_ = irradiance_of(weather_, zenith_, day_);
            break;
        case Given::irradiance:
            light_ = {wish_.first, wish_.second};
            break;
        case Given::horizontal:
            light_ = {wish_.first / std::cos(zenith_), wish_.second};
            break;
        case Given::total:
            split_total();
            break;
        case Given::illuminance:
            from_illuminance();
            break;
        }
        if (wish_.given != Given::parameters && wish_.given != Given::illuminance)
            weather_ = within_bounds(weather_of(light_, zenith_, day_));
        direct_lx_ =
            wish_.given == Given::illuminance ? wish_.first : light_.direct * direct_efficacy(weather_, zenith_);
        diffuse_lx_ =
            wish_.given == Given::illuminance ? wish_.second : light_.diffuse * diffuse_efficacy(weather_, zenith_);
        return true;
    }

    const Weather& weather() const { return weather_; }
    double sun_radiance() const
    {
        const double solid_angle = 2 * pi * (1 - std::cos(sun_full_angle_deg / 2 * radians_per_degree));
        return direct() / solid_angle;
    }
    bool has_direct() const { return light_.direct > 0; }
    SkyShape shape() const { return perez_shape(weather_, zenith_); }
    /// The ground is lit by a sky of the CIE with the same zenith, and by the sun.
    double ground(const SkyShape& shape, double shape_sum, const Direction& to_sun) const
    {
        const double zenith = diffuse() / shape_sum * shape.relative(1, zenith_);
        SkyOptions like;
        like.kind = weather_.clearness <= 1   ? CieSky::overcast
                    : weather_.clearness >= 6 ? CieSky::clear
                                              : CieSky::intermediate;
        MeasuredLight measured;
        measured.zenith = zenith;
        constexpr double sun_sr = 6.8e-5;
        const double sun = !wish_.sun ? 0 : sun_sr / pi * sun_radiance() * std::cos(zenith_);
        return wish_.ground_reflectance * (make_measured_sky(like, measured, to_sun).mean + sun);
    }
    double diffuse() const { return in_unit(light_.diffuse, diffuse_lx_); }

private:
    /// In the unit of the output.
    double direct() const { return in_unit(light_.direct, direct_lx_); }
    double in_unit(double watts, double lux) const
    {
        constexpr double lumens_per_watt_white = 179;
        return wish_.output == Output::solar     ? watts
               : wish_.output == Output::visible ? lux / lumens_per_watt_white
                                                 : lux;
    }
    void warn(const std::string& what)
    {
        if (wish_.warnings)
            answer_.messages += "Warning: " + what + '\n';
    }

    bool positive_light()
    {
        if (wish_.first < 0)
            warn("direct irradiance < 0. Using 0.0");
        if (wish_.second < 0)
            warn("diffuse irradiance < 0. Using 0.0");
        wish_.first = std::max(0.0, wish_.first);
        wish_.second = std::max(0.0, wish_.second);
        const double sky = wish_.given == Given::total ? wish_.first : wish_.second;
        if (zenith_ > pi / 2)
            warn("air mass has reached the maximal value");
        if (sky > 0)
            return true;
        warn(wish_.first > 0    ? "no diffuse light, printing error sky"
             : zenith_ < pi / 2 ? "zero irradiance at sun altitude > 0, printing error sky"
                                : "zero irradiance, printing error sky");
        return false;
    }

    void split_total()
    {
        const double most = extraterrestrial_W_per_m2(day_) * std::cos(zenith_);
        constexpr double just_below = 0.999;
        if (wish_.first > most) {
            warn("global irradiance is higher than the time-dependent solar constant s0");
            wish_.first = just_below * most;
        }
        const double index = wish_.first / most;
        const double diffuse = wish_.first * diffuse_share(index);
        const double direct = wish_.first - diffuse;
        answer_.text += fmt::format("# erbs_s0, erbs_kt, irr_dir_h, irr_diff: {:.3f} {:.3f} {:.3f} {:.3f}\n"
                                    "# WARNING: the -E option is only recommended for a rough estimation!\n",
                                    most, index, direct, diffuse);
        light_ = {direct / std::cos(zenith_), diffuse};
    }

    /// Efficacies depend on the weather and the weather on watts: some rounds bring them together.
    void from_illuminance()
    {
        constexpr double solar_constant_W_per_m2 = 1367, solar_constant_lx = 127'500;
        constexpr double settled_W_per_m2 = 0.1;
        constexpr int most_rounds = 50;
        const double efficacy = solar_constant_lx / solar_constant_W_per_m2;
        light_ = {wish_.first / efficacy, wish_.second / efficacy};
        weather_ = within_bounds(weather_of(light_, zenith_, day_));
        SkyIrradiance last{0.1, 0.1};
        for (int round = 0; round < most_rounds; ++round) {
            if (std::fabs(light_.diffuse - last.diffuse) <= settled_W_per_m2 &&
                std::fabs(light_.direct - last.direct) <= settled_W_per_m2)
                return;
            last = light_;
            light_.diffuse = wish_.second / diffuse_efficacy(weather_, zenith_);
            const double of_sun = direct_efficacy(weather_, zenith_);
            constexpr double least_efficacy = 0.1;
            light_.direct = of_sun < least_efficacy ? 0 : wish_.first / of_sun;
            weather_ = within_bounds(weather_of(light_, zenith_, day_));
        }
    }

    Wish wish_;
    GeneratorAnswer& answer_;
    int day_;
    double zenith_;
    Weather weather_;
    SkyIrradiance light_;
    double direct_lx_ = 0, diffuse_lx_ = 0;
};

void append_sky(std::string& text, double normalization, double ground, const SkyShape& shape, const Direction& to_sun)
{
    text +=
        fmt::format("\nvoid brightfunc skyfunc\n2 skybright perezlum.cal\n0\n10 {:.3e} {:.3e} {:f} {:f} {:f} {:f} "
                    "{:f} {:f} {:f} {:f}\n",
                    normalization, ground, shape.a, shape.b, shape.c, shape.d, shape.e, to_sun.x, to_sun.y, to_sun.z);
}

/// The model has a pole above this altitude.
constexpr double highest_sun_rad = 87 * radians_per_degree;

void make(const std::vector<std::string>& words, GeneratorAnswer& answer)
{
    WordReader reader(words);
    SkyMoment moment;
    Wish wish;
    moment.read(reader);
    while (reader.more())
        read_option(reader.word("option"), reader, moment, wish);
    if (wish.coloured)
        answer.messages += words[0] + ": warning - the colour of the sky is not modelled (-C): it is grey\n";
    moment.settle(words[0], answer);
    if (moment.sun.altitude_rad > highest_sun_rad) {
        answer.messages += words[0] + ": warning - sun too close to zenith, reducing altitude to 87 degrees\n";
        moment.sun.altitude_rad = highest_sun_rad;
    }
    answer.text = comment_of(words);
    Daylight light(wish, moment, answer);
    const bool there = light.settle();
    const Direction to_sun = moment.to_sun();
    const SkyShape shape = there ? light.shape() : SkyShape{};
    const bool usable = there && moment.sun.altitude_rad > 0 && !(shape.b > 0);
    answer.text +=
        fmt::format("# Local solar time: {:.2f}\n# Solar altitude and azimuth: {:.1f} {:.1f}\n", moment.solar_hour,
                    moment.sun.altitude_rad / radians_per_degree, moment.sun.azimuth_rad / radians_per_degree);
    if (!usable) {
        if (there)
            answer.messages += moment.sun.altitude_rad <= 0
                                   ? "Warning: sun altitude below zero, printing error sky\n"
                                   : "Warning: positive Perez parameter B, printing error sky\n";
        return append_sky(answer.text, 0, 0, {}, to_sun);
    }
    const Weather& weather = light.weather();
    answer.text += fmt::format("# epsilon, delta, atmospheric precipitable water content : {:.4f} {:.4f} {:.4f} \n",
                               weather.clearness, weather.brightness, weather.water_cm);
    if (wish.sun)
        append_sun(answer.text, light.has_direct() ? fmt::format("{:.3e}", light.sun_radiance()) : "0.0", to_sun,
                   fmt::format("{:f}", sun_full_angle_deg));
    const double sum = shape.patch_sum(to_sun);
    append_sky(answer.text, light.diffuse() / sum, light.ground(shape, sum, to_sun), shape, to_sun);
}

} // namespace

GeneratorAnswer gendaylit(const std::vector<std::string>& words, const GeneratorInput&)
{
    return answered(words, usage_of(words[0]), [&](GeneratorAnswer& answer) {
        if (words.size() == 2 && words[1] == "-defaults")
            answer.text = defaults;
        else
            make(words, answer);
    });
}

} // namespace lightwell
