#include "engine/simulate/kept_ambient.h"

#include "engine/base/text.h"
#include "engine/sampling/path_random.h"
#include "engine/scene/scene_hash.h"
#include "engine/simulate/ambient_build.h"
#include "engine/simulate/technique_names.h"

#include <algorithm>
#include <bit>

namespace lightwell {
namespace {

/// Tells two versions of this program apart that would do different work for the same wish.
std::uint64_t method_bits()
{
    constexpr double usual = 0.05;
    const AmbientEffort effort = ambient_effort(usual, {}, 1, 1);
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    std::uint64_t sum = mix_bits(record_layout, bits(effort.deep.reach_share));
    for (const double x :
         {static_cast<double>(effort.deep.rays), static_cast<double>(effort.deep_paths), effort.cache.accuracy,
          static_cast<double>(effort.cache.rays), static_cast<double>(replicates), double{horizon_sectors}})
        sum = mix_bits(sum, bits(x));
    return sum;
}

} // namespace

CacheIdentity ambient_identity(const SimulationParts& parts, const AmbientEffort& effort, const Techniques& techniques)
{
    CacheIdentity identity;
    const SceneFingerprint scene = scene_fingerprint(parts.scene);
    identity.add_fingerprint("geometry", scene.geometry);
    identity.add_fingerprint("which surface is made of what", scene.assignment);
    for (const auto& [name, bits] : scene.modifiers)
        identity.add_fingerprint(name, bits);
    identity.add_setting("ambient accuracy", shortest(effort.accuracy));
    identity.add_setting("seed", std::to_string(effort.deep.seed));
    Techniques of_records = techniques;
    of_records.cache = of_records.deep_field = of_records.image_sampling =
        true; // decide who asks for records, not what they hold
    const std::string off = switched_off(of_records, parts.preparation);
    identity.add_setting("techniques switched off", off.empty() ? "none" : off);
    identity.add_setting("mirrors in a chain", std::to_string(parts.preparation.virtual_depth));
    if (parts.preparation.backs_unseen)
        identity.add_setting("backs of surfaces", "unseen");
    identity.add_setting("secondary sources", to_text(parts.preparation.secondary));
    identity.add_fingerprint("the program's way to ambient light", method_bits());
    return identity;
}

void KeptAmbient::read()
{
    for (const CacheBlock& block : file_.read_new()) {
        if (block.kind == record_block) {
            if (const auto records = decode_records(block.numbers))
                records_.insert(records_.end(), records->begin(), records->end());
        } else if (block.kind == deep_block) {
            if (auto deep = decode_deep(block.numbers))
                deeps_.push_back(std::move(*deep));
        }
    }
}

std::vector<AmbientRecord> KeptAmbient::new_records()
{
    read();
    return std::exchange(records_, {});
}

bool KeptAmbient::take_deep(const std::function<bool(DeepSolution& deep)>& is_good)
{
    read();
    return std::any_of(deeps_.begin(), deeps_.end(), is_good);
}

void KeptAmbient::keep(std::span<const AmbientRecord> records)
{
    for (std::size_t first = 0; first < records.size(); first += most_records_in_block) {
        const auto part = records.subspan(first, std::min(most_records_in_block, records.size() - first));
        file_.append(record_block, part.size(), encode_records(part));
    }
}

void KeptAmbient::keep(const DeepSolution& deep)
{
    const std::vector<double> numbers = encode_deep(deep);
    if (!numbers.empty())
        file_.append(deep_block, deep.sites.size(), numbers);
}

} // namespace lightwell
