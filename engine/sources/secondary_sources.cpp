#include "engine/sources/secondary_sources.h"

#include "engine/base/errors.h"
#include "engine/base/threads.h"
#include "engine/sampling/path_random.h"
#include "engine/sources/portals.h"
#include "engine/sources/weighted_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lightwell {
namespace {

constexpr std::uint64_t collect_salt = 0x6f70656e;
/// Rays that collect the light of one side of a piece.
constexpr int rays_a_side = 128;
/// A stratum counts as at least this share of its opening's mean: a few rays may have missed what it sends.
constexpr double least_share = 0.1;
/// A piece that a receiver sees edge-on or from the side by its middle may still show a part.
constexpr double least_cosine = 0.05;
/// Where one side of an opening is this many times as bright as the other, what comes through matters more than the
/// surfaces around; else rays that follow the cosine find as much light anywhere.
constexpr double worth_aiming = 8;

int stratum(double x, int count)
{
    return std::clamp(static_cast<int>((x + 1) * 0.5 * count), 0, count - 1);
}

ModifierId named(const Scene& scene, const std::string& name)
{
    const ModifierId modifier = scene.find_modifier(name);
    if (modifier == void_modifier)
        throw InputError{"secondary source \"" + name + "\"", "no modifier of the scene has this name",
                         "name the modifier of a window pane or of an illum"};
    return modifier;
}

void check_names(const Scene& scene, const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        const Material* material = resolve(scene, named(scene, name)).material;
        if (material == nullptr || !std::holds_alternative<Glass>(*material))
            throw InputError{"secondary source \"" + name + "\"",
                             "its material is " + (material == nullptr ? "void" : type_name(*material)) +
                                 ", expected glass or illum",
                             "name the modifier of a window pane, or put an illum before the opening"};
        if (find_portals(scene, {name}).empty())
            throw InputError{"secondary source \"" + name + "\"", "no flat surface has this modifier",
                             "give it to a polygon across the opening"};
    }
}

/// How many pieces along an edge when no piece is to be longer than this.
std::size_t cuts(const Vec3& edge, double longest_m)
{
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length(edge) / longest_m)));
}

/// The shortest edge for which the pieces are no more than allowed: found by halving, from the largest opening down.
double piece_edge_m(const std::vector<Portal>& openings, std::size_t most)
{
    const auto count = [&](double edge_m) {
        return std::accumulate(openings.begin(), openings.end(), std::size_t{0}, [&](std::size_t n, const Portal& p) {
            return n + cuts(p.edge_x, edge_m) * cuts(p.edge_y, edge_m);
        });
    };
    double longest = 0;
    for (const Portal& p : openings)
        longest = std::max({longest, length(p.edge_x), length(p.edge_y)});
    double good = longest, bad = 0;
    for (int step = 0; step < 20; ++step) {
        const double middle = 0.5 * (good + bad);
        (count(middle) <= most ? good : bad) = middle;
    }
    return good;
}

} // namespace

std::string to_text(const SecondarySettings& settings)
{
    if (settings.none())
        return "none";
    std::string text = settings.modifiers.empty() ? "auto" : "";
    for (const std::string& name : settings.modifiers)
        text.append(text.empty() ? "" : ",").append(name);
    return text;
}

double SecondarySources::Piece::radiance_towards(const Direction& travel) const noexcept
{
    const int x = stratum(dot(travel, frame.x), strata), y = stratum(dot(travel, frame.y), strata);
    return radiance[static_cast<std::size_t>(y * strata + x)];
}

void SecondarySources::Piece::turn() noexcept
{
    frame = {frame.y, frame.x, -frame.z};
}

