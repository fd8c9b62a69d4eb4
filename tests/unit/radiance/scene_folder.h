#pragma once

#include "engine/base/errors.h"
#include "importers/radiance/radiance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lightwell {

/// A folder of its own for one test, removed afterwards.
class SceneFolder {
public:
    SceneFolder();
    ~SceneFolder();
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& text) const;
    std::string text(const std::string& name) const;
    /// Writes `scene.rad` and reads it.
    Scene read(const std::string& text, Report& report) const;
    Scene read(const std::string& text) const;
    /// The message of the InputError that reading this text gives, or "" when it is read without one.
    std::string error(const std::string& text) const;

private:
    std::filesystem::path folder_;
};

/// One surface in world coordinates, for comparing scenes that are built differently: type, modifier's name, its
/// material and pattern, and all numbers.
struct WorldSurface {
    std::string name, type, modifier, material;
    std::vector<double> numbers;
};
/// Instances expanded, in order.
std::vector<WorldSurface> world_surfaces(const Scene& scene);
/// Every number a material or modifier has, as text.
std::string describe(const Scene& scene, ModifierId modifier);

/// Where the shared reference data is, or nothing.
std::filesystem::path shared_data();

} // namespace lightwell
