#pragma once

#include <cstdint>
#include <string_view>

namespace lightwell {

/// One function that the language itself has, on plain numbers.
struct LibraryFunction {
    std::string_view name;
    std::uint32_t least_arguments;
    double (*value)(const double* arguments, std::uint32_t count);
    bool any_count = false; ///< takes more arguments than the least; else further ones are ignored
};

/// More arguments than any call of min, max or select has.
inline constexpr std::uint32_t most_arguments = 64;

/// Index of the function of that name, or -1.
int find_library_function(std::string_view name) noexcept;
const LibraryFunction& library_function(std::uint32_t index) noexcept;

} // namespace lightwell
