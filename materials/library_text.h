#pragma once

#include <string_view>
#include <vector>

namespace lightwell {

/// One file of materials/library as it was when the program was built.
struct LibraryText {
    const char* file;
    std::string_view text;
};
const std::vector<LibraryText>& library_texts();

} // namespace lightwell
