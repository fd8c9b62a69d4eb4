#include "engine/ambient/bright_discs.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A floor of 10 x 10 m in so many pieces a side, on which a patch of 2 x 2 m about (3, 3) is a hundred times as
/// bright.
std::vector<BrightDiscs::Lit> lit_floor(int side)
{
    std::vector<BrightDiscs::Lit> pieces;
    const double width = 10.0 / side;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const Point centre{width * (column + 0.5), width * (row + 0.5), 0};
            const bool bright = std::fabs(centre.x - 3) < 1 && std::fabs(centre.y - 3) < 1;
            pieces.push_back({centre, {0, 0, 1}, width / std::sqrt(pi), bright ? 100.0 : 1.0, width * width});
        }
    return pieces;
}

/// Share of the rays from the ceiling that meet the patch, a hand wider.
double share_on_the_patch(const BrightDiscs& discs)
{
    const Point from{5, 5, 3};
    const BrightDiscs::Shares shares = discs.shares(from, {0, 0, -1});
    int hits = 0;
    constexpr int steps = 32;
    for (int i = 0; i < steps * steps; ++i) {
        const SampledDirection d = discs.sample(shares, {(i % steps + 0.5) / steps, (i / steps + 0.5) / steps});
        if (!(d.density_per_sr > 0))
            continue;
        const Point met = from + d.direction * (-from.z / d.direction.z);
        hits += std::fabs(met.x - 3) < 1.3 && std::fabs(met.y - 3) < 1.3 ? 1 : 0;
    }
    return static_cast<double>(hits) / (steps * steps);
}

TEST(BrightDiscs, AimAtABrightPatchHoweverFineThePiecesThatItFallsInto)
{
    for (const int side : {20, 40, 80}) {
        SCOPED_TRACE(side);
        const BrightDiscs discs(lit_floor(side));
        EXPECT_FALSE(discs.empty());
        EXPECT_LE(discs.size(), BrightDiscs::most_discs);
        EXPECT_GT(share_on_the_patch(discs), 0.9);
    }
}

/// A sunlit yard outside is most of the area and has most of the light, but rays from inside seldom meet it.
TEST(BrightDiscs, AreChosenByWhatRaysMeetAndNotByArea)
{
    std::vector<BrightDiscs::Lit> pieces = lit_floor(40);
    EXPECT_FALSE(BrightDiscs(pieces).empty());
    std::vector<BrightDiscs::Lit> yard(4, {{50, 50, 0}, {0, 0, 1}, 20, 100, 0});
    yard.insert(yard.end(), pieces.begin(), pieces.end());
    EXPECT_GT(share_on_the_patch(BrightDiscs(yard)), 0.2) << "never met: it counts for nothing";
    for (std::size_t i = 0; i < 4; ++i)
        yard[i].visits = 25; // half of all
    EXPECT_TRUE(BrightDiscs(yard).empty()) << "met all the time: found without aiming";
}

TEST(BrightDiscs, AreNoneWhereLightIsEvenOrComesFromEverywhere)
{
    std::vector<BrightDiscs::Lit> even = lit_floor(40);
    for (BrightDiscs::Lit& piece : even)
        piece.irradiance = 1;
    EXPECT_TRUE(BrightDiscs(even).empty());
    std::vector<BrightDiscs::Lit> scattered = even; // every third in both directions: joined they cover nearly all
    for (std::size_t i = 0; i < scattered.size(); ++i)
        scattered[i].irradiance = i % 40 % 3 == 0 && i / 40 % 3 == 0 ? 100 : 1;
    EXPECT_TRUE(BrightDiscs(scattered).empty());
    EXPECT_TRUE(BrightDiscs(std::vector<BrightDiscs::Lit>{}).empty());
}

} // namespace
} // namespace lightwell
