#include "importers/generators/sky_words.h"

#include "engine/base/text.h"

#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace lightwell::generators {
namespace {

struct Zone {
    std::string_view name;
    double meridian_west_deg;
};
/// Time zones by the words that sky programs know; the first of two equal names is meant.
constexpr std::array<Zone, 28> zones{
    {{"YST", 135}, {"YDT", 120},   {"PST", 120},   {"PDT", 105},  {"MST", 105},   {"MDT", 90},    {"CST", 90},
     {"CDT", 75},  {"EST", 75},    {"EDT", 60},    {"AST", 60},   {"ADT", 45},    {"NST", 52.5},  {"NDT", 37.5},
     {"GMT", 0},   {"BST", -15},   {"CET", -15},   {"CEST", -30}, {"EET", -30},   {"EEST", -45},  {"GST", -60},
     {"GDT", -75}, {"IST", -82.5}, {"IDT", -97.5}, {"JST", -135}, {"NZST", -180}, {"NZDT", -195}, {"UTC", 0}}};

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

double meridian_of(const std::string& name)
{
    std::string known;
    for (const Zone& zone : zones) {
        if (upper(name) == zone.name)
            return zone.meridian_west_deg * radians_per_degree;
        known += ' ' + std::string(zone.name);
    }
    throw BadWords("unknown time zone: " + name + "\nKnown time zones:\n\t" + known.substr(1));
}

/// `[+]HH`, `HH.hh` or `HH:MM`, and a time zone.
void read_hour(const std::string& word, SkyMoment& moment)
{
    std::string text = word;
    moment.solar = text.starts_with('+');
    if (moment.solar)
        text.erase(0, 1);
    const std::size_t zone = text.find_first_not_of("0123456789.:");
    const std::string digits = text.substr(0, zone);
    const std::size_t colon = digits.find(':');
    const auto hours = parse_double(digits.substr(0, colon));
    const auto minutes = colon == std::string::npos ? std::optional(0.0) : parse_double(digits.substr(colon + 1));
    if (zone != std::string::npos) {
        moment.clock.meridian_west_rad = meridian_of(text.substr(zone));
        moment.own_zone = true;
    }
    if (!hours || !minutes || !(*hours < 1000) || !(*minutes < 60))
        throw BadWords("bad time format: " + word);
    moment.hour = *hours + *minutes / 60;
}

/// More between clock and longitude than this is a slip.
constexpr double most_hours_apart = 3;

} // namespace

SkyMoment::SkyMoment()
{
    // The hill above Berkeley where these programs were written.
    clock = {37.815214 * radians_per_degree, 122.04001 * radians_per_degree, 120 * radians_per_degree};
}

void SkyMoment::read(WordReader& words)
{
    if (!words.more())
        throw BadWords("Use error - arg count");
    if (words.peek() == "-ang") {
        words.word("option");
        by_angles = true;
        sun.altitude_rad = words.number("altitude") * radians_per_degree;
        sun.azimuth_rad = words.number("azimuth") * radians_per_degree;
        return;
    }
    const auto whole = [&](const char* what, int most) {
        const auto value = parse_double(words.word(what));
        if (!value || !(*value >= 1 && *value < most + 1))
            throw BadWords(std::string("Use error - bad ") + what);
        return static_cast<int>(*value);
    };
    if (words.left() < 3)
        throw BadWords("Use error - arg count");
    month = whole("month", 12);
    day = whole("day", 31);
    read_hour(words.word("hour"), *this);
}

bool SkyMoment::option(const std::string& word, WordReader& words)
{
    if (word == "-y") {
        year = words.count("year", -10'000, 10'000);
    } else if (word == "-a") {
        clock.latitude_rad = words.number("latitude") * radians_per_degree;
    } else if (word == "-o") {
        clock.longitude_west_rad = words.number("longitude") * radians_per_degree;
    } else if (word == "-m") {
        const double meridian = words.number("standard meridian") * radians_per_degree;
        if (!own_zone)
            clock.meridian_west_rad = meridian;
    } else {
        return false;
    }
    return true;
}

namespace {

/// Of an interval in which the sun rises or sets, the middle of the part that it is up; else the hour itself.
double middle_of_daylight(const SolarTime& time, double interval_h, double latitude_rad)
{
    const double cosine = -std::tan(latitude_rad) * std::tan(time.declination_rad);
    if (!(interval_h > 0) || !(std::fabs(cosine) < 1))
        return time.hour;
    const double half_day = std::acos(cosine) * 12 / pi, sunrise = 12 - half_day, sunset = 12 + half_day;
    const double from = time.hour - interval_h / 2, to = time.hour + interval_h / 2;
    if (from < sunrise && to > sunrise)
        return (sunrise + to) / 2;
    return from < sunset && to > sunset ? (from + sunset) / 2 : time.hour;
}

} // namespace

void SkyMoment::settle(const std::string& program, GeneratorAnswer& answer)
{
    if (by_angles)
        return;
    if (year != 0 && (year < 1950 || year > 2050))
        answer.messages += program + ": warning - year should be in range 1950-2050\n";
    const double apart = (clock.longitude_west_rad - clock.meridian_west_rad) * 12 / pi;
    if (!solar && std::fabs(apart) > most_hours_apart)
        answer.messages +=
            fmt::format("{}: warning - {:.1f} hours btwn. standard meridian and longitude\n", program, apart);
    SolarTime time =
        year != 0 ? solar_time_of_date(year, month, day, hour, clock) : solar_time_of_day(day_number(), hour, clock);
    if (solar)
        time.hour = hour;
    time.hour = middle_of_daylight(time, interval_h, clock.latitude_rad);
    solar_hour = time.hour;
    sun = sun_angles(time, clock.latitude_rad);
}

int SkyMoment::day_number() const
{
    return by_angles ? 0 : day_of_year(month, day);
}

Direction SkyMoment::to_sun() const
{
    const double across = std::cos(sun.altitude_rad);
    return {-std::sin(sun.azimuth_rad) * across, -std::cos(sun.azimuth_rad) * across, std::sin(sun.altitude_rad)};
}

void append_sun(std::string& text, const std::string& radiance, const Direction& to_sun, const std::string& degrees)
{
    text += fmt::format("\nvoid light solar\n0\n0\n3 {0} {0} {0}\n", radiance);
    text += fmt::format("\nsolar source sun\n0\n0\n4 {:f} {:f} {:f} {}\n", to_sun.x, to_sun.y, to_sun.z, degrees);
}

} // namespace lightwell::generators
