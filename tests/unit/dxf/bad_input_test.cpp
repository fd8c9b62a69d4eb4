#include "engine/base/errors.h"
#include "tests/unit/dxf/balance.h"
#include "tests/unit/dxf/dxf_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace lightwell::test {
namespace {

const std::string face = "0 3DFACE 5 2F 8 A-WALL 10 0 20 0 30 0 11 4 21 0 31 0 12 4 22 0 32 3 13 0 23 0 33 3";

/// The message names the file and line and holds every one of these words.
void expect_error(const std::string& content, const std::vector<std::string>& words)
{
    const std::string message = import_error(content);
    EXPECT_NE(message.find(".dxf"), std::string::npos) << message;
    for (const std::string& word : words)
        EXPECT_NE(message.find(word), std::string::npos) << message << "\nexpected: " << word;
}

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
}

TEST(DxfBadInput, NumbersThatAreNoneAreNamedWithLineLayerAndValue)
{
    for (const std::string value : {"nan", "inf", "1e999", "abc", "1,5", "--1"}) {
        SCOPED_TRACE(value);
        expect_error(drawing("", "0 3DFACE 8 A-WALL 10 0 20 0 30 " + value),
                     {".dxf:41: 3DFACE on layer \"A-WALL\": group 30", "expected"});
    }
    expect_error(drawing("", face + " 62 red"), {"group 62 is \"red\"", "expected a whole number"});
    expect_error(drawing("", face + " 62 1.5"), {"group 62 is \"1.5\"", "whole number"});
}

TEST(DxfBadInput, GroupCodesThatAreNoneAreNamedWithTheirLine)
{
    expect_error("0\nSECTION\n2\nENTITIES\nrubbish\nLINE\n0\nENDSEC\n0\nEOF\n", {".dxf:5", "\"rubbish\""});
    expect_error("0\nSECTION\n2\nENTITIES\n99999\nLINE\n0\nENDSEC\n0\nEOF\n", {".dxf:5", "\"99999\"", "1071"});
    EXPECT_NE(import_error("rubbish"), "");
    EXPECT_NE(import_error(""), "");
    EXPECT_NE(import_error("AC1032 is a DWG file"), "");
}

TEST(DxfBadInput, BlocksThatContainThemselvesAreNamedWithTheirChain)
{
    const auto block = [](const std::string& name, const std::string& inner) {
        return "0 BLOCK 2 " + name + " 10 0 20 0 30 0 0 INSERT 2 " + inner + " 0 ENDBLK ";
    };
    expect_error(drawing(block("SELF", "SELF"), "0 INSERT 2 SELF"), {"SELF > SELF", "contains itself"});
    expect_error(drawing(block("A", "B") + block("B", "C") + block("C", "A"), "0 INSERT 2 A"), {"A > B > C > A"});
    std::string deep;
    for (int i = 0; i < 1000; ++i)
        deep += block(std::to_string(i), std::to_string(i + 1));
    expect_error(drawing(deep, "0 INSERT 2 0"), {"more than 64 deep"});
    EXPECT_EQ(import_error(drawing(block("SELF", "SELF"), face)), ""); // nothing shows it
}

TEST(DxfBadInput, AbsurdArraysAreRefusedAndDoubledCopiesAreNot)
{
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + face + " 0 ENDBLK";
    expect_error(drawing(block, "0 INSERT 2 B 8 A-CHAIR 70 32000 71 32000 44 1 45 1"),
                 {"32000 x 32000", "A-CHAIR", "expected at most"});
    expect_error(drawing(block, "0 INSERT 2 B 70 1e30 44 1"), {"1e+30", "expected at most"});
    std::string many;
    for (int i = 0; i < 6; ++i)
        many += "0 INSERT 2 B 70 1000 71 1000 44 1 45 1 ";
    expect_error(drawing(block, many), {"copies of blocks"});
    const Imported same_place = imported_text(drawing(block, "0 INSERT 2 B 70 32000 71 -5 44 0"));
    EXPECT_EQ(layer_areas(same_place).at("A-WALL").surfaces, 1u);
}

