#pragma once

#include <set>
#include <string>
#include <string_view>

namespace lightwell {

/// Ideas that a name of a layer, group, block or material speaks of: "wall", "glass", "frosted", ...; found by words of
/// English, German, French, Spanish, Italian and Chinese and by the field codes of AIA/NCS, accents folded, compounds
/// taken apart, plurals understood.
std::set<std::string> ideas_in(std::string_view name);

/// Lower case, accents and umlauts as plain letters (ß as ss), other scripts as they are.
std::string folded(std::string_view name);

} // namespace lightwell
