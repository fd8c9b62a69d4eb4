#pragma once

#include <cstddef>
#include <string>

/// \file Numbers of the channels by which functions of patterns are told what they ask for.
namespace lightwell {

/// 1 to 27: the place, as materials/functions/library/rayinit.cal numbers it; up to 40 for what materials add.
inline constexpr std::size_t place_channels = 27;
/// What tables and pictures give, three of them; then the wavelength in nm.
inline constexpr std::size_t value_channel = 41, wavelength_channel = 44;
inline constexpr std::size_t most_channels = wavelength_channel;

/// `$41`
inline std::string channel_word(std::size_t channel)
{
    return std::string("$").append(std::to_string(channel));
}

} // namespace lightwell
