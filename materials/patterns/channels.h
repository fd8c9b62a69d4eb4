#pragma once

#include "engine/base/transform.h"
#include "materials/patterns/pattern_place.h"

#include <array>
#include <cstddef>
#include <string>

/// \file Numbers of the channels by which functions of patterns are told what they ask for.
namespace lightwell {

/// 1 to 27: the place, as materials/functions/library/rayinit.cal numbers it; 28 to 34: what rayinit_material.cal adds.
inline constexpr std::size_t place_channels = 27;
/// Direction to the light, three of them.
inline constexpr std::size_t light_channel = 35;
/// What tables and pictures give, three of them; then the wavelength in nm.
inline constexpr std::size_t value_channel = 41, wavelength_channel = 44;
/// How the place changes along the coordinates on a mesh, three and three.
inline constexpr std::size_t along_u_channel = 45, along_v_channel = 48;
inline constexpr std::size_t most_channels = along_v_channel + 2;

using Channels = std::array<double, most_channels>;
/// The place as functions see it, in the frame of the pattern. Textures and patterns below a material are left out of
/// channels 28 to 34.
Channels channels_of(const PatternPlace& place, const Affine& to_pattern) noexcept;

/// `$41`
inline std::string channel_word(std::size_t channel)
{
    return std::string("$").append(std::to_string(channel));
}

} // namespace lightwell
