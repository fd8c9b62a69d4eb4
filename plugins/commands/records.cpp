#include "plugins/commands/records.h"

#include "engine/base/text.h"
#include "engine/pictures/rgbe.h"
#include "plugins/commands/command.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <istream>
#include <ostream>

namespace lightwell::commands {
namespace {

template <class T>
std::optional<double> binary(std::istream& in)
{
    T value;
    if (!in.read(reinterpret_cast<char*>(&value), sizeof value))
        return std::nullopt;
    return static_cast<double>(value);
}

template <class T>
void write(std::ostream& out, T value)
{
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

NumberFormat number_format(char letter, const std::string& option, bool may_be_colours)
{
    if (letter == 'a' || letter == 'f' || letter == 'd' || (letter == 'c' && may_be_colours))
        return static_cast<NumberFormat>(letter);
    throw Fatal("command line error at '" + option + "'");
}

std::string format_name(NumberFormat format)
{
    switch (format) {
    case NumberFormat::floats:
        return "float";
    case NumberFormat::doubles:
        return "double";
    case NumberFormat::colours:
        return "32-bit_rle_rgbe";
    default:
        return "ascii";
    }
}

std::optional<double> NumberInput::next()
{
    if (format_ == NumberFormat::floats)
        return binary<float>(in_);
    if (format_ == NumberFormat::doubles)
        return binary<double>(in_);
    std::string word;
    if (!(in_ >> word))
        return std::nullopt;
    const auto value = parse_double(word);
    if (!value)
        throw Fatal("bad number on standard input: \"" + word.substr(0, 40) + "\"");
    return value;
}

void NumberOutput::number(double value)
{
    if (format_ == NumberFormat::floats)
        return write(out_, static_cast<float>(value));
    if (format_ == NumberFormat::doubles)
        return write(out_, value);
    char text[32];
    std::snprintf(text, sizeof text, "%.6e\t", value);
    out_ << text;
}

void NumberOutput::colour(const std::array<double, 3>& rgb)
{
    if (format_ != NumberFormat::colours) {
        for (const double value : rgb)
            number(value);
        return;
    }
    const auto bytes = encode_rgbe(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void NumberOutput::word(const std::string& word)
{
    out_ << word << '\t';
}

void NumberOutput::end()
{
    if (format_ == NumberFormat::text)
        out_ << '\n';
}

} // namespace lightwell::commands
