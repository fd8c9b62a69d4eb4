#include "importers/radiance/words.h"

#include "engine/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

constexpr bool is_blank(char c) noexcept
{
    return static_cast<unsigned char>(c) <= ' ';
}

/// Long words are cut in messages.
std::string shown(std::string_view word)
{
    constexpr std::size_t longest = 40;
    return word.size() <= longest ? std::string(word) : std::string(word.substr(0, longest)) + "...";
}

} // namespace

Words::Words(std::string_view text, std::string file_name) : text_(text), file_name_(std::move(file_name))
{
    if (text_.starts_with("\xEF\xBB\xBF"))
        text_.remove_prefix(3);
}

void Words::skip_blanks() noexcept
{
    while (at_ < text_.size() && is_blank(text_[at_]))
        ++at_;
}

void Words::skip_blanks_and_comments() noexcept
{
    for (skip_blanks(); at_ < text_.size() && text_[at_] == '#'; skip_blanks())
        comment();
}

Words::Next Words::next() noexcept
{
    skip_blanks();
    if (at_ == text_.size())
        return Next::end;
    return text_[at_] == '#' ? Next::comment : text_[at_] == '!' ? Next::command : Next::primitive;
}

std::string_view Words::comment() noexcept
{
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

std::string Words::command()
{
    std::string whole;
    for (;;) {
        std::string_view line = comment();
        const bool goes_on = line.ends_with('\\');
        if (goes_on)
            line.remove_suffix(1);
        whole += line;
        if (!goes_on || at_ == text_.size())
            return whole;
        whole += ' ';
        ++at_;
    }
}

std::string_view Words::word() noexcept
{
    skip_blanks();
    if (at_ == text_.size())
        return {};
    const char quote = text_[at_];
    if (quote == '"' || quote == '\'') {
        const std::size_t end = text_.find_first_of(quote == '"' ? "\"\n" : "'\n", at_ + 1);
        if (end != std::string_view::npos && text_[end] == quote) {
            const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
            at_ = end + 1;
            return inside;
        }
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

void Words::truncated(const Primitive& primitive, const std::string& missing) const
{
    throw InputError{place(primitive), "the file ends before " + missing, "the file may be cut off"};
}

std::size_t Words::count(const Primitive& primitive, const char* of_what)
{
    skip_blanks_and_comments();
    if (at_ == text_.size())
        truncated(primitive, fmt::format("the number of its {}", of_what));
    const std::size_t begin = at_;
    const std::string_view token = word();
    const auto value = parse_integer(token);
    if (!value || *value < 0)
        throw InputError{place(begin) + fmt::format(": {} \"{}\"", primitive.type, decoded_name(primitive.name)),
                         fmt::format("the number of {} is \"{}\", expected a count", of_what, shown(token)),
                         "after the name come three lists: words, integers, numbers, each with its count first"};
    return static_cast<std::size_t>(*value);
}

double Words::number(const Primitive& primitive)
{
    skip_blanks_and_comments();
    const char* const begin = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    double value = 0;
    const auto [stop, code] = std::from_chars(begin, end, value);
    if (code == std::errc{} && (stop == end || is_blank(*stop)) && std::isfinite(value)) {
        at_ = static_cast<std::size_t>(stop - text_.data());
        return value;
    }
    const std::size_t offset = at_;
    const std::size_t index = primitive.numbers.size() + 1;
    if (at_ == text_.size())
        truncated(primitive, fmt::format("its number {}", index));
    const std::string_view token = word();
    const auto careful = parse_double(token);
    if (!careful || !std::isfinite(*careful))
        throw InputError{place(offset) + fmt::format(": {} \"{}\"", primitive.type, decoded_name(primitive.name)),
                         fmt::format("number {} is \"{}\", expected a finite number", index, shown(token)),
                         careful ? "correct the value" : "check the count before the numbers"};
    return *careful;
}

void Words::read(Primitive& primitive)
{
    primitive.words.clear();
    primitive.numbers.clear();
    skip_blanks();
    primitive.offset = at_;
    primitive.modifier = word();
    primitive.type = word();
    primitive.name = word();
    if (primitive.name.empty() && at_ == text_.size())
        throw InputError{place(primitive.offset),
                         fmt::format("the file ends after \"{}\", expected `modifier type name`",
                                     shown(text_.substr(primitive.offset))),
                         "the file may be cut off"};
    if (primitive.type == "alias")
        return;
    for (std::size_t left = count(primitive, "words"); left > 0; --left) {
        skip_blanks();
        if (at_ == text_.size())
            truncated(primitive, fmt::format("its word {}", primitive.words.size() + 1));
        primitive.words.push_back(word());
    }
    for (std::size_t left = count(primitive, "integers"); left > 0; --left)
        number(primitive);
    for (std::size_t left = count(primitive, "numbers"); left > 0; --left)
        primitive.numbers.push_back(number(primitive));
}

std::string_view Words::alias_target(const Primitive& primitive)
{
    skip_blanks_and_comments();
    const std::string_view target = word();
    if (target.empty())
        truncated(primitive, "the name that it stands for");
    return target;
}

std::string Words::place(std::size_t offset) const
{
    if (offset < counted_to_) {
        counted_to_ = 0;
        lines_ = 1;
    }
    const auto from = text_.begin() + static_cast<std::ptrdiff_t>(counted_to_);
    const auto to = text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
    lines_ += static_cast<std::size_t>(std::count(from, to, '\n'));
    counted_to_ = std::min(offset, text_.size());
    return fmt::format("{}:{}", file_name_, lines_);
}

std::string Words::place(const Primitive& primitive) const
{
    return fmt::format("{}: {} \"{}\"", place(primitive.offset), shown(primitive.type), decoded_name(primitive.name));
}

std::vector<std::string> command_words(const std::string& command, const std::string& place)
{
    std::vector<std::string> words;
    char quote = 0;
    bool inside = false;
    for (const char c : command) {
        if (quote != 0) {
            if (c == quote)
                quote = 0;
            else
                words.back() += c;
            continue;
        }
        if (std::string_view("|<>;&$`").find(c) != std::string_view::npos)
            throw InputError{place, fmt::format("the command uses \"{}\"; only a plain !xform is answered", c),
                             "run it, write its output to a file and name the file with !xform"};
        if (is_blank(c)) {
            inside = false;
            continue;
        }
        if (!inside)
            words.emplace_back();
        inside = true;
        if (c == '"' || c == '\'')
            quote = c;
        else
            words.back() += c;
    }
    if (quote != 0)
        throw InputError{place, fmt::format("a quotation begun with {} does not end", quote), "close it"};
    return words;
}

std::string encoded_name(const std::string& name)
{
    std::string word = percent_encoded(name);
    // Words that the language keeps for itself, and characters that mean something at the beginning of a word.
    if (word == "void" || word == "inherit" || std::string_view("!\"'").find(word[0]) != std::string_view::npos) {
        constexpr char digits[] = "0123456789ABCDEF";
        const auto byte = static_cast<unsigned char>(word[0]);
        word = std::string{'%', digits[byte >> 4], digits[byte & 15]} + word.substr(1);
    }
    return word;
}

std::string decoded_name(std::string_view word)
{
    if (std::all_of(word.begin(), word.end(), [](char c) { return c > 0 && c != '%'; }))
        return std::string(word);
    return to_utf8(percent_decoded(word));
}

} // namespace lightwell::scene_text
