#pragma once

#include "engine/base/errors.h"
#include "importers/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace lightwell {

inline SurfaceKey on(const std::string& layer, const std::string& entity = "3DFACE")
{
    SurfaceKey key;
    key.layer = layer;
    key.entity = entity;
    return key;
}

/// A small building made by hand: what an importer hands over.
class LayerMaps : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  (std::string("map_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    LayerMap map(const std::string& text)
    {
        std::ofstream(folder_ / "map.toml") << text;
        return read_layer_map(folder_ / "map.toml");
    }
    void apply(const std::string& text)
    {
        apply_layer_map(imported_, map(text));
        EXPECT_NO_THROW(validate(imported_.scene));
        for (std::size_t i = 0; i < imported_.scene.modifiers.size(); ++i) {
            const bool open = std::holds_alternative<Inherited>(imported_.scene.modifiers[i].what);
            EXPECT_TRUE(open || resolve(imported_.scene, static_cast<ModifierId>(i)).material);
        }
        EXPECT_EQ(imported_.keys.size(), imported_.scene.modifiers.size());
    }
    std::string complaint(const std::string& text)
    {
        try {
            apply_layer_map(imported_, map(text));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }

    /// A square of one square metre whose front looks upwards.
    static void square(Part& part, ModifierId modifier, const std::string& name, double z = 0)
    {
        part.add_polygon({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, modifier, name);
    }
    void face(const SurfaceKey& key)
    {
        square(imported_.scene.root, keys_.modifier_for(key), "h" + std::to_string(++handle_));
        imported_.ledger.made();
    }
    /// The six sides of a cube, fronts outwards (or inwards).
    static void cube(Part& part, ModifierId modifier, bool inwards = false)
    {
        const Point c[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (auto [p, q, r, s] : {std::array{0, 3, 2, 1}, std::array{4, 5, 6, 7}, std::array{0, 1, 5, 4},
                                  std::array{1, 2, 6, 5}, std::array{2, 3, 7, 6}, std::array{3, 0, 4, 7}}) {
            std::vector<Point> corners{c[p], c[q], c[r], c[s]};
            if (inwards)
                std::reverse(corners.begin(), corners.end());
            part.add_polygon(corners, modifier, "cube");
        }
    }

    /// Expanded surfaces by name of the modifier.
    std::map<std::string, int> by_modifier() const
    {
        std::map<std::string, int> counts;
        visit_expanded(imported_.scene, [&](const Part&, const Surface&, const Affine&, ModifierId modifier) {
            ++counts[modifier == void_modifier ? "void"
                                               : imported_.scene.modifiers[static_cast<std::size_t>(modifier)].name];
        });
        return counts;
    }
    std::string material_of(const std::string& modifier) const
    {
        const ModifierId id = imported_.scene.find_modifier(modifier);
        EXPECT_NE(id, void_modifier) << modifier;
        const auto* alias = std::get_if<Alias>(&imported_.scene.modifiers[static_cast<std::size_t>(id)].what);
        return alias ? imported_.scene.modifiers[static_cast<std::size_t>(alias->target)].name : "no alias";
    }
    double radiance_of(const std::string& modifier) const
    {
        return photopic(emitted_radiance(*resolve(imported_.scene, imported_.scene.find_modifier(modifier)).material));
    }

    Imported imported_;
    KeyTable keys_{imported_};
    std::filesystem::path folder_;
    int handle_ = 0;
};

} // namespace lightwell
