#include "plugins/commands/mapping_rules.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cctype>

namespace lightwell::commands {

/// The words of a mapping file, one after the other: `( ) ; [ : ]`, quoted names and plain ones.
class MappingRules::Reader {
public:
    Reader(std::string_view text, const std::string& file, const std::vector<std::string>& known)
        : text_(text), file_(file), known_(known)
    {
    }

    std::vector<Rule> rules()
    {
        std::vector<Rule> all;
        for (std::string first = word(); !first.empty(); first = word()) {
            if (is_mark(first))
                fail("\"" + first + "\" where a material is expected");
            Rule rule{plain(first), {}};
            for (std::string next = word(); next != ";"; next = word()) {
                if (next != "(")
                    fail(next.empty() ? "the last rule does not end" : "\"" + next + "\" where ( or ; is expected");
                rule.conditions.push_back(condition());
            }
            all.push_back(std::move(rule));
        }
        return all;
    }

private:
    Condition condition()
    {
        Condition made;
        made.qualifier = plain(word());
        if (std::find(known_.begin(), known_.end(), made.qualifier) == known_.end())
            fail("qualifier \"" + made.qualifier + "\" is not known",
                 "there are Material, Map, Group, Object and Face");
        std::string value = word();
        if (value == "[") {
            const long long first = whole_number();
            expect(":");
            made.range = std::pair(first, whole_number());
            expect("]");
        } else if (value.empty() || is_mark(value)) {
            fail("no value behind qualifier \"" + made.qualifier + "\"");
        } else {
            made.name = plain(value);
        }
        expect(")");
        return made;
    }
    long long whole_number()
    {
        const std::string text = word();
        const auto number = parse_integer(text);
        if (!number)
            fail("\"" + text + "\" where a whole number is expected");
        return *number;
    }
    void expect(const std::string& mark)
    {
        if (const std::string found = word(); found != mark)
            fail("\"" + found + "\" where " + mark + " is expected");
    }
    static bool is_mark(const std::string& word) { return word.size() == 1 && marks.find(word[0]) != marks.npos; }
    /// Without the sign that a quoted name begins with.
    static std::string plain(const std::string& word) { return word.starts_with('"') ? word.substr(1) : word; }

    std::string word()
    {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '#')
                at_ = std::min(text_.find('\n', at_), text_.size() - 1);
            line_ += text_[at_] == '\n' ? 1 : 0;
            if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0 && text_[at_] != '#')
                break;
        }
        if (at_ >= text_.size())
            return {};
        if (text_[at_] == '"') {
            const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
            if (end == text_.npos || text_[end] == '\n')
                fail("a quoted name does not end");
            std::string quoted(text_.substr(at_, end - at_));
            at_ = end + 1;
            return quoted;
        }
        if (marks.find(text_[at_]) != marks.npos)
            return std::string(1, text_[at_++]);
        const std::size_t begin = at_;
        while (at_ < text_.size() && marks.find(text_[at_]) == marks.npos &&
               std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
            ++at_;
        return std::string(text_.substr(begin, at_ - begin));
    }
    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const
    {
        throw InputError{file_ + ':' + std::to_string(line_), what,
                         hint.empty() ? "a rule is MATERIAL (QUALIFIER VALUE) ... ;" : hint};
    }

    static constexpr std::string_view marks = "();[:]";
    std::string_view text_;
    const std::string& file_;
    const std::vector<std::string>& known_;
    std::size_t at_ = 0;
    int line_ = 1;
};

MappingRules::MappingRules(std::string_view text, const std::string& file, const std::vector<std::string>& known)
    : rules_(Reader(text, file, known).rules())
{
}

bool MappingRules::Condition::holds(const Qualities& qualities) const
{
    const auto found = qualities.find(qualifier);
    if (found == qualities.end())
        return false;
    return std::any_of(found->second.begin(), found->second.end(), [&](const std::string& quality) {
        if (!range)
            return quality == name;
        const auto number = parse_integer(quality);
        return number && *number >= range->first && *number <= range->second;
    });
}

std::optional<std::string> MappingRules::material_of(const Qualities& qualities) const
{
    const auto found = std::find_if(rules_.rbegin(), rules_.rend(), [&](const Rule& rule) {
        return std::all_of(rule.conditions.begin(), rule.conditions.end(),
                           [&](const Condition& condition) { return condition.holds(qualities); });
    });
    if (found == rules_.rend() || found->material == "void")
        return std::nullopt;
    return found->material;
}

} // namespace lightwell::commands
