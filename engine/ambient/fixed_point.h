#pragma once

#include "engine/base/spectrum.h"
#include "engine/transport/hemisphere_rays.h"

#include <vector>

namespace lightwell {

/// A linear system x = known + weights x, each channel on its own: row i holds known[i] and the dependences of i.
struct FixedPoint {
    std::vector<Spectrum> known;
    std::vector<std::vector<Dependence>> rows;
};

/// Sums up dependences on the same unknown, in the order of unknowns.
void merge_dependences(std::vector<Dependence>& row);

/// Solves all channels. Rows that sum to less than 1 (surfaces that absorb something) have one solution; near 1, as
/// in a closed room of reflectance 0.999, summing bounces would take thousands of rounds, this takes tens.
/// Error: relative residual 1e-12 of the largest value, or the best reached
/// Source  Saad, Schultz 1986 (GMRES), restarted
std::vector<Spectrum> solve(const FixedPoint& system);

} // namespace lightwell
