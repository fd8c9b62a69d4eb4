#include "importers/obj/obj_lines.h"

#include "engine/base/text.h"

namespace lightwell {
namespace {

bool is_blank(char c) noexcept
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

} // namespace

bool ObjLines::next_physical(std::string_view& line)
{
    if (at_ >= text_.size())
        return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++physical_;
    if (!line.empty() && line.back() == '\r')
        line.remove_suffix(1);
    return true;
}

bool ObjLines::next(std::string_view& line)
{
    if (!next_physical(line))
        return false;
    number_ = physical_;
    if (line.empty() || line.back() != '\\')
        return true;
    joined_.clear();
    std::string_view piece = line;
    bool more = true;
    while (more && !piece.empty() && piece.back() == '\\') {
        joined_.append(piece.substr(0, piece.size() - 1)).push_back(' ');
        piece = {};
        more = next_physical(piece);
    }
    joined_.append(piece);
    line = joined_;
    return true;
}

std::string_view next_word(std::string_view& rest) noexcept
{
    std::size_t begin = 0;
    while (begin < rest.size() && is_blank(rest[begin]))
        ++begin;
    if (begin == rest.size() || rest[begin] == '#') {
        rest = {};
        return {};
    }
    std::size_t end = begin;
    while (end < rest.size() && !is_blank(rest[end]))
        ++end;
    const std::string_view word = rest.substr(begin, end - begin);
    rest.remove_prefix(end);
    return word;
}

std::string_view name_in(std::string_view rest) noexcept
{
    for (std::size_t at = rest.find('#'); at != std::string_view::npos; at = rest.find('#', at + 1)) {
        const bool starts = at == 0 || is_blank(rest[at - 1]);
        const bool ends = at + 1 == rest.size() || is_blank(rest[at + 1]);
        if (starts && ends) {
            rest = rest.substr(0, at);
            break;
        }
    }
    return trimmed(rest);
}

} // namespace lightwell