SecondarySources::SecondarySources(const Scene& scene, const SecondarySettings& settings)
{
    check_names(scene, settings.modifiers);
    if (settings.none())
        return;
    only_unequal_ = settings.modifiers.empty();
    std::vector<Portal> openings = find_portals(scene, settings.modifiers);
    if (openings.size() > most_pieces)
        openings.resize(most_pieces);
    openings_ = openings.size();
    if (openings.empty())
        return;
    const double edge_m = piece_edge_m(openings, most_pieces);
    for (std::size_t at = 0; at < openings.size(); ++at) {
        const Portal& p = openings[at];
        const std::size_t nx = cuts(p.edge_x, edge_m), ny = cuts(p.edge_y, edge_m);
        const Vec3 x = p.edge_x / static_cast<double>(nx), y = p.edge_y / static_cast<double>(ny);
        const Direction along = normalized(x);
        for (std::size_t i = 0; i < nx * ny; ++i) {
            const Point corner = p.corner + x * static_cast<double>(i % nx) + y * static_cast<double>(i / nx);
            const Vec3 area = cross(x, y);
            const Direction normal = normalized(area);
            pieces_.push_back(
                {corner, x, y, {along, cross(normal, along), normal}, length(area), 0.5 * length(x + y), {}});
            opening_of_.push_back(at);
        }
    }
}

/// Sums over the rays of one side.
struct SecondarySources::Collected {
    std::array<double, strata * strata> sums{}, counts{};
    double mean = 0;

    /// Few rays a stratum: each also counts, less, in the eight around.
    float around(int x, int y) const noexcept
    {
        constexpr double neighbour = 0.25;
        double sum = 0, count = 0;
        for (int v = std::max(0, y - 1); v <= std::min(strata - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(strata - 1, x + 1); ++u) {
                const double share = u == x && v == y ? 1 : neighbour;
                sum += share * sums[static_cast<std::size_t>(v * strata + u)];
                count += share * counts[static_cast<std::size_t>(v * strata + u)];
            }
        return static_cast<float>(std::max(count > 0 ? sum / count : 0, least_share * mean));
    }
};

SecondarySources::Collected SecondarySources::collect_side(const Piece& side, std::uint64_t key,
                                                           const RadianceQuery& query, std::uint64_t seed)
{
    Collected light;
    for (std::uint32_t n = 0; n < rays_a_side; ++n) {
        PathRandom random(mix_bits(seed, collect_salt), key, n);
        const UnitSquare place = random.pair();
        const Direction local = cosine_hemisphere(random.pair());
        const Point from = side.corner + side.edge_x * place.u + side.edge_y * place.v;
        const double found = photopic(query.scattered_radiance(from, -side.frame.to_world(local), random));
        const auto cell = static_cast<std::size_t>(stratum(local.y, strata) * strata + stratum(local.x, strata));
        light.sums[cell] += found;
        light.counts[cell] += 1;
        light.mean += found / rays_a_side;
    }
    return light;
}

void SecondarySources::collect(const RadianceQuery& query, std::uint64_t seed, int threads)
{
    std::vector<Piece> sides = pieces_;
    for (const Piece& piece : pieces_) {
        sides.push_back(piece);
        sides.back().turn();
    }
    std::vector<double> means(sides.size());
    parallel_for(sides.size(), threads, [&](std::size_t i) {
        const Collected light = collect_side(sides[i], i, query, seed);
        means[i] = light.mean;
        for (int y = 0; y < strata; ++y)
            for (int x = 0; x < strata; ++x)
                sides[i].radiance[static_cast<std::size_t>(y * strata + x)] = light.around(x, y);
    });
    keep_brighter(sides, means);
}

/// @param sides  of the pieces along their normals, then against them
void SecondarySources::keep_brighter(std::vector<Piece>& sides, const std::vector<double>& means)
{
    const std::size_t count = pieces_.size();
    std::vector<double> along(openings_), against(openings_);
    for (std::size_t i = 0; i < count; ++i) {
        along[opening_of_[i]] += means[i];
        against[opening_of_[i]] += means[count + i];
    }
    sending_.clear();
    sending_openings_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double bright = std::max(along[opening_of_[i]], against[opening_of_[i]]),
                     dark = std::min(along[opening_of_[i]], against[opening_of_[i]]);
        if (!(bright > 0) || (only_unequal_ && bright < worth_aiming * dark))
            continue;
        sending_openings_ += i == 0 || opening_of_[i] != opening_of_[i - 1] ? 1 : 0;
        sending_.push_back(sides[along[opening_of_[i]] == bright ? i : count + i]);
    }
}