TEST(DxfBadInput, ScalesAndArcsBeyondReasonAreRefused)
{
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + face + " 0 ENDBLK";
    expect_error(drawing(block, "0 INSERT 2 B 8 A-CHAIR 41 1e-200 42 1e-200"), {"A-CHAIR", "1e-200"});
    std::string arcs;
    for (int i = 0; i < 3000; ++i)
        arcs += "0 LWPOLYLINE 8 A-ARC 39 1e20 10 -1e20 20 0 40 0 41 1e19 42 1 10 1e20 20 0 ";
    expect_error(drawing("", arcs), {"A-ARC", "facets", "tolerance"});
}

TEST(DxfBadInput, PolyfacesAndMeshesWithWrongIndicesAndSizesAreNamed)
{
    const std::string start = "0 POLYLINE 5 77 8 MESH 66 1 70 64 0 VERTEX 70 192 10 0 20 0 30 0 "
                              "0 VERTEX 70 192 10 1 20 0 30 0 0 VERTEX 70 192 10 0 20 1 30 0 ";
    expect_error(drawing("", start + "0 VERTEX 70 128 71 1 72 2 73 4 0 SEQEND"), {"vertex 4", "1 to 3", "MESH", "77"});
    EXPECT_EQ(import_error(drawing("", start + "0 VERTEX 70 128 71 1 72 -2 73 3 0 SEQEND")), "");
    const std::string grid = "0 POLYLINE 8 MESH 66 1 70 16 71 30000 72 30000 0 VERTEX 70 64 10 0 20 0 30 0 0 SEQEND";
    expect_error(drawing("", grid), {"30000 x 30000", "has 1 vertices"});
}

TEST(DxfBadInput, SubdivisionMeshesWithWrongIndicesAndCountsAreNamed)
{
    const std::string mesh =
        "0 MESH 5 3A 8 M 100 AcDbSubdMesh 71 2 72 0 91 0 92 3 10 0 20 0 30 0 10 1 20 0 30 0 10 0 20 1 "
        "30 0 93 4 90 ";
    expect_error(drawing("", mesh + "3 90 0 90 1 90 3 94 0"), {"3A", "corner of a face is 3", "0 to 2"});
    expect_error(drawing("", mesh + "3 90 0 90 -1 90 2 94 0"), {"corner of a face is -1"});
    expect_error(drawing("", mesh + "9e9 90 0 90 1 90 2 94 0"), {"number of corners of a face is 9"});
    EXPECT_EQ(import_error(drawing("", mesh + "3 90 0 90 1 90 2 94 0")), "");
}

TEST(DxfBadInput, HatchesAndSplinesWithoutSenseAreSkippedWithAReason)
{
    const std::string start = "0 HATCH 8 H 100 AcDbHatch 10 0 20 0 30 0 210 0 220 0 230 1 2 SOLID 70 1 71 0 91 1 ";
    const auto reason = [](const std::string& entity) {
        ImportOptions options;
        options.raised = {{"*", 1}};
        const Imported imported = imported_text(drawing("", entity), options);
        EXPECT_EQ(imported.ledger.made_count(), 0u) << entity;
        return imported.ledger.skipped_list().at(0).reason;
    };
    EXPECT_EQ(reason(start + "92 1 93 1000000000 72 1 10 0 20 0 11 1 21 0 75 0"), "it has no area");
    EXPECT_EQ(reason(start + "92 2 72 0 73 1 93 3 10 0 20 0 10 1 20 0 75 0"), "it has no area");
    EXPECT_EQ(reason(start + "92 1 93 1 72 4 94 3 73 0 74 0 95 1 96 1 40 0 10 0 20 0 75 0"), "it has no area");
    EXPECT_EQ(reason("0 HATCH 8 H"), "it has no area");
    std::string loops = start;
    for (int i = 0; i < 4001; ++i)
        loops += "92 2 72 0 73 1 93 3 10 " + std::to_string(i) + " 20 0 10 " + std::to_string(i) + ".5 20 0 10 " +
                 std::to_string(i) + " 20 1 ";
    EXPECT_EQ(reason(loops + "75 0"), "a hatch with thousands of boundaries");
    EXPECT_EQ(reason("0 SPLINE 8 S 71 3 40 0 40 1 10 0 20 0 10 1 20 0"),
              "a spline whose knots and control points do not fit each other");
    EXPECT_EQ(reason("0 SPLINE 8 S 71 -1 10 0 20 0"), "a spline whose knots and control points do not fit each other");
    EXPECT_EQ(reason("0 ELLIPSE 8 E 10 0 20 0 11 0 21 0 40 0.5"), "it has no area");
    EXPECT_EQ(reason("0 MLINE 8 M 11 0 21 0 74 1 41 1"), "it has no area");
}

