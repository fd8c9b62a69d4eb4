#include "plugins/cli/sky_words.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/scene/add_sky.h"
#include "importers/project/date_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace lightwell {
namespace {

struct NamedSky {
    const char* name;
    const char* description;
    CieSky kind;
    bool with_sun;
};
constexpr std::array<NamedSky, 6> skies{{
    {"clear", "clear sky", CieSky::clear, true},
    {"clear-no-sun", "clear sky without the sun's disc", CieSky::clear, false},
    {"intermediate", "intermediate sky", CieSky::intermediate, true},
    {"intermediate-no-sun", "intermediate sky without the sun's disc", CieSky::intermediate, false},
    {"overcast", "overcast sky", CieSky::overcast, false},
    {"uniform", "uniform sky", CieSky::uniform, false},
}};

/// The general skies of the CIE: `cie-1` to `cie-15`.
constexpr const char* general_prefix = "cie-";
constexpr int general_skies = 15;

/// @return 0 for other words
int general_number(const std::string& type)
{
    for (int number = 1; number <= general_skies; ++number)
        if (type == general_prefix + std::to_string(number))
            return number;
    return 0;
}

std::string tenths(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

/// "2026-03-21T12:00+01:00", to the minute.
std::string time_text(const PlaceAndTime& when)
{
    const int minutes = static_cast<int>(when.hour * 60 + 0.5);
    const int offset = static_cast<int>(std::lround(std::fabs(when.utc_offset_h) * 60));
    char text[48];
    std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d%c%02d:%02d", when.year, when.month, when.day,
                  minutes / 60, minutes % 60, when.utc_offset_h < 0 ? '-' : '+', offset / 60, offset % 60);
    return text;
}

std::string sun_and_place(const SunPosition& sun, const PlaceAndTime& when)
{
    return ", sun at altitude " + tenths(sun.altitude_deg) + ", azimuth " + tenths(sun.azimuth_deg) +
           " degrees (clockwise from north), " + time_text(when) + ", latitude " + shortest(when.latitude_deg) +
           ", longitude " + shortest(when.longitude_deg);
}

} // namespace

std::vector<std::string> sky_names()
{
    std::vector<std::string> names;
    for (const NamedSky& sky : skies)
        names.emplace_back(sky.name);
    for (int number = 1; number <= general_skies; ++number)
        names.push_back(general_prefix + std::to_string(number));
    return names;
}

void add_described_sky(Scene& scene, const DescribedSky& sky)
{
    if (sky.general)
        add_general_sky(scene, *sky.general);
    else
        add_sky(scene, sky.model);
}

void parse_time(const std::string& text, PlaceAndTime& when)
{
    const std::optional<DateTime> time = parse_date_time(text);
    if (!time || !time->utc_offset_h)
        throw InputError(
            "--time", "\"" + text + "\" is no time with an offset from UTC",
            "expected for example 2026-03-21T12:00+01:00, 2026-03-21T11:00Z or 2026-03-21T12:00[Europe/Berlin]");
    when.utc_offset_h = *time->utc_offset_h;
    when.year = time->year;
    when.month = time->month;
    when.day = time->day;
    when.hour = time->hour;
}

void parse_place(const std::string& text, PlaceAndTime& when)
{
    const auto parts = split(text, ", ");
    const auto latitude = parts.size() == 2 ? parse_double(parts[0]) : std::nullopt;
    const auto longitude = parts.size() == 2 ? parse_double(parts[1]) : std::nullopt;
    if (!latitude || !longitude || !(*latitude >= -90 && *latitude <= 90) || !(*longitude >= -180 && *longitude <= 180))
        throw InputError("--place", "\"" + text + "\" is no latitude,longitude",
                         "expected degrees, north and east positive, for example 52.5,13.4");
    when.latitude_deg = *latitude;
    when.longitude_deg = *longitude;
}

DescribedSky sky_of(const SkyWords& words)
{
    const auto* sky = std::find_if(skies.begin(), skies.end(), [&](const NamedSky& s) { return s.name == words.type; });
    const int general = general_number(words.type);
    if (sky == skies.end() && general == 0)
        throw InputError("--sky", "\"" + words.type + "\" is no sky",
                         "clear, intermediate, overcast, uniform, or cie-1 to cie-15");
    if (words.place.empty() || words.time.empty())
        throw InputError("--sky", std::string(words.place.empty() ? "--place" : "--time") + " is missing",
                         "a sky needs --place 52.5,13.4 and --time 2026-03-21T12:00+01:00");
    if (!std::isfinite(words.north_deg))
        throw InputError("--north", "\"" + shortest(words.north_deg) + "\" is no angle");
    PlaceAndTime when;
    parse_place(words.place, when);
    parse_time(words.time, when);
    if (general > 0) {
        const SunPosition sun = sun_position(when);
        const SkyOptions options{CieSky::clear, true, words.turbidity, words.ground_reflectance};
        return {{},
                "CIE general sky " + std::to_string(general) + sun_and_place(sun, when),
                make_general_sky(general, options, sun_direction(sun, words.north_deg))};
    }
    return describe_sky({sky->kind, sky->with_sun, words.turbidity, words.ground_reflectance}, when, words.north_deg);
}

DescribedSky describe_sky(const SkyOptions& options, const PlaceAndTime& when, double north_deg)
{
    const auto* sky = std::find_if(skies.begin(), skies.end(), [&](const NamedSky& s) {
        return s.kind == options.kind && s.with_sun == options.with_sun;
    });
    const SunPosition sun = sun_position(when);
    return {make_sky(options, sun_direction(sun, north_deg)),
            (sky == skies.end() ? std::string("sky") : sky->description) + sun_and_place(sun, when)};
}

} // namespace lightwell
