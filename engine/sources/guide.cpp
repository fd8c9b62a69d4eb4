#include "engine/sources/guide.h"

#include "engine/base/random.h"
#include "engine/base/tally.h"
#include "engine/sources/weighted_choice.h"

#include <algorithm>
#include <mutex>

namespace lightwell {
namespace {

/// Cells along the longest side of the scene.
constexpr double cells_a_side = 48;
/// Points in a cell from which it is learned, and rays to the open sky from each.
constexpr int points_a_cell = 4, sky_rays_a_point = 16;
/// Neither the panes nor the open sky are ever left without rays where both can be seen.
constexpr double least_share = 0.1;
/// Receivers turned away still get some rays: their cosine is that of the opening's middle only.
constexpr double least_cosine = 0.05;

Point point_in(const Point& low, double size_m, RandomStream& random)
{
    const double x = random.next(), y = random.next(), z = random.next();
    return low + Vec3{x, y, z} * size_m;
}

/// The entries of largest weight, as shares.
std::size_t keep_largest(const std::vector<double>& weights, Guide::Entry* entries)
{
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < weights.size(); ++i)
        if (weights[i] > 0)
            order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
    order.resize(std::min(order.size(), Guide::most_entries));
    double total = 0;
    for (const std::uint32_t i : order)
        total += weights[i];
    for (std::size_t k = 0; k < order.size(); ++k)
        entries[k] = {order[k], static_cast<float>(weights[order[k]] / total)};
    return order.size();
}

double receiver_cosine(const Vec3& to_centre, double radius, const Direction& normal)
{
    const double distance = length(to_centre);
    return std::max(least_cosine, (dot(normal, to_centre) + 0.5 * radius) / std::max(distance, radius));
}

} // namespace

struct Guide::Lattice {
    Box box;
    double cell_m = 1;
    std::size_t n[3] = {1, 1, 1};
    std::vector<Cell> cells;
    std::unique_ptr<std::once_flag[]> learned;

    explicit Lattice(const Box& around) : box(around)
    {
        const Vec3 extent = box.high - box.low;
        cell_m = std::max({extent.x, extent.y, extent.z}) / cells_a_side;
        for (int axis = 0; axis < 3; ++axis)
            n[axis] = static_cast<std::size_t>(std::clamp(std::ceil(extent[axis] / cell_m), 1.0, cells_a_side));
        cells.resize(n[0] * n[1] * n[2]);
        learned = std::make_unique<std::once_flag[]>(cells.size());
    }
    std::size_t step(double offset, std::size_t count) const
    {
        return static_cast<std::size_t>(std::clamp(std::floor(offset / cell_m), 0.0, static_cast<double>(count - 1)));
    }
};

Guide::Guide(const Scene& scene, const RayQueries& rays, const SkySource& sky) : rays_(rays), sky_(sky)
{
    if (sky.empty())
        return;
    portals_ = find_portals(scene);
    const Box box = bounds(scene);
    if (!portals_.empty() && box.diagonal() > 0)
        lattice_ = std::make_unique<Lattice>(box);
}

Guide::~Guide() = default;

const Guide::Cell& Guide::cell(const Point& at) const
{
    static const Cell nothing{};
    if (!lattice_)
        return nothing;
    Lattice& l = *lattice_;
    const Vec3 offset = at - l.box.low;
    const std::size_t x = l.step(offset.x, l.n[0]), y = l.step(offset.y, l.n[1]), z = l.step(offset.z, l.n[2]);
    const std::size_t index = (z * l.n[1] + y) * l.n[0] + x;
    std::call_once(l.learned[index], [&] {
        const Vec3 corner{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        const RayCounts before = rays_of_thread; // whoever asks first: this belongs to the scene, not to his run
        learn(l.box.low + corner * l.cell_m, l.cell_m, index, l.cells[index]);
        rays_of_thread = before;
    });
    return l.cells[index];
}

void Guide::learn(const Point& low, double size_m, std::uint64_t key, Cell& cell) const
{
    RandomStream random(1, key, 0);
    std::vector<double> weights(portals_.size());
    double through_panes = 0, open = 0;
    for (int i = 0; i < points_a_cell; ++i) {
        const Point at = point_in(low, size_m, random);
        for (std::size_t k = 0; k < portals_.size(); ++k) {
            const SampledDirection d = portals_[k].sample(at, random.square());
            if (!(d.density_per_sr > 0))
                continue;
            // Nearer than the pane is wide, a sample by area says little: no single one may count for all.
            const double solid_angle = std::min(1 / d.density_per_sr, 2 * pi);
            const Spectrum light = sky_.radiance(d.direction) * rays_.transmittance({at, d.direction, infinity});
            weights[k] += photopic(light) * solid_angle;
            through_panes += photopic(light) * solid_angle;
        }
        for (int k = 0; k < sky_rays_a_point; ++k) {
            const SourceSample s = sky_.sample(random.square());
            const bool passes_pane = std::any_of(portals_.begin(), portals_.end(),
                                                 [&](const Portal& p) { return p.density_per_sr(at, s.to_light) > 0; });
            if (s.density_per_sr > 0 && !passes_pane)
                open += photopic(s.radiance * rays_.transmittance({at, s.to_light, infinity})) /
                        (s.density_per_sr * sky_rays_a_point);
        }
    }
    cell.portal_count = keep_largest(weights, cell.portals);
    if (cell.portal_count > 0)
        cell.portal_share = std::clamp(through_panes / (through_panes + open), least_share, 1 - least_share);
}

Guide::Shares Guide::shares(const Point& at, const Direction& normal, bool transmits) const
{
    const Cell& here = cell(at);
    Shares shares;
    shares.entries = here.portals;
    double sum = 0;
    for (std::size_t i = 0; i < here.portal_count; ++i) {
        const Entry& entry = here.portals[i];
        const Portal& p = portals_[entry.index];
        sum += entry.share * (transmits ? 1 : receiver_cosine(p.centre - at, p.radius_m, normal));
        shares.summed[shares.count++] = sum;
    }
    shares.portal_share = sum > 0 ? here.portal_share : 0;
    return shares;
}

SampledDirection Guide::sample(const Shares& shares, const Point& from, UnitSquare u) const noexcept
{
    if (!(shares.total() > 0))
        return {};
    const auto [at, share, left] = choose(shares.summed, shares.count, u.u);
    const SampledDirection d = portals_[shares.entries[at].index].sample(from, {left, u.v});
    return {d.direction, d.density_per_sr > 0 ? density_per_sr(shares, from, d.direction) : 0};
}

double Guide::density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept
{
    double density = 0;
    for (std::size_t i = 0; i < shares.count; ++i)
        density += shares.share(i) * portals_[shares.entries[i].index].density_per_sr(from, direction);
    return shares.count == 0 ? 0 : density / shares.total();
}

} // namespace lightwell
