#pragma once

#include "importers/radiance/ply_part.h"

#include <functional>
#include <map>
#include <memory>

namespace lightwell {

struct KeptMeshes::State {
    /// By number of the modifier: whether it varies over a surface, so that places on its texture count.
    using Varies = std::function<std::vector<bool>(const std::vector<std::string>& names)>;
    using Built = std::shared_ptr<const scene_text::PlyPart>;

    void begin_reading();
    /// Forgets files that the last reading did not ask for.
    void end_reading();
    /// @param chord_tolerance_m  of a limit surface; 0: the faces as they are
    Built part(const std::filesystem::path& file, double chord_tolerance_m, const Varies& varies);

    Counts counts;

private:
    struct File {
        std::uint64_t contents = 0; ///< hash of the bytes
        std::vector<std::string> modifiers;
        std::map<std::pair<std::vector<bool>, double>, Built> parts = {};
        bool used = false;
    };
    std::map<std::filesystem::path, File> files_;
};

} // namespace lightwell
