#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// Values over a grid of one or more dimensions, at even or at given coordinates.
class DataTable {
public:
    static constexpr std::size_t most_dimensions = 8;
    struct Dimension {
        double first = 0, last = 1;
        std::size_t count = 0;
        std::vector<double> coordinates = {}; ///< of a dimension with given ones; rising or falling
    };

    /// A text of numbers: how many dimensions; for each its first and last coordinate and the number of values along it
    /// (0 0 N: N coordinates follow, at uneven distances); then the values, the last dimension running fastest.
    /// `#` begins a comment.
    /// @throws InputError with file and line: no number, counts without end, coordinates out of order, too few values
    static DataTable parse(std::string_view text, const std::string& file);
    DataTable(std::vector<Dimension> dimensions, std::vector<double> values);

    std::size_t dimensions() const noexcept { return dimensions_.size(); }
    const std::vector<Dimension>& axes() const noexcept { return dimensions_; }
    const std::vector<double>& values() const noexcept { return values_; } ///< the last dimension runs fastest
    /// Linear between the values; outside, continued for one step, then falling off with the distance.
    /// @param coordinates  one for each dimension
    double at(const double* coordinates) const noexcept;

private:
    double within(std::size_t dimension, std::size_t first, const double* coordinates) const noexcept;

    std::vector<Dimension> dimensions_;
    std::vector<std::size_t> strides_;
    std::vector<double> values_;
};

} // namespace lightwell