TEST(DxfBadInput, DegenerateEntitiesAreSkippedWithAReasonAndAScaleOfZeroIsOne)
{
    const std::string block = "0 BLOCK 2 B 10 0 20 0 30 0 " + face + " 0 ENDBLK";
    const Imported imported = imported_text(
        drawing(block, "0 INSERT 2 B 42 0 0 LWPOLYLINE 90 0 39 1 0 CIRCLE 40 -1 39 1 0 ARC 40 0 39 1 "
                       "0 LINE 10 1 20 1 11 1 21 1 39 1 0 SOLID 0 POLYLINE 39 1 0 SEQEND 0 3DFACE 0 UNHEARD-OF"));
    EXPECT_EQ(imported.ledger.made_count(), 2u); // the insert and the face in its block
    EXPECT_EQ(imported.ledger.read_count(), 10u);
    EXPECT_TRUE(imported.report.has(Finding::repaired));
    ASSERT_EQ(imported.ledger.repaired_list().size(), 1u);
    EXPECT_EQ(imported.ledger.repaired_list()[0].type, "INSERT");
    EXPECT_EQ(imported.ledger.repaired_list()[0].what, "scale of 0 taken as 1");
    EXPECT_NEAR(layer_areas(imported).at("A-WALL").area_m2, 12, 1e-12);
    EXPECT_NO_THROW(validate(imported.scene));
}

TEST(DxfBadInput, EveryCutEndsInOneErrorOrInAWholeDrawing)
{
    // A cut text file is either refused, or it was cut in the end mark after the last section.
    for (const std::string name :
         {"entities_r12.dxf", "entities_r12_binary.dxf", "hidden_r2000.dxf", "inserts_binary.dxf"}) {
        const std::string whole = bytes_of(std::filesystem::path{LIGHTWELL_ROOT} / "tests/fixtures/dxf" / name);
        ASSERT_GT(whole.size(), 1000u);
        std::size_t refused = 0, tried = 0;
        for (std::size_t size = 0; size < whole.size(); size += 97, ++tried) {
            const std::string message = import_error(whole.substr(0, size));
            if (!message.empty()) {
                ++refused;
                EXPECT_NE(message.find(".dxf"), std::string::npos) << message;
            }
        }
        EXPECT_GE(refused + 30, tried) << name; // whole sections may follow the entities
        EXPECT_GT(refused, 0u);
    }
}

TEST(DxfBadInput, RandomDamageNeverCrashesAndWhatIsStillReadIsAccountedFor)
{
    ImportOptions options;
    options.raised = {{"*", 2.5}}; // so that outlines are made, too
    std::uint32_t state = 12345;
    const auto random = [&state] { return state = state * 1664525u + 1013904223u; };
    for (const std::string name : {"entities_r12.dxf", "entities_binary.dxf", "inserts.dxf", "entities_r12_binary.dxf",
                                   "areas_r2018.dxf", "areas_r2000_binary.dxf", "extras_r2007.dxf",
                                   "extras_r2018_binary.dxf", "plan_r2000.dxf", "references_r2000.dxf"}) {
        const std::string whole = bytes_of(std::filesystem::path{LIGHTWELL_ROOT} / "tests/fixtures/dxf" / name);
        std::size_t refused = 0;
        for (int round = 0; round < 100; ++round) {
            std::string damaged = whole;
            for (int i = 0; i < 10; ++i)
                damaged[(random() >> 4) % damaged.size()] = static_cast<char>(random() >> 24);
            const TemporaryFile file{damaged};
            try {
                const Imported imported = import_dxf(file.path(), options);
                validate(imported.scene);
                expect_balanced(imported, file.path());
            } catch (const InputError&) {
                ++refused;
            }
        }
        EXPECT_GT(refused, 0u) << name;
    }
}

} // namespace
} // namespace lightwell::test
