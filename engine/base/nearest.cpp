#include "engine/base/nearest.h"

#include "engine/base/text.h"

#include <algorithm>
#include <numeric>

namespace lightwell {
namespace {

/// Names longer than this are compared by their beginning; the table of the distance grows with the square.
constexpr std::size_t longest_compared = 64;

std::string comparable(std::string_view name)
{
    std::string text = lowercase_ascii(name.substr(0, longest_compared));
    std::erase_if(text, [](char c) { return c == '-' || c == '_' || c == ' ' || c == '.'; });
    return text;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn one text into the other.
/// Source  Levenshtein 1966, with transpositions after Damerau 1964 (optimal string alignment)
std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            current[j] = std::min({replaced, previous[j] + 1, current[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                current[j] = std::min(current[j], before[j - 2] + 1);
        }
        before.swap(previous);
        previous.swap(current);
    }
    return previous[b.size()];
}

/// Half an edit for each letter of the common beginning is given back: people know how a name starts.
long dissimilarity(const std::string& name, const std::string& candidate)
{
    const auto common = static_cast<long>(
        std::mismatch(name.begin(), name.end(), candidate.begin(), candidate.end()).first - name.begin());
    return 2 * static_cast<long>(edit_distance(name, candidate)) - common;
}

} // namespace

std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates, std::size_t count)
{
    const std::string wanted = comparable(name);
    std::vector<std::pair<long, std::size_t>> order;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        order.emplace_back(dissimilarity(wanted, comparable(candidates[i])), i);
    const std::size_t kept = std::min(count, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < kept; ++i)
        names.push_back(candidates[order[i].second]);
    return names;
}

std::string nearest_hint(std::string_view name, const std::vector<std::string>& candidates, std::size_t count)
{
    std::string hint;
    for (const std::string& candidate : nearest(name, candidates, count))
        hint += (hint.empty() ? "nearest: " : ", ") + candidate;
    return hint;
}

} // namespace lightwell
