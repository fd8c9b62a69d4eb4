#pragma once

#include "engine/base/frame.h"
#include "engine/sampling/warps.h"
#include "engine/scene/scene.h"
#include "engine/transport/radiance_query.h"

#include <array>
#include <string>
#include <vector>

namespace lightwell {

/// Which openings rays are aimed at.
struct SecondarySettings {
    bool on = true;                          ///< false: none, though named sheets stay open
    bool all_panes = false;                  ///< large flat panes of glass that much more light comes through from one
                                             ///< side than from the other
    std::vector<std::string> modifiers = {}; ///< of panes (glass) and of sheets (illum)

    bool none() const noexcept { return !on || (!all_panes && modifiers.empty()); }
};

/// "auto", "none" or the names with commas.
std::string to_text(const SecondarySettings& settings);

/// Openings as secondary sources: how much light that was scattered behind them leaves them, by place and direction,
/// is collected by tracing, and says where rays are worth aiming. What such a ray brings is found by following it, so
/// that nothing is doubled, lost or blurred, however wrong the collected distribution.
/// Error: none; it only says where rays go
/// Source  Ward 1994, Section 3.5; the distribution there is the light itself, here it is its density
class SecondarySources {
public:
    SecondarySources() = default;
    /// Finds the openings and cuts them in pieces. Nothing is known of their light yet: none is aimed at.
    /// @throws InputError for a modifier that does not exist or is no opening
    SecondarySources(const Scene& scene, const SecondarySettings& settings);

    /// Light of both sides of all openings; the brighter side of each sends to the other.
    void collect(const RadianceQuery& query, std::uint64_t seed, int threads);

    static constexpr std::size_t most_pieces = 64;
    /// Whether there is no light to aim at.
    bool empty() const noexcept { return sending_.empty(); }
    /// Openings that send light.
    std::size_t size() const noexcept { return sending_openings_; }

    /// A choice among the pieces for one receiver; weights are photopic irradiance, roughly.
    struct Shares {
        Point from;
        std::array<double, most_pieces> summed; ///< up to and including each piece that sends light
        double total = 0;
    };
    Shares shares(const Point& from, const Direction& normal) const noexcept;
    SampledDirection sample(const Shares& shares, UnitSquare u) const noexcept;
    double density_per_sr(const Shares& shares, const Direction& direction) const noexcept;

private:
    static constexpr int strata = 8; ///< of directions, along each axis of the unit square of the hemisphere
    /// A parallelogram that light leaves on the side of its normal.
    struct Piece {
        Point corner;
        Vec3 edge_x, edge_y;
        Frame frame; ///< z = normal
        double area_m2 = 0;
        double radius_m = 0;
        std::array<float, strata * strata> radiance{}; ///< photopic, by direction of travel

        Point centre() const noexcept { return corner + (edge_x + edge_y) * 0.5; }
        double radiance_towards(const Direction& travel) const noexcept;
        void turn() noexcept;
    };
    struct Collected;
    static Collected collect_side(const Piece& side, std::uint64_t key, const RadianceQuery& query, std::uint64_t seed);
    void keep_brighter(std::vector<Piece>& sides, const std::vector<double>& means);
    double potential(const Piece& piece, const Point& from, const Direction& normal) const noexcept;

    std::vector<Piece> pieces_, sending_;
    std::vector<std::size_t> opening_of_; ///< by piece
    std::size_t openings_ = 0, sending_openings_ = 0;
    bool only_unequal_ = false; ///< openings that nobody named
};

/// The scene with sheets (illum) of these modifiers made into what they stand for: their alternate, or nothing at all.
Scene with_open_sheets(Scene scene, const SecondarySettings& settings);

} // namespace lightwell
