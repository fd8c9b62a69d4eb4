#pragma once

#include <optional>
#include <string>

namespace lightwell {

struct DateTime;

/// Hours ahead of UTC at a local time in a zone of the IANA database (`Europe/Berlin`), as the machine's files of
/// zones have it (`TZDIR`, else /usr/share/zoneinfo). An hour that comes twice is the first of the two.
/// @return nothing for a zone that is not there, or an hour that clocks skip
std::optional<double> utc_offset_in_zone_h(const std::string& zone, const DateTime& local);

} // namespace lightwell
