#include "materials/measured/matrix_table.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

DiscPoint turned_round(const DiscPoint& p, bool turned)
{
    return turned ? DiscPoint{-p.x, -p.y} : p;
}

} // namespace

MatrixTable::MatrixTable(AngleBasis incident, AngleBasis outgoing, std::vector<double> values, bool turned)
    : incident_(std::move(incident)), outgoing_(std::move(outgoing)), turned_(turned)
{
    const int ins = incident_.size(), outs = outgoing_.size();
    values_.resize(values.size());
    summed_.resize(values.size());
    for (int i = 0; i < ins; ++i) {
        double sum = 0;
        for (int o = 0; o < outs; ++o) {
            const double value =
                values[static_cast<std::size_t>(o) * static_cast<std::size_t>(ins) + static_cast<std::size_t>(i)];
            values_[at(i, o)] = value;
            summed_[at(i, o)] = sum += value * outgoing_.projected_sr(o);
        }
        most_ = std::fmax(most_, sum);
    }
    least_ = *std::min_element(values_.begin(), values_.end());
}

std::size_t MatrixTable::at(int incident, int outgoing) const noexcept
{
    return static_cast<std::size_t>(incident) * static_cast<std::size_t>(outgoing_.size()) +
           static_cast<std::size_t>(outgoing);
}

int MatrixTable::incident_patch(const DiscPoint& in) const noexcept
{
    return incident_.patch_at(turned_round(in, turned_));
}

int MatrixTable::outgoing_patch(const DiscPoint& out) const noexcept
{
    return outgoing_.patch_at(turned_round(out, turned_));
}

double MatrixTable::total(int incident) const noexcept
{
    return summed_[at(incident, outgoing_.size() - 1)];
}

double MatrixTable::value_per_sr(const DiscPoint& in, const DiscPoint& out) const noexcept
{
    return values_[at(incident_patch(in), outgoing_patch(out))];
}

double MatrixTable::hemispherical(const DiscPoint& in) const noexcept
{
    return total(incident_patch(in));
}

DiscPoint MatrixTable::sample(const DiscPoint& in, double choice, UnitSquare u) const noexcept
{
    const int i = incident_patch(in);
    const double wanted = choice * total(i);
    const auto row = summed_.begin() + static_cast<std::ptrdiff_t>(at(i, 0));
    const auto found = std::upper_bound(row, row + outgoing_.size() - 1, wanted);
    return turned_round(outgoing_.within(static_cast<int>(found - row), u), turned_);
}

double MatrixTable::density(const DiscPoint& in, const DiscPoint& out) const noexcept
{
    const int i = incident_patch(in);
    const double sum = total(i);
    return sum > 0 ? values_[at(i, outgoing_patch(out))] / sum : 0;
}

std::shared_ptr<const DirectionTable> MatrixTable::reversed() const
{
    // What came in goes out: the sums are made anew for the other direction.
    return std::make_shared<const MatrixTable>(outgoing_, incident_, values_, !turned_);
}

DirectionTable::Peak MatrixTable::peak(const DiscPoint& in) const noexcept
{
    const int patch = outgoing_patch(in);
    const double projected_sr = outgoing_.projected_sr(patch);
    // Beyond the patch, whatever its form: rings are about as wide as their patches are long.
    constexpr double beyond = 2.5;
    const double around_it = around(in, beyond * std::sqrt(projected_sr / pi));
    const double height = values_[at(incident_patch(in), patch)] - around_it;
    return height > (least_peak - 1) * around_it ? Peak{height * projected_sr, around_it} : Peak{};
}

bool MatrixTable::within_peak(const DiscPoint& in, const DiscPoint& out) const noexcept
{
    return outgoing_patch(in) == outgoing_patch(out);
}

} // namespace lightwell
