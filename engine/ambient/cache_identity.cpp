#include "engine/ambient/cache_identity.h"

#include "engine/ambient/cache_block.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string_view>

namespace lightwell {
namespace {

constexpr char fingerprint_sign = '#';
/// More than these say no more to a reader.
constexpr std::size_t most_differences_named = 6;

/// The values of a name, joined: a name may occur more than once.
std::map<std::string, std::string> by_name(const CacheIdentity& identity)
{
    std::map<std::string, std::string> values;
    for (const auto& [name, value] : identity.lines) {
        std::string& joined = values[name];
        joined += joined.empty() ? value : ", " + value;
    }
    return values;
}

std::string changed(const std::string& name, const std::string& was, const std::string& is)
{
    const bool shown = !was.starts_with(fingerprint_sign) && !is.starts_with(fingerprint_sign);
    return shown ? name + " was " + was + ", is " + is : name + " changed";
}

} // namespace

void CacheIdentity::add_fingerprint(const std::string& name, std::uint64_t bits)
{
    char text[20];
    std::snprintf(text, sizeof text, "%c%016llx", fingerprint_sign, static_cast<unsigned long long>(bits));
    lines.emplace_back(name, text);
}

void CacheIdentity::add_setting(const std::string& name, const std::string& value)
{
    std::string one_line = value;
    std::replace(one_line.begin(), one_line.end(), '\n', ' ');
    lines.emplace_back(name, one_line);
}

std::string differences(const CacheIdentity& stored, const CacheIdentity& wanted)
{
    const std::map<std::string, std::string> was = by_name(stored), is = by_name(wanted);
    std::vector<std::string> found;
    for (const auto& [name, value] : is) {
        const auto old = was.find(name);
        if (old == was.end())
            found.push_back(name + " is new");
        else if (old->second != value)
            found.push_back(changed(name, old->second, value));
    }
    for (const auto& [name, value] : was)
        if (!is.contains(name))
            found.push_back(name + " is gone");
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), most_differences_named); ++i)
        text += (i == 0 ? "" : "; ") + found[i];
    if (found.size() > most_differences_named)
        text += "; and " + std::to_string(found.size() - most_differences_named) + " more";
    return text;
}

std::string to_text(const CacheIdentity& identity)
{
    std::vector<std::string> sorted;
    for (const auto& [name, value] : identity.lines)
        sorted.push_back(percent_encoded(name) + ' ' + value + '\n');
    std::sort(sorted.begin(), sorted.end());
    std::string text;
    for (const std::string& line : sorted)
        text += line;
    return text;
}

CacheIdentity parse_cache_identity(const std::string& text)
{
    CacheIdentity identity;
    for (const std::string_view line : split(text, "\n")) {
        const std::size_t blank = std::min(line.find(' '), line.size());
        identity.lines.emplace_back(percent_decoded(line.substr(0, blank)),
                                    std::string(line.substr(std::min(blank + 1, line.size()))));
    }
    return identity;
}

std::uint64_t fingerprint(const CacheIdentity& identity) noexcept
{
    const std::string text = to_text(identity);
    return checksum(text.data(), text.size(), 0);
}

} // namespace lightwell
