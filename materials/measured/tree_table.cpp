#include "materials/measured/tree_table.h"

#include "materials/measured/square_disc.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Cells for drawing directions are no finer than this, so that the sums of four coordinates stay within 20 MB.
constexpr int finest_outgoing = 6, finest_isotropic = 7, finest_incident = 5;
/// Of the directions are drawn evenly, whatever the sums say: incident cells are coarser than the tree.
constexpr double even_share = 0.1;
constexpr double even_density = 1 / pi;

std::size_t cell_of(double coordinate, std::size_t side)
{
    return std::min(static_cast<std::size_t>(std::max(0.0, coordinate) * static_cast<double>(side)), side - 1);
}

DiscPoint turned(const DiscPoint& p, double cosine, double sine)
{
    return {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine};
}

/// Cosine and sine of the azimuth.
DiscPoint azimuth_of(const DiscPoint& p)
{
    const double radius = std::hypot(p.x, p.y);
    return radius > 0 ? DiscPoint{p.x / radius, p.y / radius} : DiscPoint{1, 0};
}

} // namespace

double ValueTree::at(const double* position) const noexcept
{
    double p[4];
    std::copy_n(position, coordinates, p);
    std::uint32_t node = 0;
    for (;;) {
        const Node& now = nodes[node];
        std::uint32_t index = 0;
        if (now.grid_bits >= 0) {
            const int side = 1 << now.grid_bits;
            for (int i = 0; i < coordinates; ++i)
                index = (index << now.grid_bits) +
                        static_cast<std::uint32_t>(std::clamp(static_cast<int>(p[i] * side), 0, side - 1));
            return values[now.first + index];
        }
        for (int i = 0; i < coordinates; ++i) {
            p[i] *= 2;
            if (p[i] >= 1) {
                index |= 1u << i;
                p[i] -= 1;
            }
        }
        node = now.first + index;
    }
}

TreeTable::TreeTable(std::shared_ptr<const ValueTree> tree, bool exchanged)
    : tree_(std::move(tree)), exchanged_(exchanged)
{
    incident_side_ = std::size_t{1} << std::min(tree_->depth, isotropic() ? finest_isotropic : finest_incident);
    outgoing_side_ = std::size_t{1} << std::min(tree_->depth, isotropic() ? finest_isotropic : finest_outgoing);
    least_ = *std::min_element(tree_->values.begin(), tree_->values.end());
    const std::size_t incident = isotropic() ? incident_side_ : incident_side_ * incident_side_;
    summed_.resize(incident * outgoing_side_ * outgoing_side_);
    for (std::size_t i = 0; i < incident; ++i)
        sum_cells(i);
}

void TreeTable::sum_cells(std::size_t incident)
{
    const DiscPoint in = incident_centre(incident);
    const std::size_t cells = outgoing_side_ * outgoing_side_;
    // Cells of the tree that are finer than these are averaged.
    const std::size_t finer = std::max<std::size_t>(1, (std::size_t{1} << tree_->depth) / outgoing_side_);
    const double side = static_cast<double>(outgoing_side_ * finer);
    double sum = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        double values = 0;
        for (std::size_t k = 0; k < finer * finer; ++k) {
            const double u = static_cast<double>(cell / outgoing_side_ * finer + k / finer) + 0.5;
            const double v = static_cast<double>(cell % outgoing_side_ * finer + k % finer) + 0.5;
            values += value_per_sr(in, disc_of({u / side, v / side}));
        }
        sum += values / static_cast<double>(finer * finer);
        summed_[incident * cells + cell] = static_cast<float>(sum);
    }
    most_ = std::fmax(most_, sum * pi / static_cast<double>(cells));
}

std::size_t TreeTable::incident_cell(const DiscPoint& in) const noexcept
{
    if (isotropic())
        return cell_of(1 - std::hypot(in.x, in.y), incident_side_);
    const UnitSquare s = square_of(in);
    return cell_of(s.u, incident_side_) * incident_side_ + cell_of(s.v, incident_side_);
}

DiscPoint TreeTable::incident_centre(std::size_t cell) const noexcept
{
    const double side = static_cast<double>(incident_side_);
    if (isotropic())
        return {1 - (static_cast<double>(cell) + 0.5) / side, 0};
    return disc_of({(static_cast<double>(cell / incident_side_) + 0.5) / side,
                    (static_cast<double>(cell % incident_side_) + 0.5) / side});
}

