#include "importers/formats/formats.h"

#include "engine/base/errors.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace lightwell {
namespace {

const std::filesystem::path fixtures = LIGHTWELL_ROOT "/tests/fixtures";

/// A copy under a name that says nothing, removed afterwards.
struct Disguised {
    explicit Disguised(const std::filesystem::path& from)
        : path(std::filesystem::temp_directory_path() / ("lightwell_disguised-" + std::to_string(getpid())))
    {
        std::filesystem::copy_file(from, path, std::filesystem::copy_options::overwrite_existing);
    }
    ~Disguised() { std::filesystem::remove(path); }
    std::filesystem::path path;
};

TEST(Formats, TheContentDecidesAndNotTheName)
{
    const Disguised obj(fixtures / "obj/cylinder.obj");
    EXPECT_EQ(import_file(obj.path).ledger.made_count(), 26u);
    const Disguised text(fixtures / "gltf/nodes.gltf");
    EXPECT_EQ(import_file(text.path).unit, "m (glTF)");
    const Disguised binary(fixtures / "gltf/materials.glb");
    EXPECT_EQ(import_file(binary.path).scene.views.size(), 2u);
}

TEST(Formats, OptionsReachTheImporter)
{
    EXPECT_EQ(import_file(fixtures / "gltf/nodes.gltf", ImportOptions{.metres_per_unit = 0.001, .up = ""}).unit,
              "mm (given)");
}

TEST(Formats, AnUnknownContentIsRefusedWithTheListOfFormats)
{
    try {
        import_file(fixtures / "obj/make_fixtures.py");
        FAIL() << "expected an error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("expected DXF, OBJ, glTF (.gltf) or GLB"), std::string::npos);
    }
    EXPECT_THROW(import_file(fixtures / "no_such_file"), InputError);
    EXPECT_THROW(import_file(fixtures), InputError);
}

TEST(Formats, EachFixtureIsRecognisedByOneFormatOnly)
{
    std::size_t seen = 0;
    for (const char* folder : {"dxf", "obj", "gltf"})
        for (const auto& entry : std::filesystem::directory_iterator(fixtures / folder)) {
            const std::string extension = entry.path().extension().string();
            const bool dxf = extension == ".dxf", obj = extension == ".obj",
                       gltf = extension == ".gltf" || extension == ".glb";
            if (!dxf && !obj && !gltf)
                continue;
            SCOPED_TRACE(entry.path().string());
            EXPECT_EQ(recognize_obj(entry.path()), obj);
            EXPECT_EQ(recognize_gltf(entry.path()), gltf);
            EXPECT_TRUE(dxf || !recognize_dxf(entry.path()));
            ++seen;
        }
    EXPECT_GE(seen, 8u);
}

} // namespace
} // namespace lightwell
