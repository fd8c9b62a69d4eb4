#pragma once

#include "engine/scene/scene.h"
#include "engine/sky/general_sky.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// The sky of a CAD scene: `--sky TYPE --place LAT,LON --time ISO [--north DEG]`.
struct SkyWords {
    std::string type; ///< empty: none
    std::string place, time;
    double north_deg = 0;
    double turbidity = 2.45;
    double ground_reflectance = 0.2;
};
/// The types, as --sky takes them.
std::vector<std::string> sky_names();

/// A sky with the words that describe it for the header of results.
struct DescribedSky {
    SkyModel model;          ///< unless it is one of the general skies
    std::string description; ///< "clear sky, sun at altitude 37.5, azimuth 175.1 degrees, ..."
    std::optional<GeneralSky> general = std::nullopt;
};
DescribedSky describe_sky(const SkyOptions& options, const PlaceAndTime& when, double north_deg);
void add_described_sky(Scene& scene, const DescribedSky& sky);
/// @throws InputError that names the option, what was given and what is expected
DescribedSky sky_of(const SkyWords& words);

/// "2026-03-21T12:00+01:00" (seconds and 'Z' allowed; the offset from UTC must be there).
/// @throws InputError that shows the form
void parse_time(const std::string& text, PlaceAndTime& when);
/// "52.5,13.4": latitude (north positive) and longitude (east positive), degrees.
void parse_place(const std::string& text, PlaceAndTime& when);

} // namespace lightwell
