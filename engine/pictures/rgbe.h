#pragma once

#include "engine/pictures/picture.h"

#include <array>
#include <cstdint>
#include <filesystem>

namespace lightwell {

/// Radiance picture (32-bit_rle_rgbe): R, G, B and the header lines; EXPOSURE lines multiply and are divided out.
/// Source  Ward 1991, "Real Pixels"; Radiance file formats
void write_rgbe(const Picture& picture, const std::filesystem::path& file);
/// @throws InputError: not a Radiance picture, truncated, absurd size
Picture read_rgbe(const std::filesystem::path& file);

std::array<std::uint8_t, 4> encode_rgbe(float r, float g, float b) noexcept;
std::array<float, 3> decode_rgbe(std::array<std::uint8_t, 4> bytes) noexcept;

} // namespace lightwell
