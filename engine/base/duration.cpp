#include "engine/base/duration.h"

#include "engine/base/text.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

std::optional<double> parse_duration(std::string_view text) noexcept
{
    const std::size_t letters = std::min(text.find_first_not_of("0123456789.+-"), text.size());
    const std::string_view unit = text.substr(letters);
    const double seconds = unit.empty() || unit == "s" ? 1 : unit == "min" ? 60 : unit == "h" ? 3600 : 0;
    const auto number = parse_double(text.substr(0, letters));
    const bool sound = number && *number > 0 && std::isfinite(*number) && seconds > 0;
    return sound ? std::optional(*number * seconds) : std::nullopt;
}

} // namespace lightwell
