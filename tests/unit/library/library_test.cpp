#include "engine/base/text.h"
#include "materials/library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace lightwell {
namespace {

const Material& named(const std::string& name)
{
    const LibraryMaterial* entry = find_in_library(name);
    EXPECT_NE(entry, nullptr) << name;
    static const Material none = Plastic{};
    return entry ? entry->material : none;
}

TEST(Library, HasAtLeastSixtyMaterialsOfEveryKindThatArchitectsUse)
{
    EXPECT_GE(material_library().size(), 60u);
    std::map<std::string, int> kinds;
    for (const LibraryMaterial& entry : material_library())
        ++kinds[type_name(entry.material)];
    for (const auto& [kind, least] : std::map<std::string, int>{
             {"plastic", 40}, {"metal", 8}, {"glass", 6}, {"trans", 5}, {"light", 6}, {"mirror", 1}})
        EXPECT_GE(kinds[kind], least) << kind;
}

TEST(Library, EveryEntryIsValidNamedOnceDescribedAndSourced)
{
    std::set<std::string> names;
    for (const LibraryMaterial& entry : material_library()) {
        SCOPED_TRACE(entry.name);
        EXPECT_NO_THROW(validate_material(entry.material, entry.name));
        EXPECT_TRUE(names.insert(entry.name).second) << "twice";
        EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
        EXPECT_GE(entry.description.size(), 5u);
        EXPECT_GE(entry.source.size(), 20u);
        EXPECT_NE(entry.source.find_first_of("0123456789"), std::string::npos) << "no number: " << entry.source;
    }
}

TEST(Library, CompiledTextIsTheTextInTheRepository)
{
    std::string text;
    for (const char* file : {"emitters", "glazing", "metals", "outdoors", "surfaces"}) {
        std::ifstream in(std::string(LIGHTWELL_ROOT "/materials/library/") + file + ".toml");
        ASSERT_TRUE(in) << file;
        std::stringstream content;
        content << in.rdbuf();
        text += content.str();
    }
    std::size_t entries = 0;
    for (std::size_t at = text.find("[[material]]"); at != std::string::npos; at = text.find("[[material]]", at + 1))
        ++entries;
    EXPECT_EQ(material_library().size(), entries);
}

TEST(Library, OpaqueMaterialsReflectWhatTheirSourceStates)
{
    // The stated number is the luminous reflectance, highlight included: the diffuse part is colour * (1 -
    // specularity).
    const std::map<std::string, double> stated{
        {"grey_50", 0.5},  {"white_paint", 0.8}, {"red_brick", 0.2}, {"generic_ceiling", 0.7},
        {"concrete", 0.3}, {"ground", 0.2},      {"oak", 0.35},      {"grass", 0.06},
        {"black", 0}};
    for (const auto& [name, reflectance] : stated) {
        SCOPED_TRACE(name);
        const auto& plastic = std::get<Plastic>(named(name));
        EXPECT_NEAR(photopic(plastic.colour) * (1 - plastic.specularity) + plastic.specularity, reflectance, 1e-12);
    }
    const auto& gloss = std::get<Plastic>(named("white_gloss_paint"));
    EXPECT_NEAR(photopic(gloss.colour) * 0.96 + 0.04, 0.80, 1e-12);
    EXPECT_NEAR(photopic(std::get<Metal>(named("copper")).colour), 0.69, 1e-12);
}

TEST(Library, CopperHasTheColourOfItsOpticalConstants)
{
    // Johnson and Christy 1972: n, k at 2.01, 2.26 and 2.75 eV; R = ((n-1)^2 + k^2) / ((n+1)^2 + k^2).
    const auto normal = [](double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
    const Spectrum colour = std::get<Metal>(named("copper")).colour;
    EXPECT_NEAR(colour.r, normal(0.30, 3.205), 0.01);
    EXPECT_NEAR(colour.g, normal(1.02, 2.577), 0.01);
    EXPECT_NEAR(colour.b, normal(1.24, 2.397), 0.01);
}

TEST(Library, GlazingTransmitsWhatItsSourceStatesAtNormalIncidence)
{
    // T = (1 - r)^2 t / (1 - r^2 t^2) with r = ((n - 1) / (n + 1))^2: two faces and all reflections between them.
    for (const auto& [name, transmittance] : std::map<std::string, double>{{"glass_single_clear", 0.88},
                                                                           {"glass_double_clear", 0.79},
                                                                           {"glass_triple_low_e", 0.60},
                                                                           {"glass_tinted_grey", 0.46},
                                                                           {"acrylic_clear", 0.92}}) {
        SCOPED_TRACE(name);
        const auto& glass = std::get<Glass>(named(name));
        const double r = std::pow((glass.index - 1) / (glass.index + 1), 2), t = glass.transmissivity.g;
        EXPECT_NEAR((1 - r) * (1 - r) * t / (1 - r * r * t * t), transmittance, 1e-12);
    }
    // The Radiance manual's conversion for index 1.52, as a second way to the same number.
    const double T = 0.88;
    const double tn = (std::sqrt(.8402528435 + .0072522239 * T * T) - .9166530661) / .0036261119 / T;
    EXPECT_NEAR(std::get<Glass>(named("glass_single_clear")).transmissivity.g, tn, 1e-6);
}

TEST(Library, TranslucentMaterialsShareReflectionAndTransmissionAsStated)
{
    for (const auto& [name, rho, tau] :
         std::vector<std::tuple<std::string, double, double>>{{"blind_white", 0.6, 0.2},
                                                              {"glass_opal", 0.45, 0.45},
                                                              {"leaf", 0.08, 0.06},
                                                              {"membrane_white", 0.72, 0.12}}) {
        SCOPED_TRACE(name);
        const auto& trans = std::get<Trans>(named(name));
        const double colour = photopic(trans.colour) * (1 - trans.specularity);
        EXPECT_NEAR(colour * trans.transmission, tau, 1e-12);
        EXPECT_NEAR(colour * (1 - trans.transmission) + trans.specularity, rho, 1e-12);
    }
}

TEST(Library, EmittersHaveTheLuminanceInTheirName)
{
    for (const auto& [name, luminance] : std::map<std::string, double>{{"led_panel_2000cd", 2000},
                                                                       {"led_panel_4000cd", 4000},
                                                                       {"led_panel_8000cd", 8000},
                                                                       {"screen", 250},
                                                                       {"exit_sign", 200}})
        EXPECT_NEAR(luminance_of(emitted_radiance(named(name))).value, luminance, 1e-9) << name;
    // Lumens of a diffuse tube: L pi^2 d l.
    EXPECT_NEAR(luminance_of(emitted_radiance(named("fluorescent_t8"))).value * pi * pi * 0.026 * 1.2, 3350, 20);
    EXPECT_NEAR(luminance_of(emitted_radiance(named("fluorescent_t5"))).value * pi * pi * 0.016 * 1.15, 2600, 20);
}

TEST(Library, StatedRangesHoldTheStatedValues)
{
    for (const LibraryMaterial& entry : material_library()) {
        const std::size_t at = entry.source.find("range ");
        const std::size_t close = entry.source.find(')');
        if (at == std::string::npos || close == std::string::npos || close < at)
            continue;
        SCOPED_TRACE(entry.name + ": " + entry.source);
        const auto numbers = split(std::string_view(entry.source).substr(at + 6, close - at - 6));
        ASSERT_EQ(numbers.size(), 3u);
        const double low = *parse_double(numbers[0]), high = *parse_double(numbers[2]);
        EXPECT_LT(low, high);
        // Emitters, glass and sheets state the range of luminance or transmittance, all others that of reflectance.
        const auto words = split(std::string_view(entry.source).substr(0, at), " ,(");
        bool inside = false;
        for (const std::string_view word : words)
            if (const auto value = parse_double(word))
                inside = inside || (*value >= low && *value <= high);
        EXPECT_TRUE(inside);
    }
}

TEST(Library, UnknownNamesFindTheirNeighbours)
{
    EXPECT_EQ(find_in_library("white_pant"), nullptr);
    EXPECT_EQ(nearest_names("white_pant").at(0), "white_paint");
    EXPECT_EQ(nearest_names("conrete").at(0), "concrete");
    EXPECT_EQ(nearest_names("Glass-Double-Clear").at(0), "glass_double_clear");
    EXPECT_EQ(nearest_names("x", 5).size(), 5u);
    EXPECT_EQ(nearest_names(std::string(100000, 'a'), 2).size(), 2u);
}

} // namespace
} // namespace lightwell
