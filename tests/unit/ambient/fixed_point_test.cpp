#include "engine/ambient/fixed_point.h"

#include "engine/sampling/path_random.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Rows of positive weights on some of the unknowns, which sum to the reflectance.
FixedPoint random_system(std::uint32_t size, std::uint32_t per_row, Spectrum reflectance)
{
    FixedPoint system;
    for (std::uint32_t i = 0; i < size; ++i) {
        PathRandom random(3, 1, i);
        system.known.push_back({random.one(), random.one(), random.one()});
        std::vector<Dependence> row;
        double sum = 0;
        for (std::uint32_t k = 0; k < per_row; ++k) {
            const double weight = 0.1 + random.one();
            const auto unknown = static_cast<std::uint32_t>(random.one() * size);
            row.push_back({unknown, Spectrum::grey(weight)});
            sum += weight;
        }
        for (Dependence& d : row)
            d.weight = d.weight * reflectance / sum;
        merge_dependences(row);
        system.rows.push_back(row);
    }
    return system;
}

/// Gauss-Jordan elimination with pivots, for one channel.
std::vector<double> eliminated(const FixedPoint& system, int channel)
{
    const std::size_t n = system.known.size();
    std::vector<std::vector<double>> a(n, std::vector<double>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
        a[i][i] += 1;
        for (const Dependence& d : system.rows[i])
            a[i][d.unknown] -= d.weight[channel];
        a[i][n] = system.known[i][channel];
    }
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k; i < n; ++i)
            pivot = std::fabs(a[i][k]) > std::fabs(a[pivot][k]) ? i : pivot;
        std::swap(a[k], a[pivot]);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = n + 1; i != k && j-- > k;)
                a[i][j] -= a[k][j] * (a[i][k] / a[k][k]);
    }
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i)
        x.push_back(a[i][n] / a[i][i]);
    return x;
}

TEST(FixedPoint, AgreesWithEliminationInEachChannel)
{
    for (const Spectrum reflectance : {Spectrum{0.2, 0.5, 0}, Spectrum{0.9, 0.99, 0.999}}) {
        const FixedPoint system = random_system(80, 6, reflectance);
        const std::vector<Spectrum> found = solve(system);
        ASSERT_EQ(found.size(), 80u);
        for (int c = 0; c < 3; ++c) {
            const std::vector<double> expected = eliminated(system, c);
            const double largest = *std::max_element(expected.begin(), expected.end());
            for (std::size_t i = 0; i < expected.size(); ++i)
                EXPECT_NEAR(found[i][c], expected[i], 1e-6 * largest) << c << ' ' << i;
        }
    }
}

/// Rows that all sum to the reflectance and the same light everywhere: x = known / (1 - reflectance).
TEST(FixedPoint, AUniformEnclosureIsTheGeometricSeriesAtAnyReflectance)
{
    for (const double absorbed : {0.5, 1e-1, 1e-3, 1e-6}) {
        FixedPoint system = random_system(300, 10, Spectrum::grey(1 - absorbed));
        std::fill(system.known.begin(), system.known.end(), Spectrum::grey(2));
        for (const Spectrum& x : solve(system))
            EXPECT_NEAR(x.g * absorbed / 2, 1, 1e-8) << absorbed;
    }
}

/// Uneven light in a nearly white enclosure: checked by what is left, x - known - weights x.
TEST(FixedPoint, NearlyWhiteEnclosuresAreSolvedToTheStatedResidual)
{
    for (const double absorbed : {1e-3, 1e-6}) {
        const FixedPoint system = random_system(300, 10, Spectrum::grey(1 - absorbed));
        const std::vector<Spectrum> x = solve(system);
        double squares = 0, known = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            double left = x[i].g - system.known[i].g;
            for (const Dependence& d : system.rows[i])
                left -= d.weight.g * x[d.unknown].g;
            squares += left * left;
            known += system.known[i].g * system.known[i].g;
        }
        // The light is 1 / absorbed times what is known: that many digits are lost.
        EXPECT_LT(std::sqrt(squares / known), std::max(1e-9, 1e-14 / absorbed)) << absorbed;
    }
}

TEST(FixedPoint, WithoutReflectionTheAnswerIsWhatIsKnown)
{
    FixedPoint system = random_system(20, 3, Spectrum::grey(0));
    const std::vector<Spectrum> x = solve(system);
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_EQ(x[i], system.known[i]);
}

TEST(FixedPoint, DarknessStaysDarkAndNothingIsSolvedByNothing)
{
    FixedPoint system = random_system(20, 3, Spectrum::grey(0.999));
    std::fill(system.known.begin(), system.known.end(), Spectrum{});
    for (const Spectrum& x : solve(system))
        EXPECT_TRUE(x.is_black());
    EXPECT_TRUE(solve({}).empty());
}

TEST(FixedPoint, DependencesOnTheSameUnknownAddUp)
{
    std::vector<Dependence> row{{5, Spectrum::grey(1)}, {2, {1, 2, 3}}, {5, Spectrum::grey(2)}, {2, {4, 5, 6}}};
    merge_dependences(row);
    ASSERT_EQ(row.size(), 2u);
    EXPECT_EQ(row[0].unknown, 2u);
    EXPECT_EQ(row[0].weight, (Spectrum{5, 7, 9}));
    EXPECT_EQ(row[1].unknown, 5u);
    EXPECT_EQ(row[1].weight, Spectrum::grey(3));
    std::vector<Dependence> none;
    merge_dependences(none);
    EXPECT_TRUE(none.empty());
}

} // namespace
} // namespace lightwell
