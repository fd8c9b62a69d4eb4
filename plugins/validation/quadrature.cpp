#include "plugins/validation/quadrature.h"

#include "engine/base/vector.h"

namespace lightwell {

std::vector<QuadratureNode> gauss_legendre(int count, double low, double high)
{
    constexpr int newton_steps = 8; // quadratic convergence from Chebyshev's estimate: four reach the last digit
    std::vector<QuadratureNode> nodes;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < newton_steps; ++step) {
            double before = 1, here = x;
            for (int degree = 2; degree <= count; ++degree) {
                const double next = ((2 * degree - 1) * x * here - (degree - 1) * before) / degree;
                before = here;
                here = next;
            }
            slope = count * (x * here - before) / (x * x - 1);
            x -= here / slope;
        }
        nodes.push_back({0.5 * (low + high + (high - low) * x), (high - low) / ((1 - x * x) * slope * slope)});
    }
    return nodes;
}

} // namespace lightwell
