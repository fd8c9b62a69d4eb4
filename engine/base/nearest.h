#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// The candidates that look most like a name, best first, for messages about names that do not exist: case, `-`, `_`
/// and blanks count little, a shared beginning counts much. Ties keep the order of the candidates.
std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates,
                                 std::size_t count = 3);
/// `nearest: a, b, c`, or empty when there are no candidates.
std::string nearest_hint(std::string_view name, const std::vector<std::string>& candidates, std::size_t count = 3);

} // namespace lightwell
