#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lightwell {

/// A moment as ISO 8601 writes it: `2026-06-21T12:00`, seconds and an offset (`+02:00`, `Z`) or a
/// zone of the IANA database (`[Europe/Berlin]`) if wanted.
struct DateTime {
    int year = 0, month = 0, day = 0;
    double hour = 0; ///< [0, 24)
    std::optional<double> utc_offset_h;
};
/// @return nothing when the text is no such moment; also for a 30th of February, 24:00, a zone that is not known
std::optional<DateTime> parse_date_time(std::string_view text);

} // namespace lightwell
