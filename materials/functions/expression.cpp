#include "materials/functions/expression.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Operands within operands: more than any formula, few enough for the stack of whoever walks the tree.
constexpr int deepest_expression = 1000;
/// More parameters than any function has.
constexpr std::size_t most_parameters = 32;

bool begins_name(char c) noexcept
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '`';
}

bool is_digit(char c) noexcept
{
    return c >= '0' && c <= '9';
}

bool continues_name(char c) noexcept
{
    return begins_name(c) || is_digit(c) || c == '.';
}

/// Recursive descent, one function for each rank of operators.
/// Unary minus binds tighter than a power and stands only before a number, name, channel or bracket: `-2^2` is 4,
/// `2--3` is 5, `- -3` is an error. Powers group from the right.
class Parser {
public:
    Parser(std::string_view text, const std::string& file) : text_(text), file_(file) { skip_blanks(); }

    bool at_end() const noexcept { return at_ >= text_.size(); }

    Definition definition()
    {
        Definition found;
        found.file = file_;
        if (peek() == '$')
            found.name = '$' + std::to_string(channel_number());
        else
            found.name = name();
        if (take('(')) {
            found.is_function = true;
            found.parameters = parameters();
        }
        found.constant = peek() == ':';
        if (!take(':') && !take('='))
            fail("expected = or : after the name " + found.name);
        found.body = sum();
        if (!at_end() && !take(';'))
            fail("expected an operator or ;");
        return found;
    }
    Expression whole()
    {
        Expression found = sum();
        if (!at_end())
            fail("expected an operator or the end of the expression");
        return found;
    }
    /// Empty statements are allowed.
    bool take_semicolon() { return take(';'); }

private:
    char peek() const noexcept { return at_end() ? '\0' : text_[at_]; }
    bool take(char c)
    {
        if (peek() != c)
            return false;
        ++at_;
        skip_blanks();
        return true;
    }
    void skip_blanks()
    {
        int braces = 0;
        std::size_t opened = line_;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n')
                ++line_;
            if (c == '{' && braces++ == 0)
                opened = line_;
            else if (c == '}' && braces == 0)
                fail("a } without its {");
            else if (c == '}')
                --braces;
            else if (braces == 0 && c != ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v')
                return;
        }
        if (braces > 0)
            throw InputError{file_ + ':' + std::to_string(opened), "a comment that begins here never ends",
                             "close it with }"};
    }
    [[noreturn]] void fail(const std::string& what) const
    {
        const std::string_view next = text_.substr(at_, std::min<std::size_t>(text_.find('\n', at_) - at_, 12));
        const std::string found = at_end() ? "the end of the text" : "\"" + std::string(next) + '"';
        throw InputError{file_ + ':' + std::to_string(line_), what + ", found " + found};
    }
    std::string name()
    {
        if (!begins_name(peek()))
            fail("expected a name");
        const std::size_t begin = at_;
        while (!at_end() && continues_name(text_[at_]))
            ++at_;
        std::string found(text_.substr(begin, at_ - begin));
        skip_blanks();
        return found;
    }
    std::vector<std::string> parameters()
    {
        std::vector<std::string> names{name()};
        while (take(','))
            names.push_back(name());
        if (!take(')'))
            fail("expected , or ) in the list of parameters");
        if (names.size() > most_parameters)
            fail("more than " + std::to_string(most_parameters) + " parameters");
        return names;
    }
    double number()
    {
        const std::size_t begin = at_;
        const auto digits = [&] {
            while (is_digit(peek()))
                ++at_;
        };
        digits();
        if (peek() == '.')
            ++at_;
        digits();
        if (peek() == 'e' || peek() == 'E') {
            const std::size_t mark = at_++;
            if (peek() == '+' || peek() == '-')
                ++at_;
            if (is_digit(peek()))
                digits();
            else
                at_ = mark;
        }
        const auto value = parse_double(text_.substr(begin, at_ - begin));
        if (!value) {
            at_ = begin;
            fail("expected a number");
        }
        skip_blanks();
        return *value;
    }
    long channel_number()
    {
        ++at_; // the dollar sign
        constexpr double most_channels = 10000;
        const double found = is_digit(peek()) ? number() : -1;
        if (!(found >= 0 && found <= most_channels) || found != static_cast<long>(found))
            fail("a channel is $ and a whole number");
        return static_cast<long>(found);
    }
    Expression made(Expression::Kind kind, std::vector<Expression> parts) const
    {
        Expression made;
        made.kind = kind;
        made.line = line_;
        for (const Expression& part : parts)
            made.depth = std::max(made.depth, part.depth + 1);
        if (made.depth > deepest_expression)
            fail("an expression with operands nested more than " + std::to_string(deepest_expression) + " deep");
        made.parts = std::move(parts);
        return made;
    }
    Expression joined(Expression::Kind kind, Expression left, Expression right) const
    {
        std::vector<Expression> parts;
        parts.push_back(std::move(left));
        parts.push_back(std::move(right));
        return made(kind, std::move(parts));
    }
    Expression sum()
    {
        if (++nested_ > deepest_expression / 4)
            fail("brackets nested more than " + std::to_string(deepest_expression / 4) + " deep");
        Expression left = product();
        for (;;) {
            if (take('+'))
                left = joined(Expression::Kind::add, std::move(left), product());
            else if (take('-'))
                left = joined(Expression::Kind::subtract, std::move(left), product());
            else
                break;
        }
        --nested_;
        return left;
    }
    Expression product()
    {
        Expression left = power();
        for (;;) {
            if (take('*'))
                left = joined(Expression::Kind::multiply, std::move(left), power());
            else if (take('/'))
                left = joined(Expression::Kind::divide, std::move(left), power());
            else
                return left;
        }
    }
    Expression power()
    {
        std::vector<Expression> chain;
        chain.push_back(with_sign());
        while (take('^'))
            chain.push_back(with_sign());
        Expression right = std::move(chain.back());
        for (std::size_t i = chain.size() - 1; i-- > 0;)
            right = joined(Expression::Kind::power, std::move(chain[i]), std::move(right));
        return right;
    }
    Expression with_sign()
    {
        if (take('-')) {
            Expression value = primary();
            if (value.kind != Expression::Kind::number) {
                std::vector<Expression> parts;
                parts.push_back(std::move(value));
                return made(Expression::Kind::negate, std::move(parts));
            }
            value.number = -value.number;
            return value;
        }
        take('+');
        return primary();
    }
    Expression primary()
    {
        if (take('(')) {
            Expression inner = sum();
            if (!take(')'))
                fail("expected an operator or )");
            return inner;
        }
        Expression found;
        found.line = line_;
        if (peek() == '$') {
            found.kind = Expression::Kind::channel;
            found.number = static_cast<double>(channel_number());
            return found;
        }
        if (begins_name(peek()))
            return name_or_call();
        if (!is_digit(peek()) && peek() != '.')
            fail("expected a number, a name or (");
        found.number = number();
        return found;
    }
    Expression name_or_call()
    {
        std::string called = name();
        std::vector<Expression> arguments;
        const bool is_call = take('(');
        if (is_call) {
            do
                arguments.push_back(sum());
            while (take(','));
            if (!take(')'))
                fail("expected , or ) in the arguments of " + called);
        }
        Expression found = made(is_call ? Expression::Kind::call : Expression::Kind::name, std::move(arguments));
        found.name = std::move(called);
        return found;
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0, line_ = 1;
    int nested_ = 0;
};

} // namespace

std::vector<Definition> parse_definitions(std::string_view text, const std::string& file, const std::string& context)
{
    Parser parser(text, file);
    std::vector<Definition> found;
    while (!parser.at_end()) {
        if (parser.take_semicolon())
            continue;
        found.push_back(parser.definition());
        found.back().context = context;
    }
    return found;
}

Expression parse_expression(std::string_view text, const std::string& file)
{
    return Parser(text, file).whole();
}

} // namespace lightwell
