#include "importers/assimp/ifc_text.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/units.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace lightwell {
namespace {

using Id = std::uint64_t;
/// A product's GlobalId has so many characters.
constexpr std::size_t id_length = 22;
/// Places of attributes in the statements, from 0.
constexpr std::size_t product_representation = 6, layer_items = 2, shape_identifier = 1, shape_items = 3,
                      definition_shapes = 2, unit_kind = 1, unit_prefix = 2, unit_word = 3, conversion_name = 2;

/// `#12= IFCWALL('...',#3,...);` cut at the commas of its outermost brackets.
struct Statement {
    Id id;
    std::string_view type;
    std::vector<std::string_view> words;
};

/// End of a string that begins at `from` with a quote; two quotes stand for one.
std::size_t end_of_string(std::string_view text, std::size_t from)
{
    for (std::size_t at = from + 1; at < text.size(); ++at)
        if (text[at] == '\'') {
            if (at + 1 >= text.size() || text[at + 1] != '\'')
                return at + 1;
            ++at;
        }
    return text.size();
}

std::vector<std::string_view> words_of(std::string_view inside)
{
    std::vector<std::string_view> words;
    std::size_t begin = 0, depth = 0;
    for (std::size_t at = 0; at < inside.size();) {
        const char c = inside[at];
        if (c == '\'') {
            at = end_of_string(inside, at);
            continue;
        }
        depth += c == '(';
        depth -= c == ')' && depth > 0;
        if (c == ',' && depth == 0) {
            words.push_back(trimmed(inside.substr(begin, at - begin)));
            begin = at + 1;
        }
        ++at;
    }
    words.push_back(trimmed(inside.substr(begin)));
    return words;
}

/// Calls visit for each statement of the data section.
template <class Visit>
void visit_statements(std::string_view text, const Visit& visit)
{
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && text[end] != ';')
            end = text[end] == '\'' ? end_of_string(text, end) : end + 1;
        const std::string_view line = trimmed(text.substr(at, end - at));
        at = end + 1;
        const std::size_t equals = line.find('='), open = line.find('(');
        if (line.empty() || line[0] != '#' || open == std::string_view::npos || equals > open || line.back() != ')')
            continue;
        const auto id = parse_integer(trimmed(line.substr(1, equals - 1)));
        if (id && *id >= 0)
            visit(static_cast<Id>(*id), trimmed(line.substr(equals + 1, open - equals - 1)),
                  line.substr(open + 1, line.size() - open - 2));
    }
}

std::optional<Id> reference(std::string_view word)
{
    if (word.empty() || word[0] != '#')
        return {};
    const auto id = parse_integer(word.substr(1));
    return id && *id >= 0 ? std::optional<Id>(static_cast<Id>(*id)) : std::nullopt;
}

std::vector<Id> references(std::string_view list)
{
    std::vector<Id> ids;
    for (const std::string_view word : split(list, "(), \t\r\n"))
        if (const auto id = reference(word))
            ids.push_back(*id);
    return ids;
}

std::string_view unquoted(std::string_view word)
{
    return word.size() >= 2 && word.front() == '\'' && word.back() == '\'' ? word.substr(1, word.size() - 2)
                                                                           : std::string_view{};
}

struct Shape {
    bool body = false;
    std::vector<Id> items;
};

struct Product {
    std::string id;
    Id definition;
};

class IfcReader {
public:
    IfcText read(std::string_view text);

private:
    void take(const Statement& statement);
    void take_unit(const Statement& statement);
    std::string layer_of_shape(Id shape, int depth) const;
    std::string layer_of_definition(Id definition) const;
    void choose_unit(IfcText& result) const;

