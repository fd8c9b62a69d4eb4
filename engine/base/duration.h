#pragma once

#include <optional>
#include <string_view>

namespace lightwell {

/// Seconds in "60s", "5min", "2h" or a bare number of seconds; nothing when it is none of these or not positive.
std::optional<double> parse_duration(std::string_view text) noexcept;

} // namespace lightwell
