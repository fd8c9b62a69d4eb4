/// \file Files of measured scattering: read against an account that other programs made of them, and damaged.
#include "engine/base/errors.h"
#include "engine/base/random.h"
#include "engine/sampling/statistics.h"
#include "materials/measured/angle_basis.h"
#include "materials/measured/measured_table.h"
#include "materials/measured/square_disc.h"
#include "materials/measured/tree_reader.h"
#include "materials/measured_scattering.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

fs::path shared_files()
{
    const char* elsewhere = std::getenv("LIGHTWELL_SHARED");
    return fs::path(elsewhere != nullptr ? elsewhere : LIGHTWELL_ROOT "/../shared") / "fixtures/bsdf";
}

std::string xml_of(const std::string& structure, const std::string& blocks, const std::string& more = {})
{
    return "<?xml version=\"1.0\"?>\n<WindowElement><Optical><Layer><Material><Name>test</Name>"
           "<Thickness unit=\"Millimeter\">25</Thickness></Material>\n<DataDefinition><IncidentDataStructure>" +
           structure + "</IncidentDataStructure>" + more +
           "</DataDefinition>\n<WavelengthData><Wavelength unit=\"Integral\">Visible</Wavelength>\n" + blocks +
           "</WavelengthData></Layer></Optical></WindowElement>\n";
}

std::string block(const std::string& direction, const std::string& basis, const std::string& data)
{
    return "<WavelengthDataBlock><WavelengthDataDirection>" + direction +
           "</WavelengthDataDirection><ColumnAngleBasis>" + basis + "</ColumnAngleBasis><RowAngleBasis>" + basis +
           "</RowAngleBasis>\n<ScatteringData>" + data + "</ScatteringData></WavelengthDataBlock>\n";
}

/// A smooth matrix of a basis, symmetric in both patches.
std::string matrix(int size, double scale)
{
    std::string text;
    for (int o = 0; o < size; ++o)
        for (int i = 0; i < size; ++i)
            text += std::to_string(scale * (1 + 0.5 * std::cos(0.2 * (o + i)))) + (i + 1 == size ? "\n" : ",\t");
    return text;
}