double TreeTable::value_per_sr(const DiscPoint& wanted_in, const DiscPoint& wanted_out) const noexcept
{
    const DiscPoint in = exchanged_ ? DiscPoint{-wanted_out.x, -wanted_out.y} : wanted_in;
    const DiscPoint out = exchanged_ ? DiscPoint{-wanted_in.x, -wanted_in.y} : wanted_out;
    if (!isotropic()) {
        const UnitSquare i = square_of(in), o = square_of(out);
        const double position[] = {i.u, i.v, o.u, o.v};
        return tree_->at(position);
    }
    const DiscPoint azimuth = azimuth_of(in);
    const UnitSquare o = square_of(turned(out, azimuth.x, -azimuth.y));
    // Just below a half along the normal: the upper half stays empty.
    constexpr double below_half = 0.5 - 1e-7;
    const double position[] = {std::clamp(0.5 - 0.5 * std::hypot(in.x, in.y), 0.0, below_half), o.u, o.v};
    return tree_->at(position);
}

double TreeTable::hemispherical(const DiscPoint& in) const noexcept
{
    const std::size_t cells = outgoing_side_ * outgoing_side_;
    return static_cast<double>(summed_[(incident_cell(in) + 1) * cells - 1]) * pi / static_cast<double>(cells);
}

DiscPoint TreeTable::sample(const DiscPoint& in, double choice, UnitSquare u) const noexcept
{
    const std::size_t cells = outgoing_side_ * outgoing_side_;
    const auto row = summed_.begin() + static_cast<std::ptrdiff_t>(incident_cell(in) * cells);
    const float total = *(row + static_cast<std::ptrdiff_t>(cells) - 1);
    if (choice < even_share || !(total > 0))
        return disc_of(u);
    const auto wanted = static_cast<float>((choice - even_share) / (1 - even_share)) * total;
    const auto found = std::upper_bound(row, row + static_cast<std::ptrdiff_t>(cells) - 1, wanted);
    const auto cell = static_cast<std::size_t>(found - row);
    const double side = static_cast<double>(outgoing_side_);
    const DiscPoint out = disc_of({(static_cast<double>(cell / outgoing_side_) + u.u) / side,
                                   (static_cast<double>(cell % outgoing_side_) + u.v) / side});
    if (!isotropic())
        return out;
    const DiscPoint azimuth = azimuth_of(in);
    return turned(out, azimuth.x, azimuth.y);
}

double TreeTable::density(const DiscPoint& in, const DiscPoint& out) const noexcept
{
    const std::size_t cells = outgoing_side_ * outgoing_side_;
    const float* const row = summed_.data() + incident_cell(in) * cells;
    const double total = static_cast<double>(row[cells - 1]);
    if (!(total > 0))
        return even_density;
    DiscPoint relative = out;
    if (isotropic()) {
        const DiscPoint azimuth = azimuth_of(in);
        relative = turned(out, azimuth.x, -azimuth.y);
    }
    const UnitSquare s = square_of(relative);
    const std::size_t cell = cell_of(s.u, outgoing_side_) * outgoing_side_ + cell_of(s.v, outgoing_side_);
    const double value = static_cast<double>(row[cell]) - (cell > 0 ? static_cast<double>(row[cell - 1]) : 0);
    return even_share * even_density + (1 - even_share) * value / total * static_cast<double>(cells) * even_density;
}

std::shared_ptr<const DirectionTable> TreeTable::reversed() const
{
    return std::make_shared<const TreeTable>(tree_, !exchanged_);
}

/// Of the disc that holds a peak, which covers some cells: the straight passage falls on their borders.
double TreeTable::peak_radius() const noexcept
{
    constexpr double cells = 2;
    return cells / static_cast<double>(std::size_t{1} << tree_->depth);
}

DirectionTable::Peak TreeTable::peak(const DiscPoint& in) const noexcept
{
    const double radius = peak_radius(), around_it = around(in, 2 * radius);
    constexpr int side = 6;
    double sum = 0;
    int found = 0;
    for (int i = 0; i < side * side; ++i) {
        const DiscPoint p = disc_of({(i / side + 0.5) / side, (i % side + 0.5) / side});
        const DiscPoint out{in.x + radius * p.x, in.y + radius * p.y};
        if (out.x * out.x + out.y * out.y < 1) {
            sum += value_per_sr(in, out);
            ++found;
        }
    }
    const double height = (found > 0 ? sum / found : 0) - around_it;
    return height > (least_peak - 1) * around_it
               ? Peak{height * pi * radius * radius * found / (side * side), around_it}
               : Peak{};
}

bool TreeTable::within_peak(const DiscPoint& in, const DiscPoint& out) const noexcept
{
    return std::hypot(in.x - out.x, in.y - out.y) < peak_radius();
}

} // namespace lightwell
