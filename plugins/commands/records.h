#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace lightwell::commands {

/// How numbers are written and read: text with tabs, 32-bit or 64-bit floating point, or (out only) 4-byte colours.
enum class NumberFormat : char { text = 'a', floats = 'f', doubles = 'd', colours = 'c' };
/// @throws Fatal for a letter that is none
NumberFormat number_format(char letter, const std::string& option, bool may_be_colours);
/// `ascii`, `float`, ... as headers name it.
std::string format_name(NumberFormat format);

/// Reads numbers one by one; text may hold them on any number of lines.
class NumberInput {
public:
    NumberInput(std::istream& in, NumberFormat format) : in_(in), format_(format) {}
    /// Nothing at the end of the input.
    /// @throws Fatal for what is no number
    std::optional<double> next();

private:
    std::istream& in_;
    NumberFormat format_;
};

/// Writes numbers; text is ended by a tab each.
class NumberOutput {
public:
    NumberOutput(std::ostream& out, NumberFormat format) : out_(out), format_(format) {}
    void number(double value);
    /// A colour: three numbers, or four bytes.
    void colour(const std::array<double, 3>& rgb);
    void word(const std::string& word);
    /// The end of a record: of a line, in text.
    void end();
    NumberFormat format() const { return format_; }

private:
    std::ostream& out_;
    NumberFormat format_;
};

} // namespace lightwell::commands