    struct Unit {
        double metres = 0;
        std::string name;
    };
    std::map<Id, std::string> layer_of_item_;
    std::map<Id, Shape> shapes_;
    std::map<Id, std::vector<Id>> definitions_;
    std::map<Id, Id> mapped_items_, maps_; ///< to the map, to the shape
    std::map<Id, Unit> length_units_;
    std::vector<Id> assigned_units_;
    std::vector<Product> products_;
    std::unordered_map<std::string, std::string> style_names_;
    std::size_t spaces_ = 0;
};

/// Source  ISO 10303-41, names of SI prefixes
double factor_of_prefix(std::string_view prefix)
{
    static const std::map<std::string_view, double> factors{{"$", 1},         {".MILLI.", 1e-3}, {".CENTI.", 1e-2},
                                                            {".DECI.", 1e-1}, {".KILO.", 1e3},   {".MICRO.", 1e-6},
                                                            {".DECA.", 10},   {".HECTO.", 100}};
    const auto found = factors.find(prefix);
    return found == factors.end() ? 0 : found->second;
}

void IfcReader::take_unit(const Statement& statement)
{
    const auto& words = statement.words;
    if (words.size() < 4 || words[unit_kind] != ".LENGTHUNIT.")
        return;
    if (statement.type == "IFCSIUNIT") {
        std::string name(words[unit_prefix] == "$" ? "" : words[unit_prefix]);
        name.append(words[unit_word]);
        std::erase(name, '.');
        length_units_[statement.id] = {factor_of_prefix(words[unit_prefix]), name};
        return;
    }
    const std::string name(unquoted(words[conversion_name]));
    try {
        length_units_[statement.id] = {parse_unit(lowercase_ascii(name)).value, name};
    } catch (const InputError&) {
        length_units_[statement.id] = {0, name};
    }
}

void IfcReader::take(const Statement& statement)
{
    const auto& words = statement.words;
    const auto list = [&](std::size_t word) {
        return word < words.size() ? references(words[word]) : std::vector<Id>{};
    };
    if (statement.type == "IFCPRESENTATIONLAYERASSIGNMENT" || statement.type == "IFCPRESENTATIONLAYERWITHSTYLE") {
        for (const Id item : list(layer_items))
            layer_of_item_.try_emplace(item, decode_step_string(unquoted(words[0])));
    } else if (statement.type == "IFCSHAPEREPRESENTATION") {
        const bool body = shape_identifier < words.size() && words[shape_identifier] == "'Body'";
        shapes_[statement.id] = {body, list(shape_items)};
    } else if (statement.type == "IFCPRODUCTDEFINITIONSHAPE") {
        definitions_[statement.id] = list(definition_shapes);
    } else if (statement.type == "IFCMAPPEDITEM") {
        if (const auto map = reference(words[0]))
            mapped_items_[statement.id] = *map;
    } else if (statement.type == "IFCREPRESENTATIONMAP" && words.size() > 1) {
        if (const auto shape = reference(words[1]))
            maps_[statement.id] = *shape;
    } else if (statement.type == "IFCSURFACESTYLE") {
        const std::string name = decode_step_string(unquoted(words[0]));
        std::string without_blanks = name;
        std::erase(without_blanks, ' ');
        style_names_.try_emplace(std::move(without_blanks), name);
    } else if (statement.type == "IFCUNITASSIGNMENT") {
        const std::vector<Id> units = list(0);
        assigned_units_.insert(assigned_units_.end(), units.begin(), units.end());
    } else if (statement.type == "IFCSIUNIT" || statement.type == "IFCCONVERSIONBASEDUNIT") {
        take_unit(statement);
    } else if (words.size() > product_representation && unquoted(words[0]).size() == id_length) {
        spaces_ += statement.type == "IFCSPACE";
        if (const auto definition = reference(words[product_representation]))
            products_.push_back({std::string(unquoted(words[0])), *definition});
    }
}

