#include "engine/base/errors.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace lightwell {
namespace {

/// Input that once broke a reader: it is answered with one message, or read into a valid scene whose ledger balances.
TEST(FoundInput, IsAnsweredOrRead)
{
    for (const char* format : {"dxf", "obj", "gltf"}) {
        const std::filesystem::path folder = std::filesystem::path(LIGHTWELL_ROOT "/tests/fixtures") / format / "found";
        if (!std::filesystem::exists(folder))
            continue;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            SCOPED_TRACE(entry.path().string());
            try {
                Imported imported = import_file(entry.path());
                const std::size_t read = imported.ledger.read_count();
                apply_layer_map(imported, {});
                validate(imported.scene);
                EXPECT_EQ(imported.ledger.read_count(), read);
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()), std::string::npos)
                    << "names the file: " << error.what();
            }
        }
    }
}

} // namespace
} // namespace lightwell
