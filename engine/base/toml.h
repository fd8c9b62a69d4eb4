#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// A table of a TOML file whose values know their lines, so that every complaint names the place. Dates are texts.
class TomlTable {
public:
    /// `map.toml:12`, where the table begins.
    const std::string& place() const noexcept { return place_; }
    int line() const noexcept { return line_; }
    /// `map.toml:14`, where the value stands; the table's place when there is none.
    std::string place_of(const std::string& word) const;
    bool has(const std::string& word) const { return values_.contains(word); }
    /// @throws InputError for a word of the table that is not in the list, with the nearest ones
    void expect_words(std::initializer_list<const char*> known) const;

    // Each returns nothing (an empty list, a null pointer) when the word is absent.
    // @throws InputError when the value has another type than the one asked for
    std::optional<std::string> text(const std::string& word) const;
    std::optional<double> number(const std::string& word) const;
    std::optional<bool> boolean(const std::string& word) const;
    /// A text or a list of texts.
    std::vector<std::string> texts(const std::string& word) const;
    std::vector<double> numbers(const std::string& word) const;
    const TomlTable* table(const std::string& word) const;
    /// `[[word]]`, in the order of the file.
    std::vector<const TomlTable*> tables(const std::string& word) const;

    /// A value of the file; only the reader knows what is inside.
    struct Value;

private:
    friend struct TomlReader;
    const Value* find(const std::string& word) const;
    [[noreturn]] void reject(const std::string& word, const std::string& expected) const;
    std::map<std::string, std::shared_ptr<const Value>> values_;
    std::string file_, place_;
    int line_ = 0;
};

/// @throws InputError with file and line for what is no TOML
TomlTable parse_toml(std::string_view text, const std::string& file_name);
/// @throws InputError also for a missing or absurdly large file
TomlTable read_toml(const std::filesystem::path& file);
/// A text in quotes, escaped so that it reads back to the same text.
std::string toml_quoted(std::string_view text);

} // namespace lightwell