std::string complaint(const std::string& xml)
{
    try {
        MeasuredTable::parse(xml, "test.xml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(MeasuredFiles, AgreeWithTheAccountThatIndependentScriptsMade)
{
    std::ifstream manifest(shared_files() / "MANIFEST.json");
    if (!manifest)
        GTEST_SKIP() << "the measured files are not beside the repository";
    int tables = 0, refused = 0;
    const nlohmann::json account = nlohmann::json::parse(manifest);
    for (const auto& entry : account["entries"]) {
        const std::string name = entry["file"];
        SCOPED_TRACE(name);
        const auto& truth = entry["ground_truth"];
        if (truth.contains("xml_error")) { // a damaged first line, which may be skipped
            EXPECT_NE(MeasuredTable::read(shared_files() / name)->reflection(true), nullptr);
            continue;
        }
        if (truth["block_count"] == 0) {
            EXPECT_THROW(MeasuredTable::read(shared_files() / name), InputError);
            ++refused;
            continue;
        }
        const auto table = MeasuredTable::read(shared_files() / name);
        for (const auto& part : truth["blocks"]) {
            if (part["wavelength"] != "Visible" || part["kind"] != "matrix")
                continue;
            const std::string direction = part["direction"];
            const DirectionTable* found = direction == "Transmission Front"  ? table->transmission(false)
                                          : direction == "Transmission Back" ? table->transmission(true)
                                          : direction == "Reflection Front"  ? table->reflection(false)
                                                                             : table->reflection(true);
            ASSERT_NE(found, nullptr) << direction;
            EXPECT_NEAR(found->hemispherical({}), part["normal_hemispherical_if_row_is_outgoing"].get<double>(), 2e-4)
                << direction;
            ++tables;
        }
        if (truth.contains("thickness") && truth["thickness"].is_array()) {
            const double unit = truth["thickness"][1].get<std::string>()[1] == 'i' ? 1e-3 : 1;
            EXPECT_NEAR(table->about().thickness_m, unit * std::stod(truth["thickness"][0].get<std::string>()), 1e-12);
        }
    }
    EXPECT_GE(tables, 17);
    EXPECT_EQ(refused, 1);
}

TEST(MeasuredFiles, ATreeGivesTheHemisphericalReflectanceOfItsLeaves)
{
    const fs::path file = shared_files() / "t3.xml";
    if (!fs::exists(file))
        GTEST_SKIP() << "the measured files are not beside the repository";
    const auto table = MeasuredTable::read(file);
    for (const double radius : {0.01, 0.3, 0.9}) {
        // Each square cell is the same projected solid angle; the sums of the table against plain values.
        double sum = 0;
        constexpr int side = 128;
        for (int i = 0; i < side * side; ++i)
            sum += table->reflection(true)->value_per_sr({radius, 0},
                                                         disc_of({(i / side + 0.5) / side, (i % side + 0.5) / side}));
        EXPECT_NEAR(table->reflection(true)->hemispherical({radius, 0}), sum * pi / (side * side), 0.02);
    }
}

TEST(SquareAndDisc, AreOneToOneAndKeepAreas)
{
    RandomStream random(2);
    for (int i = 0; i < 2000; ++i) {
        const UnitSquare s = random.square();
        const DiscPoint p = disc_of(s);
        const UnitSquare back = square_of(p);
        EXPECT_NEAR(back.u, s.u, 1e-12);
        EXPECT_NEAR(back.v, s.v, 1e-12);
        // The ring of a square frame: radius is the larger of both distances from the centre.
        EXPECT_NEAR(std::hypot(p.x, p.y), std::max(std::fabs(2 * s.u - 1), std::fabs(2 * s.v - 1)), 1e-12);
    }
}

/// Integral of the density over 12 x 12 squares of the disc's square, and how often samples fall there.
void expect_samples_follow_the_density(const DirectionTable& table, const DiscPoint& in)
{
    constexpr int side = 12, fine = 40, draws = 100000;
    std::vector<double> shares(side * side), counts(side * side);
    for (int i = 0; i < side * fine; ++i)
        for (int j = 0; j < side * fine; ++j)
            shares[static_cast<std::size_t>(i / fine * side + j / fine)] +=
                draws * pi / (side * side * fine * fine) *
                table.density(in, disc_of({(i + 0.5) / (side * fine), (j + 0.5) / (side * fine)}));
    RandomStream random(7);
    for (int i = 0; i < draws; ++i) {
        const double choice = random.next();
        const UnitSquare s = square_of(table.sample(in, choice, random.square()));
        ++counts[static_cast<std::size_t>(static_cast<int>(std::min(s.u, 0.999999) * side) * side +
                                          static_cast<int>(std::min(s.v, 0.999999) * side))];
    }
    double whole = 0;
    for (const double share : shares)
        whole += share;
    EXPECT_NEAR(whole / draws, 1, 0.005);
    EXPECT_GT(chi_square_probability(counts, shares), 1e-7);
}

TEST(MeasuredTables, SamplesFollowTheDensityForBasesAndTrees)
{
    const std::string tree = "{ { 0.15 } { 0.05 } { 0.10 } { 0.20 } { 0.03 } { 0.06 } { 0.11 } "
                             "{ 0.05 0.1 0.15 0.2 0.05 0.05 0.1 0.03 } }";
    const std::string files[] = {
        xml_of("Columns", block("Reflection Back", "LBNL/Klems Quarter", matrix(41, 0.1)) +
                              block("Transmission Back", "LBNL/Klems Full", matrix(145, 0.1))),
        xml_of("TensorTree3", block("Reflection Back", "", tree) + block("Transmission Front", "", tree)),
        xml_of("TensorTree4", block("Reflection Back", "", "{ 0.1 }") + block("Transmission Front", "", "{ 0.2 }"))};
    for (const std::string& file : files) {
        const auto table = MeasuredTable::parse(file, "test.xml");
        for (const DiscPoint in : {DiscPoint{0.01, 0}, DiscPoint{0.3, -0.5}, DiscPoint{-0.9, 0.2}})
            for (const DirectionTable* part :
                 {table->reflection(true), table->transmission(true), table->transmission(false)})
                expect_samples_follow_the_density(*part, in);
    }
}

TEST(MeasuredTables, OneWayThroughTellsTheOtherByReciprocity)
{
    const auto table = MeasuredTable::parse(
        xml_of("Columns", block("Transmission Back", "LBNL/Klems Half", matrix(73, 0.1))), "test.xml");
    RandomStream random(3);
    for (int i = 0; i < 500; ++i) {
        const Direction front = cosine_hemisphere(random.square());
        const Direction up = cosine_hemisphere(random.square()), back{up.x, up.y, -up.z};
        EXPECT_NEAR(table->value_per_sr(front, back), table->value_per_sr(back, front), 1e-15);
        EXPECT_GT(table->value_per_sr(front, back), 0);
    }
}

TEST(MeasuredTables, APeakOfWhatPassesIsToldFromWhatLiesAroundIt)
{
    // Along every direction one patch passes 0.7 of the light, the others a little.
    std::string data;
    const AngleBasis& basis = *AngleBasis::known("LBNL/Klems Full");
    for (int o = 0; o < basis.size(); ++o)
        for (int i = 0; i < basis.size(); ++i)
            data += std::to_string(o == i ? 0.7 / basis.projected_sr(i) + 0.03 : 0.03) + ' ';
    const auto table =
        MeasuredTable::parse(xml_of("Columns", block("Transmission Back", "LBNL/Klems Full", data)), "test.xml");
    for (const DiscPoint in : {DiscPoint{0, 0}, DiscPoint{0.4, 0.1}, DiscPoint{-0.2, 0.8}}) {
        EXPECT_NEAR(table->transmission(true)->peak(in).share, 0.7, 0.01);
        EXPECT_NEAR(table->transmission(true)->peak(in).around_per_sr, 0.03, 1e-6);
        EXPECT_TRUE(table->transmission(true)->within_peak(in, in));
        EXPECT_FALSE(table->transmission(true)->within_peak(in, {-in.x, 0.3 - in.y}));
    }
    std::string even;
    for (int i = 0; i < 41 * 41; ++i)
        even += "0.1 ";
    const auto smooth =
        MeasuredTable::parse(xml_of("Columns", block("Transmission Back", "LBNL/Klems Quarter", even)), "test.xml");
    EXPECT_EQ(smooth->transmission(true)->peak({0.1, 0.2}).share, 0);
}

TEST(MeasuredDamage, EachGivesOneMessageWithItsLine)
{
    const std::string good = xml_of("Columns", block("Reflection Back", "LBNL/Klems Quarter", matrix(41, 0.1)));
    EXPECT_EQ(complaint(good), "");
    const auto says = [](const std::string& xml, const std::string& text) {
        const std::string message = complaint(xml);
        EXPECT_NE(message.find(text), std::string::npos) << message;
        EXPECT_TRUE(message.starts_with("test.xml")) << message;
    };
    says("", "no XML");
    says("<WindowElement>", "no XML");
    says("<a/>", "no WindowElement");
    says(good.substr(0, good.size() / 2), "no XML");
    says(xml_of("Columns", ""), "no scattering data");
    says(xml_of("Spiral", block("Reflection Back", "LBNL/Klems Quarter", "1")), "IncidentDataStructure is \"Spiral\"");
    says(xml_of("Columns", block("Reflection Sideways", "LBNL/Klems Quarter", "1")), "reflection sideways");
    says(xml_of("Columns", block("Reflection Back", "LBNL/Klems Eighth", "1")), "is not known");
    says(xml_of("Columns", block("Reflection Back", "LBNL/Klems Quarter", "1 2 3")), "3 values, expected 1681");
    says(xml_of("Columns", block("Reflection Back", "LBNL/Klems Quarter", "1 nan")), "expected a finite number");
    says(xml_of("TensorTree4", block("Reflection Back", "", "{ 1")), "ends before its last }");
    says(xml_of("TensorTree4", block("Reflection Back", "", "{ 1 2 3 }")), "make no grid");
    says(xml_of("TensorTree3", block("Reflection Back", "", "{ { 1 } { 2 } }")), "expected {");
    says(xml_of("TensorTree3", block("Reflection Back", "", "{ 1 } 5")), "text behind");
    says(xml_of("TensorTree3", block("Reflection Back", "", std::string(5000, '{'))), "more than 12 levels");
    says(xml_of("Columns", "",
                "<AngleBasis><AngleBasisName>own</AngleBasisName><AngleBasisBlock><nPhis>1000000000"
                "</nPhis><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>90</UpperTheta>"
                "</ThetaBounds></AngleBasisBlock></AngleBasis>"),
         "has no patches");
}

TEST(MeasuredDamage, EveryCutOfAFileIsReadOrRefused)
{
    const std::string good =
        xml_of("TensorTree3", block("Reflection Back", "", "{ { 1 } { 2 } { 3 } { 4 } { 1 } { 2 } { 3 } { 4 } }"));
    for (std::size_t cut = 0; cut < good.size(); ++cut)
        complaint(good.substr(0, cut));
    RandomStream random(5);
    for (int i = 0; i < 3000; ++i) {
        std::string changed = good;
        changed[static_cast<std::size_t>(random.next() * static_cast<double>(good.size()))] =
            static_cast<char>(random.next() * 256);
        complaint(changed);
    }
}

/// A sheet that reflects X and Z as well as Y has their colour: here that of a patch of the primaries' red, whose X : Y
/// : Z
/// (.64 .33 .03 by chromaticity) no white has.
TEST(MeasuredTable, ColoursAreThoseOfXAndZ)
{
    const auto values = [](double value) {
        std::string text;
        for (int i = 0; i < 41 * 41; ++i)
            text += std::to_string(value) + ' ';
        return text;
    };
    const auto light = [&](const char* kind, double value) {
        return std::string("</WavelengthData><WavelengthData><Wavelength unit=\"Integral\">") + kind + "</Wavelength>" +
               block("Reflection Back", "LBNL/Klems Quarter", values(value));
    };
    const double y = 0.05;
    const std::string visible = block("Reflection Back", "LBNL/Klems Quarter", values(y));
    const auto seen = [&](const std::string& blocks) {
        Measured sheet;
        sheet.table = MeasuredTable::parse(xml_of("Columns", blocks), "test.xml");
        return MeasuredScattering(sheet, true).value_per_sr({0, 0, 1}, {0.6, 0, 0.8}, LobeSet::all);
    };
    const Spectrum red = seen(visible + light("CIE-X", y * .64 / .33) + light("CIE-Z", y * .03 / .33));
    EXPECT_NEAR(photopic(red), y, 2e-3 * y);
    EXPECT_NEAR(red.g, 0, 1e-6);
    EXPECT_NEAR(red.b, 0, 1e-6);
    EXPECT_NEAR(red.r, y / photometric_weights.r, 2e-3 * red.r);
    const Spectrum grey = seen(visible + light("CIE-X", y) + light("CIE-Z", y)),
                   alone = seen(visible + light("CIE-X", 1));
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(grey[channel], y, 1e-6);
        EXPECT_NEAR(alone[channel], y, 1e-6);
    }
    // Ten times as red, it would send back more red than arrives: its luminance stays, its colour pales.
    const std::string bright = block("Reflection Back", "LBNL/Klems Quarter", values(2 * y));
    const Spectrum paler = seen(bright + light("CIE-X", 2 * y * .64 / .33) + light("CIE-Z", 2 * y * .03 / .33));
    EXPECT_NEAR(photopic(paler), 2 * y, 2e-3 * y);
    EXPECT_GT(paler.g, 0.1 * y);
    EXPECT_GT(paler.r, 2 * paler.g);
    EXPECT_NE(complaint(xml_of("Columns", visible + light("CIE-X", NAN))).find("expected a finite number"),
              std::string::npos);
}

TEST(MeasuredTable, MoreLightThanArrivesIsScaledDown)
{
    const auto table = MeasuredTable::parse(
        xml_of("Columns", block("Reflection Back", "LBNL/Klems Quarter", matrix(41, 1))), "test.xml");
    EXPECT_LT(table->scaled_by(), 1);
    EXPECT_NEAR(table->scaled_by() * table->reflection(true)->most_hemispherical(), 1, 1e-12);
}

} // namespace
} // namespace lightwell
