#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// One expression of the function-file language, as it was written.
struct Expression {
    enum class Kind { number, name, call, channel, negate, add, subtract, multiply, divide, power };

    Kind kind = Kind::number;
    double number = 0;             ///< value, or number of the channel
    std::string name = {};         ///< of a variable or function, as written
    std::vector<Expression> parts; ///< operands or arguments
    std::size_t line = 1;          ///< where it stands
    int depth = 1;                 ///< levels from here to the deepest part
};

/// `name = expression;`, `name : expression;`, `name(a, b) = expression;` or `$2 = expression;`
struct Definition {
    std::string name;    ///< as written; of an output channel `$2`
    std::string context; ///< of the text that it stands in, with a leading backquote, or empty
    bool is_function = false;
    bool constant = false; ///< defined with a colon
    std::vector<std::string> parameters;
    Expression body;
    std::string file; ///< for messages

    std::string place() const { return file + ':' + std::to_string(body.line); }
};

/// The definitions of a text, in order. Comments are `{ ... }`, nested; the last semicolon may be missing.
/// @param file     for messages
/// @param context  put on every definition
/// @throws InputError with file and line: syntax, brackets nested without reason, a number that is none
std::vector<Definition> parse_definitions(std::string_view text, const std::string& file,
                                          const std::string& context = {});

/// One expression that fills the whole text.
/// @throws InputError as above
Expression parse_expression(std::string_view text, const std::string& file);

} // namespace lightwell
