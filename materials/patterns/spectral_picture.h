#pragma once

#include "materials/patterns/picture_table.h"

#include <string>
#include <string_view>

namespace lightwell {

/// Whether these bytes begin a picture of spectra.
bool is_spectral_picture(std::string_view bytes) noexcept;
/// A Radiance picture of spectra (NCOMP, WAVELENGTH_SPLITS, FORMAT=Radiance_spectra), each pixel reduced to its colour:
/// the same value at all wavelengths is grey.
/// @throws InputError with the byte: no size, absurd counts, truncated scan lines
PictureTable read_spectral_picture(std::string_view bytes, const std::string& file);

} // namespace lightwell
