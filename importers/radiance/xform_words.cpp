#include "importers/radiance/xform_words.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/generators/scene_text_out.h"
#include "importers/radiance/transform_words.h"

#include <cmath>

namespace lightwell::scene_text {
namespace {

using generators::BadWords;

[[noreturn]] void refuse(const std::string& word)
{
    throw BadWords("command line error at '" + word + "'");
}

/// How many numbers follow a word of a transform; nothing when it is none.
std::optional<std::size_t> numbers_after(const std::string& word)
{
    if (word == "-t")
        return 3;
    if (word == "-affine")
        return 12;
    if (word == "-s" || word == "-i" || word == "-a" || word == "-rx" || word == "-ry" || word == "-rz")
        return 1;
    if (word == "-mx" || word == "-my" || word == "-mz")
        return 0;
    return std::nullopt;
}

bool is_count(const std::string& word, long long least)
{
    return parse_integer(word).value_or(least - 1) >= least;
}

/// The option at `next` with its values.
std::vector<std::string> transform_step(const std::vector<std::string>& words, std::size_t next)
{
    const std::string& word = words[next];
    const std::size_t count = *numbers_after(word);
    if (words.size() - next <= count)
        refuse(word);
    for (std::size_t i = 1; i <= count; ++i) {
        const auto value = parse_double(words[next + i]);
        const bool whole = word == "-i" || word == "-a";
        if (!value || !std::isfinite(*value) || (whole && !is_count(words[next + i], word == "-a" ? 1 : 0)) ||
            (word == "-s" && *value == 0))
            refuse(word);
    }
    return {words.begin() + static_cast<std::ptrdiff_t>(next),
            words.begin() + static_cast<std::ptrdiff_t>(next + count + 1)};
}

/// Every combination of the arrays, the first of them outermost, each as the words of one copy.
void expand_arrays(const std::vector<std::string>& steps, std::size_t from, XformCopy copy, const std::string& index,
                   const XformWords& all, std::vector<XformCopy>& copies)
{
    for (std::size_t i = from; i < steps.size(); ++i) {
        if (steps[i] != "-a") {
            copy.words.push_back(steps[i]);
            continue;
        }
        const long long count = *parse_integer(steps[i + 1]);
        constexpr long long most_copies = 1'000'000;
        if (count > most_copies)
            refuse("-a");
        for (long long k = 0; k < count; ++k) {
            XformCopy next = copy;
            next.words.insert(next.words.end(), {"-i", std::to_string(k)});
            expand_arrays(steps, i + 2, next, index + (index.empty() ? "" : ".") + std::to_string(k), all, copies);
        }
        return;
    }
    if (!index.empty())
        copy.name = copy.name ? *copy.name + '.' + index : 'a' + index;
    copies.push_back(std::move(copy));
}

} // namespace

XformWords read_xform_words(const std::vector<std::string>& words, const std::string& place)
{
    XformWords all;
    std::optional<std::string> name;
    std::vector<std::string> steps;
    std::size_t next = 1;
    while (next < words.size() && words[next].size() > 1 && words[next][0] == '-') {
        const std::string& word = words[next];
        const std::size_t begin = next;
        if (numbers_after(word)) {
            const std::vector<std::string> step = transform_step(words, next);
            steps.insert(steps.end(), step.begin(), step.end());
            all.array = all.array || word == "-a";
            next += step.size();
        } else if (word == "-c" || word == "-e" || word == "-I") {
            all.expand = word == "-c" ? false : word == "-e" ? true : all.expand;
            all.inverted = all.inverted || word == "-I";
            ++next;
        } else if ((word == "-n" || word == "-m") && next + 1 < words.size()) {
            (word == "-n" ? name : all.modifier) = words[next + 1];
            next += 2;
        } else {
            refuse(word);
        }
        all.shown.insert(all.shown.end(), words.begin() + static_cast<std::ptrdiff_t>(begin),
                         words.begin() + static_cast<std::ptrdiff_t>(next));
    }
    all.files.assign(words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
    XformCopy first;
    first.name = name && !name->empty() ? name : std::nullopt;
    expand_arrays(steps, 0, first, "", all, all.copies);
    for (XformCopy& copy : all.copies) {
        std::size_t begin = 0;
        copy.map = read_placements(copy.words, begin, place).front().map;
        copy.scale = std::cbrt(std::fabs(copy.map.determinant()));
        if (!all.array)
            continue;
    }
    return all;
}

} // namespace lightwell::scene_text
