#include "engine/sources/guide.h"

#include "engine/base/random.h"
#include "engine/sources/source_list.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

namespace lightwell {
namespace {

/// Cells along the longest side of the scene.
constexpr double cells_a_side = 48;
/// Points in a cell from which it is learned, and rays to the open sky from each.
constexpr int points_a_cell = 8, sky_rays_a_point = 16;
/// Rays of the sun sent through the panes, and how finely their hits are gathered: parts of the scene's diagonal.
constexpr int sun_rays = 8192;
constexpr double patch_size = 1.0 / 40;
constexpr std::size_t most_patches = 256;
/// Neither the panes nor the open sky are ever left without rays where both can be seen.
constexpr double least_share = 0.1;
/// Receivers turned away still get some rays: their cosine is that of the opening's middle only.
constexpr double least_cosine = 0.05;
/// A ray to a pane is followed this much farther, to be through it.
constexpr double beyond_pane = 1.001;

Point point_in(const Point& low, const Vec3& size, RandomStream& random)
{
    const double x = random.next(), y = random.next(), z = random.next();
    return {low.x + x * size.x, low.y + y * size.y, low.z + z * size.z};
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

std::size_t pick(const Guide::Shares& shares, double u, double& left)
{
    const double wanted = u * shares.total();
    const auto at = static_cast<std::size_t>(std::upper_bound(shares.summed, shares.summed + shares.count - 1, wanted) -
                                             shares.summed);
    const double part = shares.share(at);
    left = part > 0 ? std::clamp((wanted - (shares.summed[at] - part)) / part, 0.0, 0x1.fffffffffffffp-1) : 0;
    return at;
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

Guide::Guide(const Scene& scene, const RayQueries& rays, const SkySource& sky, const std::vector<SunSource>& suns)
    : rays_(rays), sky_(sky), suns_(suns), portals_(find_portals(scene))
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i)
        materials_.push_back(resolve(scene, static_cast<ModifierId>(i)).material);
    const Box box = bounds(scene);
    if (portals_.empty() || !(box.diagonal() > 0))
        return;
    find_patches(suns);
    lattice_ = std::make_unique<Lattice>(box);
}

Guide::~Guide() = default;

void Guide::find_patches(const std::vector<SunSource>& suns)
{
    struct Pile {
        Vec3 sum;
        double flux = 0;
        std::vector<Point> points;
    };
    std::map<std::tuple<long, long, long>, Pile> piles;
    double diagonal = 0;
    for (const Portal& p : portals_)
        diagonal = std::max(diagonal, length(p.centre - portals_[0].centre) + 2 * p.radius_m);
    const double size = diagonal * patch_size;
    RandomStream random(0x5eed);
    for (const SunSource& sun : suns)
        for (int i = 0; i < sun_rays; ++i) {
            const Portal& p = portals_[static_cast<std::size_t>(random.next() * static_cast<double>(portals_.size()))];
            const Point through = p.corner + p.edge_x * random.next() + p.edge_y * random.next();
            const double flux = p.area_m2 * std::fabs(dot(p.normal, sun.disc.to_source)) * photopic(sun.radiance);
            const Point outside = through + sun.disc.to_source * (1e-6 * size);
            const Point inside = through - sun.disc.to_source * (1e-6 * size);
            Hit hit;
            if (rays_.transmittance({outside, sun.disc.to_source, infinity}).is_black() ||
                !rays_.closest({inside, -sun.disc.to_source, infinity}, hit))
                continue;
            const Vec3 at = hit.position / size;
            Pile& pile = piles[{std::lround(at.x), std::lround(at.y), std::lround(at.z)}];
            pile.sum += hit.position;
            pile.flux += flux;
            pile.points.push_back(hit.position);
        }
    for (const auto& [key, pile] : piles) {
        Patch patch{pile.sum / static_cast<double>(pile.points.size()), 0.1 * size, pile.flux};
        for (const Point& p : pile.points)
            patch.radius_m = std::max(patch.radius_m, length(p - patch.centre));
        patches_.push_back(patch);
    }
    std::stable_sort(patches_.begin(), patches_.end(), [](const Patch& a, const Patch& b) { return a.flux > b.flux; });
    patches_.resize(std::min(patches_.size(), most_patches));
}

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
        const Vec3 low{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        learn(l.box.low + low * l.cell_m, {l.cell_m, l.cell_m, l.cell_m}, index, l.cells[index]);
    });
    return l.cells[index];
}

