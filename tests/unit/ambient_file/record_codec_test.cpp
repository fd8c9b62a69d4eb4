#include "engine/ambient/record_codec.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightwell {
namespace {

AmbientSite site(double x)
{
    AmbientSite site;
    site.position = {x, -2.25, 1e6};
    site.normal = {0, 0.6, 0.8};
    site.axis = {1, 0, 0};
    site.reach_m[0] = 0.125 + x;
    site.reach_m[1] = 0.25;
    site.harmonic_m = 3.5;
    site.horizon[3] = {0.75F, 0.6F, -0.8F, 1.25F};
    site.least_horizon_m = 0.75;
    return site;
}

std::vector<AmbientRecord> some_records()
{
    std::vector<AmbientRecord> records(3);
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto x = static_cast<double>(i);
        records[i].site = site(x);
        records[i].irradiance = {1.0 / 3, x, 5e-300};
        for (int c = 0; c < 3; ++c) {
            records[i].gradient.translation[c] = {x, -0.5, c + 0.1};
            records[i].gradient.rotation[c] = {-x, 0.25, c - 7.0};
        }
        for (std::size_t r = 0; r < replicates; ++r)
            records[i].deviation[r] = 0.1F * static_cast<float>(r) - 0.3F;
    }
    return records;
}

DeepSolution some_field()
{
    DeepSolution deep;
    for (int i = 0; i < 4; ++i) {
        deep.sites.push_back(site(i));
        for (std::size_t r = 0; r < replicates; ++r)
            deep.ambient[r].push_back({1.0 + i, static_cast<double>(r), 0});
        deep.direct.push_back({0.1 * i, 0.2, 0.3});
        deep.tested_share.push_back(0.25 * (1 + i));
        deep.lit_W_per_m2.push_back(10.0 * i);
        deep.visits.push_back(0.5 + i);
    }
    return deep;
}

void expect_same(const AmbientSite& a, const AmbientSite& b)
{
    EXPECT_EQ(a.position.x, b.position.x);
    EXPECT_EQ(a.position.z, b.position.z);
    EXPECT_EQ(a.normal.y, b.normal.y);
    EXPECT_EQ(a.axis.x, b.axis.x);
    EXPECT_EQ(a.reach_m[0], b.reach_m[0]);
    EXPECT_EQ(a.reach_m[1], b.reach_m[1]);
    EXPECT_EQ(a.harmonic_m, b.harmonic_m);
    EXPECT_EQ(a.least_horizon_m, b.least_horizon_m);
    for (std::size_t i = 0; i < a.horizon.size(); ++i) {
        EXPECT_EQ(a.horizon[i].distance_m, b.horizon[i].distance_m);
        EXPECT_EQ(a.horizon[i].into_x, b.horizon[i].into_x);
        EXPECT_EQ(a.horizon[i].into_y, b.horizon[i].into_y);
        EXPECT_EQ(a.horizon[i].met_m, b.horizon[i].met_m);
    }
}

TEST(RecordCodec, RecordsComeBackWithTheSameBits)
{
    const std::vector<AmbientRecord> records = some_records();
    const std::vector<double> numbers = encode_records(records);
    ASSERT_EQ(numbers.size(), records.size() * numbers_in_record);
    const auto back = decode_records(numbers);
    ASSERT_TRUE(back);
    ASSERT_EQ(back->size(), records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        expect_same((*back)[i].site, records[i].site);
        EXPECT_EQ((*back)[i].irradiance, records[i].irradiance);
        EXPECT_EQ((*back)[i].deviation, records[i].deviation);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ((*back)[i].gradient.translation[c].z, records[i].gradient.translation[c].z);
            EXPECT_EQ((*back)[i].gradient.rotation[c].x, records[i].gradient.rotation[c].x);
        }
    }
}

TEST(RecordCodec, DeepFieldsComeBackWithTheSameBits)
{
    const DeepSolution deep = some_field();
    const std::vector<double> numbers = encode_deep(deep);
    ASSERT_EQ(numbers.size(), deep.sites.size() * numbers_in_deep_site);
    const auto back = decode_deep(numbers);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->ambient, deep.ambient);
    EXPECT_EQ(back->direct, deep.direct);
    EXPECT_EQ(back->tested_share, deep.tested_share);
    EXPECT_EQ(back->lit_W_per_m2, deep.lit_W_per_m2);
    EXPECT_EQ(back->visits, deep.visits);
    for (std::size_t i = 0; i < deep.sites.size(); ++i)
        expect_same(back->sites[i], deep.sites[i]);
}

TEST(RecordCodec, NumbersThatAreNoRecordsAreNotTaken)
{
    const std::vector<double> sound = encode_records(some_records());
    EXPECT_FALSE(decode_records(std::span(sound).first(sound.size() - 1)));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    // Position, normal, axis, reach, harmonic distance, irradiance, a gradient, a deviation.
    for (const std::size_t at : {0, 3, 6, 9, 11, 77, 83, 105})
        for (const double bad : {nan, infinite}) {
            std::vector<double> numbers = sound;
            numbers[at] = bad;
            EXPECT_FALSE(decode_records(numbers)) << at << " is " << bad;
        }
    for (const auto& [at, bad] : {std::pair{5, 0.1}, {9, 0.0}, {10, -1.0}, {11, 0.0}, {12, -1.0}, {13, nan}}) {
        std::vector<double> numbers = sound;
        numbers[static_cast<std::size_t>(at)] = bad;
        EXPECT_FALSE(decode_records(numbers)) << at << " is " << bad;
    }
}

TEST(RecordCodec, NumbersThatAreNoDeepFieldAreNotTaken)
{
    const std::vector<double> sound = encode_deep(some_field());
    EXPECT_FALSE(decode_deep({}));
    EXPECT_FALSE(decode_deep(std::span(sound).first(numbers_in_record - 2)));
    for (const double bad : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<double> numbers = sound;
        numbers[numbers_in_deep_site - 3] = bad; // how often the first site is tested
        EXPECT_FALSE(decode_deep(numbers)) << bad;
    }
}

TEST(RecordCodec, AFieldTooLargeForOneBlockIsNotKept)
{
    DeepSolution deep;
    const std::size_t sites = most_numbers_in_block / numbers_in_deep_site + 1;
    deep.sites.resize(sites);
    EXPECT_TRUE(encode_deep(deep).empty());
}

} // namespace
} // namespace lightwell
