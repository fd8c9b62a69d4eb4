#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// What a cache of light belongs to: named lines, each a fingerprint (`geometry`, `material wall`) or a setting as
/// text (`ambient accuracy` -> `0.1`). Two identities are equal when they hold the same lines, in any order.
struct CacheIdentity {
    std::vector<std::pair<std::string, std::string>> lines;

    /// A line of which only "changed" can be said.
    void add_fingerprint(const std::string& name, std::uint64_t bits);
    /// A line whose values are shown: "ambient accuracy was 0.1, is 0.05".
    void add_setting(const std::string& name, const std::string& value);
};

/// What differs, in a sentence without its full stop: "geometry changed; material "wall" is new; accuracy was 0.1, is
/// 0.05". Empty when the two are equal. Names the first differences and counts the others.
std::string differences(const CacheIdentity& stored, const CacheIdentity& wanted);

/// One line of text for each entry, "name value\n", the name without blanks (percent-encoded); sorted.
std::string to_text(const CacheIdentity& identity);
CacheIdentity parse_cache_identity(const std::string& text);
/// Of the sorted lines.
std::uint64_t fingerprint(const CacheIdentity& identity) noexcept;

} // namespace lightwell
