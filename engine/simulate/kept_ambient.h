#pragma once

#include "engine/ambient/cache_file.h"
#include "engine/ambient/record_codec.h"
#include "engine/simulate/parts.h"

#include <functional>

namespace lightwell {

struct AmbientEffort;

/// What kept ambient light belongs to: the parts of the scene, and every setting that decides what a record holds.
CacheIdentity ambient_identity(const SimulationParts& parts, const AmbientEffort& effort, const Techniques& techniques);

/// Ambient light in a file, shared by views, runs and processes.
class KeptAmbient {
public:
    /// @throws InputError for a file of another scene or other settings: says what changed
    KeptAmbient(const std::filesystem::path& file, const CacheIdentity& identity) : file_(file, identity) {}

    /// Records of others that were added since the last call, in the order of the file.
    std::vector<AmbientRecord> new_records();
    /// The first deep field in the file that is good enough for the caller; it is forgotten here.
    /// @return false where there is none
    bool take_deep(const std::function<bool(DeepSolution& deep)>& is_good);
    void keep(std::span<const AmbientRecord> records);
    void keep(const DeepSolution& deep);
    Report report() const { return file_.report(); }

private:
    void read();

    CacheFile file_;
    std::vector<AmbientRecord> records_; ///< read, and not yet given out
    std::vector<DeepSolution> deeps_;
};

} // namespace lightwell
