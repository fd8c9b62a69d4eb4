#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell::commands {

/// Rules that say which material a surface has: `MATERIAL (QUALIFIER VALUE) ... ;`, where a value is a name, a whole
/// number or a range of them, `[FIRST:LAST]`. `#` begins a comment.
/// Source  the mapping files of Radiance's translators
class MappingRules {
public:
    /// @param known  the qualifiers that a rule may name
    /// @throws InputError with file and line
    MappingRules(std::string_view text, const std::string& file, const std::vector<std::string>& known);

    /// What a surface has to say to each qualifier: its names, of which one has to fit; a number as text.
    using Qualities = std::map<std::string, std::vector<std::string>>;
    /// The material of the last rule whose conditions all hold; nothing where none does, or where it says `void`.
    std::optional<std::string> material_of(const Qualities& qualities) const;

private:
    struct Condition {
        std::string qualifier, name;
        std::optional<std::pair<long long, long long>> range;
        bool holds(const Qualities& qualities) const;
    };
    struct Rule {
        std::string material;
        std::vector<Condition> conditions;
    };
    class Reader;
    std::vector<Rule> rules_;
};

} // namespace lightwell::commands
