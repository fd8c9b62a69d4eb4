#include "engine/sources/lamp_tree.h"

#include "engine/base/random.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Direction direction(RandomStream& random)
{
    return uniform_sphere(random.square());
}

struct Lamps {
    std::vector<Material> materials;
    std::vector<LocalSource> all;
};

/// Discs, spheres and spotlights of all strengths and directions in a box, moved and scaled.
Lamps many_lamps(std::size_t count, double scale = 1, const Vec3& offset = {})
{
    Lamps lamps;
    lamps.materials.reserve(count);
    RandomStream random(3);
    for (std::size_t i = 0; i < count; ++i) {
        const Point at = offset + Vec3{random.next(), random.next(), random.next()} * (10 * scale);
        const double radius = (0.01 + 0.1 * random.next()) * scale;
        const Spectrum radiance = Spectrum::grey(std::exp(3 * random.next()));
        const Direction axis = direction(random);
        if (i % 3 == 0)
            lamps.materials.emplace_back(Spotlight{radiance, 20 + 100 * random.next(), axis * 1e-6});
        else
            lamps.materials.emplace_back(Light{radiance});
        if (i % 3 == 1)
            lamps.all.emplace_back(SphereEmitter{{at, radius}}, lamps.materials.back());
        else
            lamps.all.emplace_back(RingEmitter{{at, axis, 0, radius}}, lamps.materials.back());
    }
    return lamps;
}

Receiver receiver_in(RandomStream& random, double scale = 1, const Vec3& offset = {})
{
    const Point at = offset + Vec3{random.next(), random.next(), random.next()} * (12 * scale);
    return {at, direction(random), random.next() < 0.3};
}

TEST(LampTree, ChoosesEachLampAsOftenAsItSays)
{
    const Lamps lamps = many_lamps(60);
    const LampTree tree(lamps.all);
    RandomStream random(4);
    for (int k = 0; k < 10; ++k) {
        const Receiver receiver = receiver_in(random);
        constexpr int numbers = 200000;
        std::vector<double> found(lamps.all.size());
        for (int i = 0; i < numbers; ++i) {
            const LampTree::Chosen c = tree.choose(receiver, (i + 0.5) / numbers);
            if (c.lamp < 0)
                continue;
            found[static_cast<std::size_t>(c.lamp)] += 1.0 / numbers;
            ASSERT_NEAR(c.probability, tree.probability(c.lamp, receiver), 1e-12);
        }
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], tree.probability(static_cast<int>(i), receiver), 3e-5) << i;
    }
}

TEST(LampTree, NeverLeavesOutALampThatCanGiveLight)
{
    for (const double scale : {1e-12, 1.0, 1e12}) {
        const Vec3 offset = Vec3{1e5, -2e5, 3e4} * scale;
        const Lamps lamps = many_lamps(500, scale, offset);
        const LampTree tree(lamps.all);
        RandomStream random(5);
        for (int k = 0; k < 200; ++k) {
            const Receiver receiver = receiver_in(random, scale, offset);
            for (std::size_t i = 0; i < lamps.all.size(); ++i) {
                if (!lamps.all[i].sample(receiver.at, {0.5, 0.5}).radiance.is_black() &&
                    lamps.all[i].potential(receiver.at, receiver.normal, receiver.transmits) > 0) {
                    ASSERT_GT(tree.probability(static_cast<int>(i), receiver), 0) << "lamp " << i << " scale " << scale;
                }
            }
        }
    }
}

/// The groups' lamps, each divided by its probability, add up to all lamps on average over the random number.
TEST(LampTree, TheCutStandsForAllLamps)
{
    const Lamps lamps = many_lamps(400);
    const LampTree tree(lamps.all);
    RandomStream random(6);
    for (int k = 0; k < 5; ++k) {
        const Receiver receiver = receiver_in(random);
        const auto potential = [&](std::size_t i) {
            return lamps.all[i].potential(receiver.at, receiver.normal, receiver.transmits);
        };
        double expected = 0, mean = 0;
        for (std::size_t i = 0; i < lamps.all.size(); ++i)
            expected += potential(i);
        std::vector<LampTree::Representative> found;
        constexpr int numbers = 20000;
        for (int i = 0; i < numbers; ++i) {
            tree.cut(receiver, 40, random.next(), found);
            ASSERT_LE(found.size(), 41u);
            for (const LampTree::Representative& r : found)
                mean += potential(static_cast<std::size_t>(r.lamp)) / (r.probability * numbers);
        }
        EXPECT_NEAR(mean, expected, 0.01 * expected);
    }
}

TEST(LampTree, AWideCutHoldsEveryLampOnce)
{
    const Lamps lamps = many_lamps(100);
    const LampTree tree(lamps.all);
    std::vector<LampTree::Representative> found;
    tree.cut({{5, 5, 5}, {0, 0, 1}, true}, 1000, 0.5, found);
    std::vector<int> times(lamps.all.size());
    for (const LampTree::Representative& r : found) {
        EXPECT_EQ(r.probability, 1);
        ++times[static_cast<std::size_t>(r.lamp)];
    }
    for (std::size_t i = 0; i < times.size(); ++i)
        EXPECT_EQ(times[i], lamps.all[i].potential({5, 5, 5}, {0, 0, 1}, true) > 0 ? 1 : std::min(times[i], 1)) << i;
}

TEST(LampTree, OfNoLampsChoosesNone)
{
    const LampTree tree({});
    EXPECT_EQ(tree.choose({{0, 0, 0}, {0, 0, 1}, false}, 0.5).lamp, -1);
    std::vector<LampTree::Representative> found;
    tree.cut({{0, 0, 0}, {0, 0, 1}, false}, 10, 0.5, found);
    EXPECT_TRUE(found.empty());
}

} // namespace
} // namespace lightwell
