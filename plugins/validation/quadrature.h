#pragma once

#include <vector>

namespace lightwell {

/// Where to evaluate and with what weight.
struct QuadratureNode {
    double x, weight;
};
/// Gauss-Legendre nodes on [low, high]; the weights sum to high - low.
/// Error: 1e-15 of the nodes; exact for polynomials up to degree 2 count - 1
/// Source  Abramowitz, Stegun, 25.4.30; the roots by Newton's method
std::vector<QuadratureNode> gauss_legendre(int count, double low, double high);

} // namespace lightwell
