#pragma once

#include "engine/sky/sky_clock.h"
#include "importers/generators/scene_text_out.h"

/// \file What gensky and gendaylit share: when and where, and the sun that follows.
namespace lightwell::generators {

/// The moment of a sky: `month day hour` with options, or `-ang altitude azimuth`.
struct SkyMoment {
    bool by_angles = false;
    SunAngles sun;
    int month = 0, day = 0, year = 0; ///< year 0: none in particular
    double hour = 0;
    bool solar = false;    ///< the hour is solar time
    bool own_zone = false; ///< the hour names its zone, which -m does not change
    SkyClock clock;
    double interval_h = 0; ///< that the moment is the middle of; 0: a moment alone
    double solar_hour = 0; ///< found by settle()

    SkyMoment();
    /// Reads the first words of the command.
    void read(WordReader& words);
    /// Reads `-a -o -m -y`; false for another option.
    bool option(const std::string& word, WordReader& words);
    /// Finds the sun.
    void settle(const std::string& program, GeneratorAnswer& answer);
    /// 0 when only angles are known.
    int day_number() const;
    Direction to_sun() const;
};
/// `MODIFIER`s and sources of a sun: what stands before the sky.
void append_sun(std::string& text, const std::string& radiance, const Direction& to_sun, const std::string& degrees);

} // namespace lightwell::generators
