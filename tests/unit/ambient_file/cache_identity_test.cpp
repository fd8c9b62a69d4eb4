#include "engine/ambient/cache_identity.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

CacheIdentity office()
{
    CacheIdentity identity;
    identity.add_fingerprint("geometry", 0x1234);
    identity.add_fingerprint("material grey wall", 7);
    identity.add_setting("ambient accuracy", "0.1");
    return identity;
}

TEST(CacheIdentity, NothingDiffersWhateverTheOrder)
{
    CacheIdentity turned = office();
    std::swap(turned.lines.front(), turned.lines.back());
    EXPECT_EQ(differences(office(), turned), "");
    EXPECT_EQ(fingerprint(office()), fingerprint(turned));
}

TEST(CacheIdentity, AChangedFingerprintIsNamedAndAChangedSettingShown)
{
    CacheIdentity other;
    other.add_fingerprint("geometry", 0x1235);
    other.add_fingerprint("material grey wall", 7);
    other.add_setting("ambient accuracy", "0.05");
    EXPECT_EQ(differences(office(), other), "ambient accuracy was 0.1, is 0.05; geometry changed");
    EXPECT_NE(fingerprint(office()), fingerprint(other));
}

TEST(CacheIdentity, NewAndGoneLinesAreNamed)
{
    CacheIdentity other = office();
    other.lines.erase(other.lines.begin() + 1);
    other.add_fingerprint("material oak", 1);
    EXPECT_EQ(differences(office(), other), "material oak is new; material grey wall is gone");
}

TEST(CacheIdentity, ALongListOfDifferencesIsCounted)
{
    CacheIdentity many;
    for (int i = 0; i < 1000; ++i)
        many.add_fingerprint("material m" + std::to_string(i), 1);
    EXPECT_TRUE(differences({}, many).ends_with("; and 994 more")) << differences({}, many);
}

TEST(CacheIdentity, NamesWithBlanksBreaksAndPercentSignsSurviveTheText)
{
    CacheIdentity odd;
    odd.add_setting("layer 100 %\nof it", "a = b\nc");
    odd.add_setting("empty", "");
    EXPECT_EQ(differences(odd, parse_cache_identity(to_text(odd))), "");
    EXPECT_EQ(fingerprint(odd), fingerprint(parse_cache_identity(to_text(odd))));
    const CacheIdentity read = parse_cache_identity(to_text(odd));
    ASSERT_EQ(read.lines.size(), 2u);
    EXPECT_EQ(read.lines[1].first, "layer 100 %\nof it");
    EXPECT_EQ(read.lines[1].second, "a = b c");
}

TEST(CacheIdentity, TwoModifiersOfOneNameBothCount)
{
    CacheIdentity one, two;
    for (CacheIdentity* identity : {&one, &two})
        identity->add_fingerprint("material wall", 1);
    one.add_fingerprint("material wall", 2);
    two.add_fingerprint("material wall", 3);
    EXPECT_EQ(differences(one, two), "material wall changed");
}

} // namespace
} // namespace lightwell
