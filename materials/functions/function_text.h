#pragma once

#include <string_view>
#include <vector>

namespace lightwell {

/// One file of materials/functions/library as it was when the program was built.
struct FunctionText {
    std::string_view file;
    std::string_view text;
};
const std::vector<FunctionText>& function_texts();

} // namespace lightwell
