#include "engine/base/errors.h"
#include "materials/photometry.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

std::string ies(const std::string& angles_and_candela, const std::string& type = "1")
{
    std::string text = "IESNA:LM-63-2002\n[LUMINAIRE] test\nTILT=NONE\n1 1000 1 ";
    text.append(angles_and_candela, 0, 3).append(" ").append(type).append(" 2 0.3 1.2 0.1\n1 1 20\n");
    return text.append(angles_and_candela, 3);
}

Photometry parsed(const std::string& text)
{
    Report report;
    return looks_like_ies(text) ? parse_ies(text, "lamp.ies", report) : parse_eulumdat(text, "lamp.ldt", report);
}

std::string complaint(const std::string& text)
{
    try {
        parsed(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Photometry, AUniformSphereOf100CandelaGives400PiLumens)
{
    // Constant intensity I over the sphere: 4 pi I; types A and B measure half a sphere.
    EXPECT_NEAR(parsed(ies("2 1\n0 180\n0\n100 100\n")).lumens(), 400 * pi, 1e-9);
    for (const char* type : {"2", "3"}) {
        EXPECT_NEAR(parsed(ies("2 2\n-90 90\n-90 90\n100 100 100 100\n", type)).lumens(), 200 * pi, 1e-9);
        EXPECT_NEAR(parsed(ies("2 2\n0 90\n0 90\n100 100 100 100\n", type)).lumens(), 200 * pi, 1e-9);
    }
}

TEST(Photometry, ALambertianPanelGivesPiTimesItsIntensityAtTheNadir)
{
    std::string angles, candela;
    for (int angle = 0; angle <= 90; ++angle) {
        angles += std::to_string(angle) + ' ';
        candela += std::to_string(1000 * std::cos(angle * pi / 180)) + ' ';
    }
    std::string text = "TILT=NONE\n1 -1 1 91 1 1 2 .6 .6 0\n1 1 36\n";
    text.append(angles).append("\n0\n").append(candela);
    const Photometry panel = parsed(text);
    EXPECT_NEAR(panel.lumens(), 1000 * pi, 1000 * pi * 1e-4); // chords of the cosine, one degree wide
    EXPECT_NEAR(panel.candela_towards({0, 0, -1}), 1000, 1e-9);
    EXPECT_NEAR(panel.candela_towards(normalized(Vec3{1, 0, -1})), 1000 * std::sqrt(0.5), 1e-3);
    EXPECT_EQ(panel.candela_towards({0, 0, 1}), 0);
    EXPECT_EQ(panel.lamp_lumens, 0) << "absolute";
}

TEST(Photometry, EachSymmetryFillsTheFullTurn)
{
    // Planes 0, 45 and 90 of one quarter; the same distribution as one half, the other half, and a full turn.
    const std::string quarter = ies("2 3\n0 180\n0 45 90\n10 10 20 20 40 40\n");
    const std::string half = ies("2 5\n0 180\n0 45 90 135 180\n10 10 20 20 40 40 20 20 10 10\n");
    const std::string other_half = ies("2 5\n0 180\n90 135 180 225 270\n40 40 20 20 10 10 20 20 40 40\n");
    const std::string turn =
        ies("2 9\n0 180\n0 45 90 135 180 225 270 315 360\n10 10 20 20 40 40 20 20 10 10 20 20 40 40 20 20 10 10\n");
    const std::string open_turn =
        ies("2 8\n0 180\n0 45 90 135 180 225 270 315\n10 10 20 20 40 40 20 20 10 10 20 20 40 40 20 20\n");
    for (const std::string& text : {quarter, half, other_half, turn, open_turn}) {
        const Photometry lamp = parsed(text);
        EXPECT_NEAR(lamp.lumens(), parsed(turn).lumens(), 1e-9);
        for (int degrees = 0; degrees < 360; degrees += 15) {
            const double angle = degrees * pi / 180;
            const Direction towards{std::cos(angle), std::sin(angle), 0};
            EXPECT_NEAR(lamp.candela_towards(towards), parsed(turn).candela_towards(towards), 1e-9) << degrees;
        }
    }
}

TEST(Photometry, DamageIsNamedWithFileAndLine)
{
    EXPECT_NE(complaint("TILT=NONE\n1 1000 1 2").find("lamp.ies:2: the file ends before the number of horizontal"),
              std::string::npos);
    EXPECT_NE(complaint(ies("2 1\n0 90\n0\n100 abc\n")).find("a candela value is \"abc\", expected a number"),
              std::string::npos);
    EXPECT_NE(complaint(ies("2 1\n90 0\n0\n100 100\n")).find("expected ascending angles"), std::string::npos);
    EXPECT_NE(complaint(ies("2 2\n0 90\n0 77\n1 1 1 1\n")).find("planes from 0 to 77"), std::string::npos);
    EXPECT_NE(complaint(ies("2 1\n0 90\n0\n100 -1\n")).find("expected at least 0"), std::string::npos);
    EXPECT_NE(complaint(ies("9e91\n0 90\n0\n100 1\n")).find("expected 2 to 10000"), std::string::npos);
    EXPECT_NE(complaint("ACME\n1\n7\n").find("lamp.ldt:3: the symmetry is \"7\", expected 0 to 4"), std::string::npos);
    EXPECT_NE(complaint("").find("the file ends"), std::string::npos);
    EXPECT_FALSE(complaint(std::string("TILT=NONE\n") + std::string(1000, '1')).empty());
}

/// Files of every kind and symmetry, their flux summed by the script that made them.
TEST(Photometry, FilesOfEveryKindGiveTheLumensOfTheirTables)
{
    const std::filesystem::path folder = LIGHTWELL_ROOT "/tests/fixtures/photometry";
    const auto truth = nlohmann::json::parse(std::ifstream(folder / "truth.json"))["lumens"];
    EXPECT_EQ(truth.size(), 10U);
    for (const auto& [file, lumens] : truth.items()) {
        SCOPED_TRACE(file);
        Report report;
        EXPECT_NEAR(read_photometry(folder / file, report).lumens(), lumens.get<double>(), 5e-4 * lumens.get<double>());
        EXPECT_TRUE(report.notes().empty());
    }
}

/// Any part of a file, and any byte replaced, is answered with a message or read.
TEST(Photometry, CutAndChangedFilesNeverDoHarm)
{
    for (const char* name : {"tilted_box.ies", "type_b.ies", "c90.ldt"}) {
        std::ifstream stream(std::filesystem::path(LIGHTWELL_ROOT "/tests/fixtures/photometry") / name);
        const std::string whole{std::istreambuf_iterator<char>(stream), {}};
        for (std::size_t i = 0; i < whole.size(); ++i) {
            complaint(whole.substr(0, i));
            for (const char c : {'-', '9', 'e', '\n', '\0'}) {
                std::string changed = whole;
                changed[i] = c;
                complaint(changed);
            }
        }
        EXPECT_FALSE(complaint(whole.substr(0, whole.size() / 2)).empty());
    }
}

/// Real files, with the flux that independent scripts integrated from them.
TEST(Photometry, RealFilesGiveTheLumensOfTheirManifestWithinHalfAPercent)
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder =
        std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / "fixtures/photometry";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no luminaires beside the repository";
    const auto manifest = nlohmann::json::parse(std::ifstream(folder / "MANIFEST.json"));
    int checked = 0;
    for (const auto& entry : manifest["entries"]) {
        const std::string file = entry["file"];
        const auto& truth = entry["ground_truth"];
        SCOPED_TRACE(file);
        Report report;
        if (truth.contains("integrated_lumens")) {
            const double wanted = truth["integrated_lumens"];
            EXPECT_NEAR(read_photometry(folder / file, report).lumens(), wanted, 0.005 * wanted);
            ++checked;
        } else if (truth.contains("integrated_flux_per_1000lm")) {
            const Photometry lamp = read_photometry(folder / file, report);
            // The manifest's sum gives every plane the same weight. Of this file the planes lie at uneven angles, and
            // the laboratory states what leaves the luminaire: 84.42 % of its lamps' light.
            const bool uneven = file.ends_with("road_luminaire.ldt");
            const double per_1000_lm = uneven ? 844.2 : truth["integrated_flux_per_1000lm"].get<double>();
            const double wanted = per_1000_lm * lamp.lamp_lumens / 1000;
            EXPECT_NEAR(lamp.lumens(), wanted, 0.005 * wanted);
            ++checked;
        }
    }
    EXPECT_GE(checked, 40);
}

} // namespace
} // namespace lightwell
