#pragma once

#include "engine/ambient/ambient_cache.h"
#include "engine/ambient/cache_block.h"

#include <optional>
#include <span>

namespace lightwell {

/// Kinds of blocks in a file of kept ambient light.
inline constexpr std::uint64_t record_block = 1, deep_block = 2;
/// Numbers that a record and a site of the deep field take. A change of either, or of their order, is another layout.
inline constexpr std::size_t numbers_in_record = 106, numbers_in_deep_site = 107;
inline constexpr std::uint64_t record_layout = 3;
/// The most records that fit in one block.
inline constexpr std::size_t most_records_in_block = most_numbers_in_block / numbers_in_record;

std::vector<double> encode_records(std::span<const AmbientRecord> records);
/// @return nothing when the numbers are no records: wrong count, not finite, no unit normal, no reach
std::optional<std::vector<AmbientRecord>> decode_records(std::span<const double> numbers);

/// @return empty when it does not fit in one block
std::vector<double> encode_deep(const DeepSolution& deep);
std::optional<DeepSolution> decode_deep(std::span<const double> numbers);

} // namespace lightwell
