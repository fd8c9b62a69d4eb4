#include "materials/patterns/data_table.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// More values than this (a gigabyte) are a mistake in the counts.
constexpr double most_values = 128e6;

/// Numbers of a text, one after the other.
class Numbers {
public:
    Numbers(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    bool at_end()
    {
        skip();
        return at_ == text_.size();
    }
    double next(const char* meaning)
    {
        if (at_end())
            throw InputError{place(), std::string("the file ends before ") + meaning, "the file may be cut off"};
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]))
            ++at_;
        const std::string_view token = text_.substr(begin, at_ - begin);
        const auto value = parse_double(token);
        if (!value || !std::isfinite(*value))
            throw InputError{place(), std::string(meaning) + " is \"" + std::string(token.substr(0, 40)) +
                                          "\", expected a finite number"};
        return *value;
    }
    std::size_t count(const char* meaning, double least, double most)
    {
        const double value = next(meaning);
        if (!(value >= least && value <= most) || value != std::floor(value))
            throw InputError{place(), std::string(meaning) + " is " + shortest(value) +
                                          ", expected a whole number from " + shortest(least) + " to " +
                                          shortest(most)};
        return static_cast<std::size_t>(value);
    }
    std::string place() const { return file_ + ':' + std::to_string(line_); }
    std::size_t left() const noexcept { return text_.size() - at_; }

private:
    static bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }
    void skip()
    {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '#')
                while (at_ + 1 < text_.size() && text_[at_] != '\n')
                    ++at_;
            if (text_[at_] == '\n')
                ++line_;
            else if (!is_blank(text_[at_]) && text_[at_] != '#')
                return;
        }
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0, line_ = 1;
};

DataTable::Dimension read_dimension(Numbers& numbers)
{
    DataTable::Dimension d;
    d.first = numbers.next("the first coordinate of a dimension");
    d.last = numbers.next("the last coordinate of a dimension");
    d.count = numbers.count("the number of values along a dimension", 2, most_values);
    if (d.first != d.last)
        return d;
    // Each coordinate takes at least two bytes: a count without the text to go with it takes no memory.
    for (std::size_t i = 0; i < d.count; ++i)
        d.coordinates.push_back(numbers.next("a coordinate"));
    const bool rising = d.coordinates[1] > d.coordinates[0];
    for (std::size_t i = 1; i < d.count; ++i)
        if (!(rising ? d.coordinates[i] > d.coordinates[i - 1] : d.coordinates[i] < d.coordinates[i - 1]))
            throw InputError{numbers.place(), "coordinate " + shortest(d.coordinates[i]) + " after " +
                                                  shortest(d.coordinates[i - 1]) + ": they go neither up nor down"};
    d.first = d.coordinates.front();
    d.last = d.coordinates.back();
    return d;
}

/// The step that holds a coordinate, and how far within it: below 0 and above 1 outside the table.
std::pair<std::size_t, double> step_of(const DataTable::Dimension& d, double coordinate) noexcept
{
    const auto last_step = static_cast<double>(d.count - 2);
    if (d.coordinates.empty()) {
        const double x = (coordinate - d.first) / (d.last - d.first) * static_cast<double>(d.count - 1);
        const double step = std::clamp(std::floor(x), 0.0, last_step);
        return {static_cast<std::size_t>(step), x - step};
    }
    const std::vector<double>& c = d.coordinates;
    const auto after = c[0] < c[1] ? std::upper_bound(c.begin(), c.end(), coordinate)
                                   : std::upper_bound(c.begin(), c.end(), coordinate, std::greater<>());
    const double found = static_cast<double>(after - c.begin()) - 1;
    const auto step = static_cast<std::size_t>(std::clamp(found, 0.0, last_step));
    return {step, (coordinate - c[step]) / (c[step + 1] - c[step])};
}

} // namespace

DataTable DataTable::parse(std::string_view text, const std::string& file)
{
    Numbers numbers(text, file);
    const std::size_t count = numbers.count("the number of dimensions", 1, most_dimensions);
    std::vector<Dimension> dimensions;
    double total = 1;
    for (std::size_t i = 0; i < count; ++i) {
        dimensions.push_back(read_dimension(numbers));
        total *= static_cast<double>(dimensions.back().count);
    }
    // A number and the blank behind it are two bytes.
    if (total > most_values || total > static_cast<double>(numbers.left() / 2 + 1))
        throw InputError{numbers.place(), "the counts ask for " + shortest(total) + " values, more than the file holds",
                         "check the counts"};
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(total));
    while (values.size() < static_cast<std::size_t>(total))
        values.push_back(numbers.next("a value"));
    return {std::move(dimensions), std::move(values)};
}

DataTable::DataTable(std::vector<Dimension> dimensions, std::vector<double> values)
    : dimensions_(std::move(dimensions)), strides_(dimensions_.size(), 1), values_(std::move(values))
{
    for (std::size_t i = dimensions_.size(); i-- > 1;)
        strides_[i - 1] = strides_[i] * dimensions_[i].count;
}

double DataTable::at(const double* coordinates) const noexcept
{
    for (std::size_t i = 0; i < dimensions_.size(); ++i)
        if (!std::isfinite(coordinates[i]))
            return 0;
    return within(0, 0, coordinates);
}

double DataTable::within(std::size_t dimension, std::size_t first, const double* coordinates) const noexcept
{
    if (dimension == dimensions_.size())
        return values_[first];
    const auto [step, x] = step_of(dimensions_[dimension], coordinates[dimension]);
    const double low = within(dimension + 1, first + step * strides_[dimension], coordinates);
    const double high = within(dimension + 1, first + (step + 1) * strides_[dimension], coordinates);
    if (x > 2)
        return (2 * high - low) / (x - 1);
    if (x < -1)
        return (2 * low - high) / -x;
    return low * (1 - x) + high * x;
}

} // namespace lightwell