void Guide::learn(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const
{
    if (!sky_.empty())
        learn_portals(low, size, key, cell);
    learn_patches(low, size, key, cell);
}

/// Roughly how bright a direction is outside: the sky, or a surface in the sun and under half of the sky.
Spectrum Guide::seen_outside(const Point& beyond, const Direction& direction) const
{
    Hit hit;
    if (!rays_.closest({beyond, direction, infinity}, hit))
        return sky_.radiance(direction);
    Spectrum falling = sky_.empty() ? Spectrum{} : Spectrum::grey(0.5 * pi * sky_.mean_radiance());
    const double side = dot(hit.normal, direction) <= 0 ? 1 : -1;
    for (const SunSource& sun : suns_) {
        const Direction& to_sun = sun.disc.to_source;
        const double cosine = side * dot(hit.normal, to_sun);
        if (cosine > 0)
            falling += sun.radiance * rays_.transmittance({hit.leave(to_sun), to_sun, infinity}) *
                       (cosine * cone_solid_angle_sr(0.5 * sun.disc.full_angle_deg * radians_per_degree));
    }
    return falling * typical_reflectance(*materials_[static_cast<std::size_t>(hit.modifier)]) / pi;
}

void Guide::learn_portals(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const
{
    RandomStream random(1, key, 0);
    std::vector<double> weights(portals_.size()), outlooks(portals_.size());
    double through_panes = 0, open = 0;
    for (int i = 0; i < points_a_cell; ++i) {
        const Point at = point_in(low, size, random);
        for (std::size_t k = 0; k < portals_.size(); ++k) {
            const SampledDirection d = portals_[k].sample(at, random.square());
            if (!(d.density_per_sr > 0))
                continue;
            // Nearer than the pane is wide, a sample by area says little: no single one may count for all.
            const double solid_angle = std::min(1 / d.density_per_sr, 2 * pi);
            const double to_pane =
                dot(portals_[k].normal, portals_[k].corner - at) / dot(portals_[k].normal, d.direction);
            const Ray way{at, d.direction, to_pane * beyond_pane};
            const Spectrum passing = rays_.transmittance(way);
            if (passing.is_black())
                continue;
            const Point outside = at + d.direction * way.t_max;
            outlooks[k] += photopic(passing * seen_outside(outside, d.direction)) * solid_angle;
            const Spectrum sky = sky_.radiance(d.direction) * rays_.transmittance({outside, d.direction, infinity});
            weights[k] += photopic(passing * sky) * solid_angle;
            through_panes += photopic(passing * sky) * solid_angle;
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
    cell.outlook_count = keep_largest(outlooks, cell.outlooks);
    if (cell.portal_count > 0)
        cell.portal_share = std::clamp(through_panes / (through_panes + open), least_share, 1 - least_share);
}

void Guide::learn_patches(const Point& low, const Vec3& size, std::uint64_t key, Cell& cell) const
{
    RandomStream random(2, key, 0);
    std::vector<double> weights(patches_.size());
    for (std::size_t k = 0; k < patches_.size(); ++k) {
        const Patch& patch = patches_[k];
        for (int i = 0; i < points_a_cell / 2; ++i) {
            const Vec3 way = patch.centre - point_in(low, size, random);
            const double squared = std::max(dot(way, way), 4 * patch.radius_m * patch.radius_m);
            const Ray ray{patch.centre - way, way, 1 - 2 * patch.radius_m / std::sqrt(squared)};
            if (ray.t_max <= 0 || !rays_.transmittance(ray).is_black())
                weights[k] += patch.flux / squared;
        }
    }
    cell.patch_count = keep_largest(weights, cell.patches);
}

Guide::Shares Guide::portal_shares(const Point& at, const Direction& normal, bool transmits) const
{
    const Cell& here = cell(at);
    Shares shares = shares_of(here.portals, here.portal_count, at, normal, transmits);
    shares.portal_share = shares.total() > 0 ? here.portal_share : 0;
    return shares;
}

Guide::Shares Guide::outlook_shares(const Point& at, const Direction& normal) const
{
    const Cell& here = cell(at);
    return shares_of(here.outlooks, here.outlook_count, at, normal, false);
}

Guide::Shares Guide::shares_of(const Entry* entries, std::size_t count, const Point& at, const Direction& normal,
                               bool transmits) const
{
    Shares shares;
    shares.entries = entries;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Entry& entry = entries[i];
        const Portal& p = portals_[entry.index];
        sum += entry.share * (transmits ? 1 : receiver_cosine(p.centre - at, p.radius_m, normal));
        shares.summed[shares.count++] = sum;
    }
    return shares;
}

SampledDirection Guide::sample_portal(const Shares& shares, const Point& from, UnitSquare u) const noexcept
{
    if (!(shares.total() > 0))
        return {};
    double left = 0;
    const std::size_t at = pick(shares, u.u, left);
    const SampledDirection d = portals_[shares.entries[at].index].sample(from, {left, u.v});
    return {d.direction, d.density_per_sr > 0 ? portal_density_per_sr(shares, from, d.direction) : 0};
}

double Guide::portal_density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept
{
    double density = 0;
    for (std::size_t i = 0; i < shares.count; ++i)
        density += shares.share(i) * portals_[shares.entries[i].index].density_per_sr(from, direction);
    return shares.count == 0 ? 0 : density / shares.total();
}

Guide::Shares Guide::patch_shares(const Point& at, const Direction& normal) const
{
    Shares shares;
    const Cell& here = cell(at);
    shares.entries = here.patches;
    double sum = 0;
    for (std::size_t i = 0; i < here.patch_count; ++i) {
        const Entry& entry = here.patches[i];
        const Patch& patch = patches_[entry.index];
        const Vec3 way = patch.centre - at;
        // Within or beside the patch there is no cone to aim at.
        const bool apart = dot(way, way) > 2 * patch.radius_m * patch.radius_m && dot(way, normal) > -patch.radius_m;
        sum += apart ? entry.share * receiver_cosine(way, patch.radius_m, normal) : 0;
        shares.summed[shares.count++] = sum;
    }
    return shares;
}

SampledDirection Guide::sample_patch(const Shares& shares, const Point& from, UnitSquare u) const noexcept
{
    if (!(shares.total() > 0))
        return {};
    double left = 0;
    const Patch& patch = patches_[shares.entries[pick(shares, u.u, left)].index];
    const SampledDirection d = sphere_seen_from(from, patch.centre, patch.radius_m, {left, u.v});
    return {d.direction, patch_density_per_sr(shares, from, d.direction)};
}

double Guide::patch_density_per_sr(const Shares& shares, const Point& from, const Direction& direction) const noexcept
{
    double density = 0;
    for (std::size_t i = 0; i < shares.count; ++i) {
        const double share = shares.share(i);
        if (!(share > 0))
            continue;
        const Patch& patch = patches_[shares.entries[i].index];
        const Vec3 way = patch.centre - from;
        const double squared = dot(way, way), along = dot(way, direction), r2 = patch.radius_m * patch.radius_m;
        // Within the cone that touches the ball: along / |way| >= sqrt(1 - r^2 / |way|^2).
        if (along > 0 && along * along >= squared - r2) {
            const double cosine = std::sqrt(1 - r2 / squared);
            density += share * (1 + cosine) * squared / (2 * pi * r2); // 1 / (2 pi (1 - cosine)), without cancellation
        }
    }
    return shares.total() > 0 ? density / shares.total() : 0;
}

} // namespace lightwell
