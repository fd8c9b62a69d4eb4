#pragma once

#include "engine/base/spectrum.h"

#include <vector>

namespace lightwell {

/// A wavelength and what a value of 1 there adds to the three channels.
struct SpectralWeight {
    double wavelength_nm;
    Spectrum weight;
};

/// Wavelengths from 380 to 780 nm whose weights sum to 1 in each channel: a value that is the same for all of them is
/// grey.
/// Error: the colour matching functions are good to 1 % of their peak
/// Source  CIE 1931 standard observer by the sums of Gaussians of Wyman, Sloan, Shirley 2013
const std::vector<SpectralWeight>& spectral_weights();

/// The nearest colour of the same brightness that the three primaries can mix: mixed with grey until no channel is
/// below 0. Black when the brightness is not above 0.
/// Source  recorded behaviour of the scene language (tests/unit/patterns): colours of single wavelengths
Spectrum within_primaries(const Spectrum& colour) noexcept;

/// The colour of values over wavelength, within what the primaries can mix.
/// @param value_at  called with a wavelength in nm
template <class ValueAt>
Spectrum spectral_colour(const ValueAt& value_at)
{
    Spectrum sum;
    for (const SpectralWeight& w : spectral_weights())
        sum += w.weight * value_at(w.wavelength_nm);
    return within_primaries(sum);
}

} // namespace lightwell