/// The layer of a shape, else of one of its items, else of the shape that a mapped item repeats.
std::string IfcReader::layer_of_shape(Id shape, int depth) const
{
    constexpr int deepest = 8; // of mapped items in mapped items
    if (const auto own = layer_of_item_.find(shape); own != layer_of_item_.end())
        return own->second;
    const auto known = shapes_.find(shape);
    if (known == shapes_.end() || depth > deepest)
        return {};
    for (const Id item : known->second.items) {
        if (const auto own = layer_of_item_.find(item); own != layer_of_item_.end())
            return own->second;
        const auto mapped = mapped_items_.find(item);
        const auto map = mapped == mapped_items_.end() ? maps_.end() : maps_.find(mapped->second);
        if (map == maps_.end())
            continue;
        if (std::string layer = layer_of_shape(map->second, depth + 1); !layer.empty())
            return layer;
    }
    return {};
}

std::string IfcReader::layer_of_definition(Id definition) const
{
    const auto known = definitions_.find(definition);
    if (known == definitions_.end())
        return {};
    for (const bool body : {true, false})
        for (const Id shape : known->second) {
            const auto found = shapes_.find(shape);
            if ((found != shapes_.end() && found->second.body) != body)
                continue;
            if (std::string layer = layer_of_shape(shape, 0); !layer.empty())
                return layer;
        }
    return {};
}

void IfcReader::choose_unit(IfcText& result) const
{
    for (const Id id : assigned_units_)
        if (const auto unit = length_units_.find(id); unit != length_units_.end() && result.unit_name.empty()) {
            result.metres_per_unit = unit->second.metres;
            result.unit_name = unit->second.name;
        }
}

IfcText IfcReader::read(std::string_view text)
{
    visit_statements(text, [&](Id id, std::string_view type, std::string_view inside) {
        // Points and edges are most of a file and of no interest here: none of them is cut into words.
        if (type.starts_with("IFCPRESENTATIONLAYER") || type == "IFCSHAPEREPRESENTATION" || type == "IFCMAPPEDITEM" ||
            type == "IFCPRODUCTDEFINITIONSHAPE" || type == "IFCREPRESENTATIONMAP" || type.ends_with("UNIT") ||
            type == "IFCUNITASSIGNMENT" || inside.starts_with('\''))
            take({id, type, words_of(inside)});
    });
    IfcText result;
    result.spaces = spaces_;
    result.style_names = std::move(style_names_);
    for (const Product& product : products_)
        if (std::string layer = layer_of_definition(product.definition); !layer.empty())
            result.layer_of_product.try_emplace(product.id, std::move(layer));
    choose_unit(result);
    return result;
}

int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
}

/// Reads `digits` hexadecimal digits at `at`; nothing when they are not there.
std::optional<char32_t> hex_number(std::string_view text, std::size_t at, std::size_t digits)
{
    char32_t value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
        const int digit = at + i < text.size() ? hex_digit(text[at + i]) : -1;
        if (digit < 0)
            return {};
        value = value * 16 + static_cast<char32_t>(digit);
    }
    return value;
}

} // namespace

IfcText read_ifc_text(std::string_view text)
{
    return IfcReader().read(text);
}

std::string decode_step_string(std::string_view text)
{
    std::string decoded;
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with("''") || rest.starts_with("\\\\")) {
            decoded += rest[0];
            at += 2;
        } else if (rest.starts_with("\\S\\") && rest.size() > 3) {
            decoded += utf8_of(static_cast<unsigned char>(rest[3]) + 128u);
            at += 4;
        } else if (const auto byte = hex_number(rest, 3, 2); rest.starts_with("\\X\\") && byte) {
            decoded += utf8_of(*byte);
            at += 5;
        } else if (rest.starts_with("\\X2\\")) {
            at += 4;
            for (auto unit = hex_number(text, at, 4); unit; unit = hex_number(text, at, 4)) {
                decoded += utf8_of(*unit);
                at += 4;
            }
            at += text.substr(at).starts_with("\\X0\\") ? 4 : 0;
        } else {
            decoded += text[at++];
        }
    }
    return to_utf8(decoded);
}

} // namespace lightwell