double SecondarySources::potential(const Piece& piece, const Point& from, const Direction& normal) const noexcept
{
    const Vec3 way = piece.centre() - from;
    const double before = -dot(piece.frame.z, way), above = dot(normal, way);
    if (!(before > 0) || !(above + piece.radius_m > 0))
        return 0;
    const double squared = dot(way, way), distance = std::sqrt(squared);
    const double reached = std::max(distance, piece.radius_m);
    const double arriving = std::max(least_cosine, std::min(1.0, (above + 0.5 * piece.radius_m) / reached));
    const double solid_angle = std::min(2 * pi, piece.area_m2 * std::max(least_cosine, before / reached) / squared);
    return piece.radiance_towards(way / -distance) * solid_angle * arriving;
}

SecondarySources::Shares SecondarySources::shares(const Point& from, const Direction& normal) const noexcept
{
    Shares shares;
    shares.from = from;
    for (std::size_t i = 0; i < sending_.size(); ++i)
        shares.summed[i] = shares.total += potential(sending_[i], from, normal);
    return shares;
}

SampledDirection SecondarySources::sample(const Shares& shares, UnitSquare u) const noexcept
{
    if (!(shares.total > 0))
        return {};
    const WeightedChoice chosen = choose(shares.summed.data(), sending_.size(), u.u);
    if (!(chosen.share > 0))
        return {};
    const Piece& piece = sending_[chosen.index];
    const Direction direction =
        normalized(piece.corner + piece.edge_x * chosen.left + piece.edge_y * u.v - shares.from);
    return {direction, density_per_sr(shares, direction)};
}

double SecondarySources::density_per_sr(const Shares& shares, const Direction& direction) const noexcept
{
    double density = 0;
    for (std::size_t i = 0; i < sending_.size(); ++i) {
        const Piece& piece = sending_[i];
        const double share = shares.summed[i] - (i == 0 ? 0 : shares.summed[i - 1]);
        const double cosine = -dot(piece.frame.z, direction);
        if (!(share > 0 && cosine > 0))
            continue;
        const double t = dot(piece.frame.z, shares.from - piece.corner) / cosine;
        const Vec3 off = shares.from + direction * t - piece.corner;
        const double x = dot(off, piece.edge_x), y = dot(off, piece.edge_y);
        if (t > 0 && x >= 0 && x < dot(piece.edge_x, piece.edge_x) && y >= 0 && y < dot(piece.edge_y, piece.edge_y))
            density += share * t * t / (piece.area_m2 * cosine);
    }
    return shares.total > 0 ? density / shares.total : 0;
}

Scene with_open_sheets(Scene scene, const SecondarySettings& settings)
{
    for (const std::string& name : settings.modifiers) {
        Modifier& modifier = scene.modifiers[static_cast<std::size_t>(named(scene, name))];
        const Material* material = resolve(scene, named(scene, name)).material;
        const Illum* illum = material != nullptr ? std::get_if<Illum>(material) : nullptr;
        if (illum == nullptr)
            continue;
        const ModifierId alternate = illum->alternate.empty() || illum->alternate == "void"
                                         ? void_modifier
                                         : scene.find_modifier(illum->alternate);
        if (alternate != void_modifier && resolve(scene, alternate).material != nullptr)
            modifier.what = *resolve(scene, alternate).material;
        else
            modifier.what = Material{Glass{Spectrum::grey(1), 1}}; // neither reflects nor absorbs
    }
    return scene;
}

} // namespace lightwell
