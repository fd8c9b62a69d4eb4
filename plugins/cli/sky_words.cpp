#include "plugins/cli/sky_words.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <chrono>
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

std::string tenths(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

[[noreturn]] void bad_time(const std::string& text)
{
    throw InputError("--time", "\"" + text + "\" is no time with an offset from UTC",
                     "expected for example 2026-03-21T12:00+01:00 or 2026-03-21T11:00Z");
}

/// Hours of "+01:00", "-0530" or "Z".
double parse_utc_offset(const std::string& offset, const std::string& text)
{
    if (offset == "Z" || offset == "z")
        return 0;
    int hours = 0, minutes = 0, used = 0;
    char sign = 0;
    const bool with_colon = std::sscanf(offset.c_str(), "%c%2d:%2d%n", &sign, &hours, &minutes, &used) == 3;
    if (!with_colon && std::sscanf(offset.c_str(), "%c%2d%2d%n", &sign, &hours, &minutes, &used) != 3)
        bad_time(text);
    const bool known_sign = sign == '+' || sign == '-';
    if (!known_sign || used != static_cast<int>(offset.size()) || hours < 0 || hours > 14 || minutes < 0 ||
        minutes > 59)
        bad_time(text);
    return (sign == '-' ? -1 : 1) * (hours + minutes / 60.0);
}

} // namespace

std::vector<std::string> sky_names()
{
    std::vector<std::string> names;
    for (const NamedSky& sky : skies)
        names.emplace_back(sky.name);
    return names;
}

void parse_time(const std::string& text, PlaceAndTime& when)
{
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
    if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) != 5)
        bad_time(text);
    double second = 0;
    int seconds_used = 0;
    if (std::sscanf(text.c_str() + used, ":%2lf%n", &second, &seconds_used) == 1)
        used += seconds_used;
    const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok() || year < 1 || hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0 && second < 60))
        bad_time(text);
    when.utc_offset_h = parse_utc_offset(text.substr(static_cast<std::size_t>(used)), text);
    when.year = year;
    when.month = month;
    when.day = day;
    when.hour = hour + minute / 60.0 + second / 3600;
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
    if (sky == skies.end())
        throw InputError("--sky", "\"" + words.type + "\" is no sky", "clear, intermediate, overcast or uniform");
    if (words.place.empty() || words.time.empty())
        throw InputError("--sky", std::string(words.place.empty() ? "--place" : "--time") + " is missing",
                         "a sky needs --place 52.5,13.4 and --time 2026-03-21T12:00+01:00");
    if (!std::isfinite(words.north_deg))
        throw InputError("--north", "\"" + shortest(words.north_deg) + "\" is no angle");
    PlaceAndTime when;
    parse_place(words.place, when);
    parse_time(words.time, when);
    const SunPosition sun = sun_position(when);
    const SkyOptions options{sky->kind, sky->with_sun, words.turbidity, words.ground_reflectance};
    return {make_sky(options, sun_direction(sun, words.north_deg)),
            std::string(sky->description) + ", sun at altitude " + tenths(sun.altitude_deg) + ", azimuth " +
                tenths(sun.azimuth_deg) + " degrees (clockwise from north), " + words.time + ", " + words.place};
}

} // namespace lightwell
