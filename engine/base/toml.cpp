#include "engine/base/toml.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"

#include <algorithm>
#include <sstream>
#include <toml++/toml.h>
#include <variant>

namespace lightwell {

struct TomlTable::Value {
    std::variant<bool, double, std::string, std::vector<std::shared_ptr<const Value>>, TomlTable> what;
    int line = 0;
};

/// Turns the parser's tree into ours.
struct TomlReader {
    using Value = TomlTable::Value;
    std::string file;

    TomlTable table(const toml::table& source, int line) const
    {
        TomlTable result;
        result.file_ = file;
        result.line_ = line;
        result.place_ = line > 0 ? file + ':' + std::to_string(line) : file;
        for (const auto& [key, node] : source)
            result.values_.emplace(std::string(key.str()), value(node, static_cast<int>(key.source().begin.line)));
        return result;
    }

    /// @param line  of the key; for tables of `[[name]]` their own line is better
    std::shared_ptr<const Value> value(const toml::node& node, int line) const
    {
        auto result = std::make_shared<Value>();
        result->line = line;
        if (const toml::table* inner = node.as_table()) {
            const auto own = static_cast<int>(node.source().begin.line);
            result->what = table(*inner, own > 0 ? own : line);
        } else if (const toml::array* list = node.as_array()) {
            std::vector<std::shared_ptr<const Value>> items;
            for (const toml::node& item : *list)
                items.push_back(value(item, static_cast<int>(item.source().begin.line)));
            result->what = std::move(items);
        } else if (const auto* flag = node.as_boolean()) {
            result->what = flag->get();
        } else if (node.is_number()) {
            result->what = node.value<double>().value_or(0);
        } else if (const auto* text = node.as_string()) {
            result->what = text->get();
        } else {
            result->what = date(node);
        }
        return result;
    }

    static std::string date(const toml::node& node)
    {
        std::ostringstream text;
        if (const auto* both = node.as_date_time())
            text << both->get();
        else if (const auto* day = node.as_date())
            text << day->get();
        else if (const auto* time = node.as_time())
            text << time->get();
        return text.str();
    }
};

namespace {

std::string described(const TomlTable::Value& value)
{
    if (const auto* flag = std::get_if<bool>(&value.what))
        return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&value.what))
        return shortest(*number);
    if (const auto* text = std::get_if<std::string>(&value.what))
        return '"' + *text + '"';
    return std::holds_alternative<TomlTable>(value.what) ? "a table" : "a list";
}

} // namespace

const TomlTable::Value* TomlTable::find(const std::string& word) const
{
    const auto entry = values_.find(word);
    return entry == values_.end() ? nullptr : entry->second.get();
}

std::string TomlTable::place_of(const std::string& word) const
{
    const Value* value = find(word);
    return value && value->line > 0 ? file_ + ':' + std::to_string(value->line) : place_;
}

void TomlTable::reject(const std::string& word, const std::string& expected) const
{
    throw InputError{place_of(word), word + " is " + described(*find(word)) + ", expected " + expected};
}

void TomlTable::expect_words(std::initializer_list<const char*> known) const
{
    for (const auto& [word, value] : values_)
        if (std::none_of(known.begin(), known.end(), [&](const char* good) { return word == good; }))
            throw InputError{place_of(word), "unknown word \"" + word + '"',
                             nearest_hint(word, {known.begin(), known.end()}, known.size())};
}

std::optional<std::string> TomlTable::text(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return std::nullopt;
    if (const auto* text = std::get_if<std::string>(&value->what))
        return *text;
    reject(word, "a text in quotes");
}

std::optional<double> TomlTable::number(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return std::nullopt;
    if (const auto* number = std::get_if<double>(&value->what))
        return *number;
    reject(word, "a number");
}

std::optional<bool> TomlTable::boolean(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return std::nullopt;
    if (const auto* flag = std::get_if<bool>(&value->what))
        return *flag;
    reject(word, "true or false");
}

std::vector<std::string> TomlTable::texts(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return {};
    if (const auto* text = std::get_if<std::string>(&value->what))
        return {*text};
    std::vector<std::string> result;
    if (const auto* list = std::get_if<std::vector<std::shared_ptr<const Value>>>(&value->what)) {
        for (const auto& item : *list)
            if (const auto* text = std::get_if<std::string>(&item->what))
                result.push_back(*text);
        if (result.size() == list->size())
            return result;
    }
    reject(word, "a text in quotes or a list of texts");
}

std::vector<double> TomlTable::numbers(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return {};
    std::vector<double> result;
    if (const auto* list = std::get_if<std::vector<std::shared_ptr<const Value>>>(&value->what)) {
        for (const auto& item : *list)
            if (const auto* number = std::get_if<double>(&item->what))
                result.push_back(*number);
        if (result.size() == list->size())
            return result;
    }
    reject(word, "a list of numbers");
}

const TomlTable* TomlTable::table(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return nullptr;
    if (const auto* table = std::get_if<TomlTable>(&value->what))
        return table;
    reject(word, "a table [" + word + ']');
}

std::vector<const TomlTable*> TomlTable::tables(const std::string& word) const
{
    const Value* value = find(word);
    if (!value)
        return {};
    std::vector<const TomlTable*> result;
    if (const auto* list = std::get_if<std::vector<std::shared_ptr<const Value>>>(&value->what)) {
        for (const auto& item : *list)
            if (const auto* table = std::get_if<TomlTable>(&item->what))
                result.push_back(table);
        if (result.size() == list->size())
            return result;
    }
    reject(word, "tables [[" + word + "]]");
}

TomlTable parse_toml(std::string_view text, const std::string& file_name)
{
    try {
        return TomlReader{file_name}.table(toml::parse(text), 0);
    } catch (const toml::parse_error& error) {
        throw InputError{file_name + ':' + std::to_string(error.source().begin.line),
                         "is no TOML: " + std::string(error.description()), "texts stand in quotes: name = \"value\""};
    }
}

TomlTable read_toml(const std::filesystem::path& file)
{
    const MappedFile mapped{file};
    // Written by people: a larger file is another kind of file under this name.
    constexpr std::size_t most_bytes = 16u << 20;
    if (mapped.bytes().size() > most_bytes)
        throw InputError{file.string(), "has " + std::to_string(mapped.bytes().size()) + " bytes, expected at most " +
                                            std::to_string(most_bytes) + " in a TOML file"};
    return parse_toml(mapped.bytes(), file.string());
}

std::string toml_quoted(std::string_view text)
{
    constexpr char digits[] = "0123456789ABCDEF";
    std::string quoted = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            quoted += {'\\', c};
        else if (byte < 0x20 || byte == 0x7F)
            quoted += {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 15]};
        else
            quoted += c;
    }
    return quoted + '"';
}

} // namespace lightwell
