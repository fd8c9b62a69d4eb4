#include "engine/ambient/fixed_point.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr double wanted_residual = 1e-12;
/// Directions kept before a restart, and restarts: far more than rooms need (20 to 40 directions at 0.99).
constexpr std::size_t most_directions = 60;
constexpr int most_restarts = 20;

using Vector = std::vector<double>;

double product(const Vector& a, const Vector& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

double norm(const Vector& a)
{
    return std::sqrt(product(a, a));
}

/// x - weights x in one channel.
Vector applied(const FixedPoint& system, int channel, const Vector& x)
{
    Vector result(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        double sum = 0;
        for (const Dependence& d : system.rows[i])
            sum += d.weight[channel] * x[d.unknown];
        result[i] -= sum;
    }
    return result;
}

/// Plane rotations that keep the least-squares problem of GMRES triangular.
struct Triangle {
    std::vector<Vector> columns;
    Vector cosine, sine, right; ///< right: the rotated residual; its last entry is what is left

    void add(Vector column)
    {
        const std::size_t k = cosine.size();
        for (std::size_t i = 0; i < k; ++i) {
            const double a = column[i], b = column[i + 1];
            column[i] = cosine[i] * a + sine[i] * b;
            column[i + 1] = cosine[i] * b - sine[i] * a;
        }
        const double size = std::hypot(column[k], column[k + 1]);
        cosine.push_back(size > 0 ? column[k] / size : 1);
        sine.push_back(size > 0 ? column[k + 1] / size : 0);
        column[k] = size;
        right.push_back(-sine[k] * right[k]);
        right[k] *= cosine[k];
        columns.push_back(std::move(column));
    }
    Vector solution() const
    {
        Vector y(columns.size());
        for (std::size_t i = y.size(); i-- > 0;) {
            double sum = right[i];
            for (std::size_t j = i + 1; j < y.size(); ++j)
                sum -= columns[j][i] * y[j];
            y[i] = columns[i][i] != 0 ? sum / columns[i][i] : 0;
        }
        return y;
    }
};

/// Adds the best combination of up to most_directions Krylov directions to x. @return the residual left
double improve(const FixedPoint& system, int channel, const Vector& known, double enough, Vector& x)
{
    Vector residual = applied(system, channel, x);
    for (std::size_t i = 0; i < x.size(); ++i)
        residual[i] = known[i] - residual[i];
    const double start = norm(residual);
    if (!(start > enough))
        return start;
    for (double& r : residual)
        r /= start;
    std::vector<Vector> basis{residual};
    Triangle triangle;
    triangle.right = {start};
    while (basis.size() <= most_directions && std::fabs(triangle.right.back()) > enough) {
        Vector next = applied(system, channel, basis.back());
        Vector column;
        for (const Vector& b : basis) {
            column.push_back(product(next, b));
            for (std::size_t i = 0; i < next.size(); ++i)
                next[i] -= column.back() * b[i];
        }
        const double size = norm(next);
        column.push_back(size);
        triangle.add(std::move(column));
        if (!(size > 0))
            break;
        for (double& n : next)
            n /= size;
        basis.push_back(std::move(next));
    }
    const Vector y = triangle.solution();
    for (std::size_t k = 0; k < y.size(); ++k)
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] += y[k] * basis[k][i];
    return std::fabs(triangle.right.back());
}

Vector solve_channel(const FixedPoint& system, int channel)
{
    Vector known;
    for (const Spectrum& s : system.known)
        known.push_back(s[channel]);
    Vector x(known);
    const double enough = wanted_residual * norm(known);
    double before = infinity;
    for (int i = 0; i < most_restarts; ++i) {
        const double left = improve(system, channel, known, enough, x);
        if (!(left > enough) || !(left < before))
            break;
        before = left;
    }
    return x;
}

bool all_grey(const FixedPoint& system)
{
    const auto grey = [](Spectrum s) { return s.r == s.g && s.g == s.b; };
    if (!std::all_of(system.known.begin(), system.known.end(), grey))
        return false;
    return std::all_of(system.rows.begin(), system.rows.end(), [&](const auto& row) {
        return std::all_of(row.begin(), row.end(), [&](const Dependence& d) { return grey(d.weight); });
    });
}

} // namespace

void merge_dependences(std::vector<Dependence>& row)
{
    std::stable_sort(row.begin(), row.end(),
                     [](const Dependence& a, const Dependence& b) { return a.unknown < b.unknown; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (kept > 0 && row[kept - 1].unknown == row[i].unknown)
            row[kept - 1].weight += row[i].weight;
        else
            row[kept++] = row[i];
    row.resize(kept);
}

std::vector<Spectrum> solve(const FixedPoint& system)
{
    const Vector r = solve_channel(system, 0);
    const bool grey = all_grey(system);
    const Vector g = grey ? r : solve_channel(system, 1), b = grey ? r : solve_channel(system, 2);
    std::vector<Spectrum> x;
    for (std::size_t i = 0; i < r.size(); ++i)
        x.push_back({r[i], g[i], b[i]});
    return x;
}

} // namespace lightwell
