#include "engine/ambient/site_tree.h"
#include "engine/base/frame.h"
#include "engine/sampling/path_random.h"
#include "engine/sampling/warps.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Point random_point(PathRandom& random)
{
    const UnitSquare u = random.pair();
    return {u.u, u.v, random.one()};
}

/// Sites in a cube: reaches from a thousandth of it to half of it, more small ones than large ones.
std::vector<AmbientSite> random_sites(std::uint32_t count, double scale, const Vec3& offset)
{
    std::vector<AmbientSite> sites;
    for (std::uint32_t i = 0; i < count; ++i) {
        PathRandom random(7, 1, i);
        AmbientSite site;
        site.position = random_point(random) * scale + offset;
        const double z = 2 * random.one() - 1, turn = 2 * pi * random.one();
        site.normal = {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
        site.axis = frame_about(site.normal).x;
        site.reach_m[0] = scale * 0.5 * std::pow(1e-3, random.one());
        site.reach_m[1] = site.reach_m[0] * (1 + 2 * random.one());
        sites.push_back(site);
    }
    return sites;
}

std::vector<std::uint32_t> visited(const SiteTree& tree, const Point& at)
{
    std::vector<std::uint32_t> found;
    tree.near(at, [&](std::uint32_t i) { found.push_back(i); });
    return found;
}

/// Places at which sites are asked for: on them, within their reach in their plane, and anywhere.
Point query(const std::vector<AmbientSite>& sites, std::uint32_t n, double scale, const Vec3& offset)
{
    PathRandom random(8, 2, n);
    if (n % 3 == 0)
        return random_point(random) * scale + offset;
    const AmbientSite& site = sites[n % sites.size()];
    const double turn = 2 * pi * random.one(), way = n % 3 == 1 ? 0 : random.one();
    const Vec3 across = cross(site.normal, site.axis);
    return site.position +
           (site.axis * (site.reach_m[0] * std::cos(turn)) + across * (site.reach_m[1] * std::sin(turn))) * way;
}

TEST(SiteTree, FindsEverySiteThatBruteForceFindsAtAnyScaleAndPlace)
{
    struct Case {
        double scale;
        Vec3 offset;
    };
    for (const Case& c : {Case{1, {0, 0, 0}}, Case{1e-9, {0, 0, 0}}, Case{1e9, {0, 0, 0}}, Case{1, {1e6, -1e6, 1e6}},
                          Case{1e9, {-3e9, 1e9, 0}}}) {
        SCOPED_TRACE(c.scale);
        const std::vector<AmbientSite> sites = random_sites(1500, c.scale, c.offset);
        SiteTree tree;
        tree.build(sites);
        int covering = 0, misses = 0;
        for (std::uint32_t n = 0; n < 1500; ++n) {
            const Point at = query(sites, n, c.scale, c.offset);
            const std::vector<std::uint32_t> found = visited(tree, at);
            for (std::uint32_t i = 0; i < sites.size(); ++i)
                if (site_distance(sites[i], at, sites[i].normal) < 1) {
                    ++covering;
                    misses += std::find(found.begin(), found.end(), i) == found.end();
                }
        }
        EXPECT_EQ(misses, 0);
        EXPECT_GT(covering, 1500) << "too few queries met a site for this to mean anything";
    }
}

TEST(SiteTree, VisitsEachSiteOnceInTheOrderOfIndices)
{
    const std::vector<AmbientSite> sites = random_sites(1500, 1, {});
    SiteTree tree;
    tree.build(sites);
    std::size_t visits = 0;
    for (std::uint32_t n = 0; n < 500; ++n) {
        const std::vector<std::uint32_t> found = visited(tree, query(sites, n, 1, {}));
        for (std::size_t i = 1; i < found.size(); ++i)
            EXPECT_LT(found[i - 1], found[i]);
        visits += found.size();
    }
    // Boxes of up to the size of the cube overlap everywhere; still most sites must be ruled out without a look.
    EXPECT_LT(static_cast<double>(visits) / 500, 0.3 * 1500);
}

TEST(SiteTree, ManySitesInOnePlaceDoNotSplitForEver)
{
    std::vector<AmbientSite> sites = random_sites(1, 1, {});
    sites.resize(2000, sites.front());
    SiteTree tree;
    tree.build(sites);
    EXPECT_EQ(visited(tree, sites[0].position).size(), 2000u);
    for (AmbientSite& site : sites)
        site.reach_m[0] = site.reach_m[1] = 0;
    tree.build(sites);
    EXPECT_EQ(visited(tree, sites[0].position + Vec3{1, 0, 0}).size(), 0u);
}

/// What they have in common ends just above the middle of the tree, so that the nodes there, four times as many at each
/// level, hold all of them and nothing else.
TEST(SiteTree, SmallSitesOnOneAnotherInALargeSceneDoNotSplitForEver)
{
    AmbientSite site;
    site.normal = {0, 0, 1};
    site.axis = {1, 0, 0};
    std::vector<AmbientSite> sites;
    for (const double corner : {-1.0, 1.0}) {
        site.position = {corner, corner, corner};
        sites.push_back(site);
    }
    site.reach_m[0] = site.reach_m[1] = 0.2;
    site.position = {0.3, 0.3, 1e-9 - 0.15 * 0.2}; // 0.15: what a site's box has above it
    sites.resize(20, site);
    SiteTree tree;
    tree.build(sites); // would take hours
    EXPECT_EQ(visited(tree, site.position).size(), 18u);
}

TEST(SiteTree, AnEmptyTreeAndPlacesFarAwayOrNowhereFindNothing)
{
    SiteTree tree;
    EXPECT_TRUE(visited(tree, {0, 0, 0}).empty());
    tree.build({});
    EXPECT_TRUE(visited(tree, {0, 0, 0}).empty());
    tree.build(random_sites(10, 1, {}));
    EXPECT_TRUE(visited(tree, {1e300, 0, 0}).empty());
    EXPECT_TRUE(visited(tree, {std::numeric_limits<double>::quiet_NaN(), 0, 0}).empty());
}

} // namespace
} // namespace lightwell
