#include "tests/unit/assimp/long_tail.h"

#include "engine/base/errors.h"
#include "importers/assimp/ifc_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <map>
#include <set>

namespace lightwell {
namespace {

using Json = nlohmann::json;

/// Files that are not what their truth says, one by one, and why.
const std::map<std::string, std::string> refused_with_reason{
    {"step/as1_pe_203.stp", "STEP is not read"},
    {"step/as1_pe_203.igs", "IGES is not read"},
    {"ifc/AC20-FZK-Haus.ifc", "IFC4: the reader knows 2x3"},
    {"fbx/transparentTest.fbx", "not a whole FBX file: its header is followed by text"},
    {"ply/assimp/issue623.ply", "vertices without faces: nothing has an area"},
    {"ply/magnum/whitespace.ply", "blanks before the words of the header: the reader wants them at the line's start"},
};
const std::map<std::string, std::string> differs_with_reason{
    {"stl/cube_meshlab_ascii.stl", "the name of the solid is cut at its first blank"},
};

struct Counts {
    std::size_t faces = 0;
    std::set<std::string> layers, materials, blocks;
};

std::size_t noted(const Imported& imported, const std::string& text)
{
    std::size_t count = 0;
    for (const Note& note : imported.report.notes())
        count += note.text.find(text) != std::string::npos ? note.count : 0;
    return count;
}

/// Faces of parts, each mesh once, with those that were left out for want of an area.
Counts counts_of(const Imported& imported)
{
    Counts counts;
    const auto add = [&](const Part& part) {
        counts.faces += part.polygons.size();
        for (const auto& mesh : part.meshes)
            counts.faces += mesh->triangles.size() / 3;
    };
    add(imported.scene.root);
    for (const Part& prototype : imported.scene.prototypes)
        add(prototype);
    counts.faces += noted(imported, "face without area");
    for (std::size_t i = 0; i < imported.keys.size(); ++i) {
        if (std::holds_alternative<Inherited>(imported.scene.modifiers[i].what))
            continue; // a place-holder: each instance says what it stands for
        const SurfaceKey& key = imported.keys[i];
        counts.layers.insert(key.layer);
        counts.materials.insert(key.material);
        counts.blocks.insert(key.block);
    }
    return counts;
}

std::set<std::string> names_in(const Json& list, bool step)
{
    std::set<std::string> names;
    for (const auto& name : list)
        names.insert(step ? decode_step_string(name.get<std::string>()) : name.get<std::string>());
    return names;
}

bool contains_all(const std::set<std::string>& all, std::set<std::string> some)
{
    some.erase("");
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

void compare_3ds(const Json& truth, const Counts& found)
{
    EXPECT_EQ(found.faces, truth["faces_total"].get<std::size_t>());
    for (const auto& object : truth["objects"])
        EXPECT_TRUE(found.layers.contains(object["name"].get<std::string>())) << object["name"];
    EXPECT_TRUE(contains_all(names_in(truth["materials"], false), found.materials));
}

void compare_stl(const Json& truth, const Counts& found, const Imported& imported, bool name_differs)
{
    EXPECT_EQ(found.faces, truth["triangles"].get<std::size_t>());
    const Box box = bounds(imported.scene);
    const double unit = imported.unit.starts_with("mm") ? 1e-3 : 1;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t i = static_cast<std::size_t>(axis);
        EXPECT_NEAR(box.low[axis], unit * truth["bbox"]["min"][i].get<double>(), 1e-4);
        EXPECT_NEAR(box.high[axis], unit * truth["bbox"]["max"][i].get<double>(), 1e-4);
    }
    if (truth.contains("area")) {
        EXPECT_NEAR(total_area_m2(imported), unit * unit * truth["area"].get<double>(), 0.01);
    }
    if (truth.contains("solids")) {
        EXPECT_EQ(found.layers.contains(truth["solids"][0].get<std::string>()), !name_differs);
    }
}

void compare_collada(const Json& truth, const Counts& found, const Imported& imported)
{
    EXPECT_TRUE(contains_all(names_in(truth["material_names"], false), found.materials));
    EXPECT_EQ(imported.scene.views.size(), truth["cameras"].get<std::size_t>());
    std::size_t lights = 0;
    for (const Ledger::Skipped& skipped : imported.ledger.skipped_list())
        lights += skipped.type == "light" ? skipped.count : 0;
    EXPECT_EQ(lights, truth["lights"].get<std::size_t>());
    std::size_t faces = 0;
    for (const auto& [kind, count] : truth["primitive_counts"].items())
        faces += kind == "lines" ? 0 : count.get<std::size_t>();
    EXPECT_EQ(found.faces, faces);
}

void compare_ifc(const Json& truth, const Counts& found)
{
    const std::set<std::string> layers = names_in(truth["presentation_layers"], true);
    std::size_t known = 0;
    for (const std::string& layer : found.layers) {
        EXPECT_TRUE(layers.contains(layer) || layer.starts_with("Ifc")) << layer;
        known += layers.contains(layer);
    }
    EXPECT_GE(2 * known, layers.size()); // the others hold spaces, axes and what has no body
}

void compare(const std::string& name, const Json& entry, const Imported& imported)
{
    const Json& truth = entry["ground_truth"];
    const Counts found = counts_of(imported);
    const std::string folder = name.substr(0, name.find('/'));
    if (folder == "3ds")
        compare_3ds(truth, found);
    else if (folder == "stl")
        compare_stl(truth, found, imported, differs_with_reason.contains(name));
    else if (folder == "collada")
        compare_collada(truth, found, imported);
    else if (folder == "ifc")
        compare_ifc(truth, found);
    else if (folder == "fbx")
        EXPECT_EQ(imported.ledger.made_count(), truth["objects"]["Geometry"].get<std::size_t>());
    else if (folder == "ply")
        EXPECT_EQ(std::to_string(found.faces), truth["elements"]["face"].get<std::string>());
    else
        ADD_FAILURE() << "no truth for " << folder;
}

bool must_be_refused(const std::string& name, const Json& entry)
{
    if (entry.contains("malformed") || name.starts_with("usd/") || refused_with_reason.contains(name))
        return true;
    const Json& truth = entry["ground_truth"];
    return name.starts_with("ply/") && (!truth["end_header"].get<bool>() || !truth["elements"].contains("face") ||
                                        truth["elements"]["face"] == "0");
}

TEST(CadFiles, EachAgreesWithItsTruthOrIsListedWithTheReason)
{
    if (!std::filesystem::exists(shared_cad() / "MANIFEST.json"))
        GTEST_SKIP() << "the shared CAD files are not here";
    const Json manifest = Json::parse(whole_file(shared_cad() / "MANIFEST.json"));
    int files = 0, agree = 0, refused = 0;
    for (const Json& entry : manifest["entries"]) {
        const std::string name = entry["file"];
        SCOPED_TRACE(name);
        ++files;
        const std::filesystem::path file = shared_cad() / name;
        try {
            if (!recognize_assimp(file))
                throw InputError(name, "is of no known format");
            const Imported imported = import_assimp(file, {});
            validate(imported.scene);
            // Types that another program does not support may well be read here.
            EXPECT_TRUE(!must_be_refused(name, entry) || entry.contains("malformed")) << "was read";
            compare(name, entry, imported);
            agree += !differs_with_reason.contains(name);
        } catch (const InputError& error) {
            EXPECT_TRUE(must_be_refused(name, entry)) << error.what();
            ++refused;
        }
    }
    RecordProperty("files", files);
    RecordProperty("agree", agree);
    RecordProperty("refused", refused);
    EXPECT_EQ(files, agree + refused + static_cast<int>(differs_with_reason.size()));
    std::cout << files << " files, " << agree << " agree, " << differs_with_reason.size() << " differ, " << refused
              << " refused\n";
}

} // namespace
} // namespace lightwell
