#pragma once

#include "engine/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// Another program's answer.
struct PeerRun {
    std::string program, setting;
    double cpu_s = 0, wall_s = 0;
    std::vector<double> values; ///< lx, or cd/m^2
    std::string failure;        ///< empty: it answered
};

/// What other programs answered when they were run elsewhere, from a file: a line each with program, setting, CPU
/// seconds, seconds and all values in the order of the sensors, or of the pixels row by row from the top; `#` begins a
/// comment.
/// @throws InputError: no file, a number that is none or not finite, another count of values than `count`
std::vector<PeerRun> read_peer_runs(const std::filesystem::path& file, std::size_t count);

/// The scene written once for programs of the Radiance family that are on the PATH, and their runs at three qualities
/// each. Making their octree is not counted, as reading the file is not for us.
class RadiancePeers {
public:
    /// Writes into a folder of its own, which goes with this object.
    /// @param most_cpu_s  after which a program is ended
    RadiancePeers(const Scene& scene, double most_cpu_s);
    ~RadiancePeers();
    RadiancePeers(const RadiancePeers&) = delete;
    RadiancePeers& operator=(const RadiancePeers&) = delete;

    /// Why none of them can run; empty when they can.
    const std::string& absent() const noexcept { return absent_; }
    static constexpr int qualities = 3;
    PeerRun illuminance(const SensorGrid& grid, int quality) const;
    /// Twice as many pixels each way as are wanted, averaged: what their users do against jagged edges.
    PeerRun picture(const View& view, int width, int height, int quality) const;

private:
    double most_cpu_s_;
    std::filesystem::path folder_, octree_;
    std::string absent_;
};

} // namespace lightwell
