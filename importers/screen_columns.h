#pragma once

#include <string>

namespace lightwell {

/// Columns on a screen: one for each code point, two for each East Asian one.
inline std::size_t columns_of(const std::string& text)
{
    std::size_t columns = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) != 0x80)
            columns += byte >= 0xE3 && byte < 0xF0 ? 2 : 1;
    }
    return columns;
}

inline std::string padded(const std::string& text, std::size_t columns)
{
    const std::size_t used = columns_of(text);
    return text + std::string(used < columns ? columns - used : 0, ' ');
}

} // namespace lightwell
