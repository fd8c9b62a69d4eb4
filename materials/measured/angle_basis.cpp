#include "materials/measured/angle_basis.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lightwell {
namespace {

/// More patches than any instrument tells apart.
constexpr int most_patches = 5000;

double squared_sine(double degrees)
{
    const double s = degrees >= 90 ? 1 : std::sin(degrees * radians_per_degree);
    return s * s;
}

} // namespace

AngleBasis::AngleBasis(std::string name, std::vector<Ring> rings, const std::string& place) : name_(std::move(name))
{
    double end_deg = 0;
    for (const Ring& ring : rings) {
        constexpr double rounding_deg = 0.01;
        const bool good = std::fabs(ring.lower_deg - end_deg) < rounding_deg && ring.upper_deg > ring.lower_deg &&
                          ring.patches > 0 && ring.patches <= most_patches - size_;
        if (!good)
            throw InputError{place,
                             "ring " + std::to_string(bands_.size() + 1) + " of the angle basis \"" + name_ +
                                 "\" does not follow the one before it, or has no patches",
                             "rings go from 0 to 90 degrees without gaps"};
        bands_.push_back({squared_sine(end_deg), squared_sine(ring.upper_deg), ring.patches, size_});
        size_ += ring.patches;
        end_deg = ring.upper_deg;
    }
    constexpr double nearly_90 = 89.9;
    if (!(end_deg > nearly_90 && end_deg < 90.1))
        throw InputError{place, "the angle basis \"" + name_ + "\" ends at " + std::to_string(end_deg) + " degrees",
                         "it has to reach 90"};
    bands_.back().upper = 1;
}

const AngleBasis* AngleBasis::known(const std::string& name)
{
    static const std::map<std::string, AngleBasis> bases = [] {
        const auto rings = [](std::initializer_list<std::pair<double, int>> upper_and_patches) {
            std::vector<Ring> list;
            double lower = 0;
            for (const auto& [upper, patches] : upper_and_patches) {
                list.push_back({lower, upper, patches});
                lower = upper;
            }
            return list;
        };
        std::map<std::string, AngleBasis> made;
        // Source  Klems 1994, as distributed with WINDOW
        const std::pair<const char*, std::vector<Ring>> all[] = {
            {"LBNL/Klems Full",
             rings({{5, 1}, {15, 8}, {25, 16}, {35, 20}, {45, 24}, {55, 24}, {65, 24}, {75, 16}, {90, 12}})},
            {"LBNL/Klems Half", rings({{6.5, 1}, {19.5, 8}, {32.5, 12}, {46.5, 16}, {61.5, 20}, {76.5, 12}, {90, 4}})},
            {"LBNL/Klems Quarter", rings({{9, 1}, {27, 8}, {46, 12}, {66, 12}, {90, 8}})},
        };
        for (const auto& [basis, list] : all)
            made.try_emplace(basis, basis, list, basis);
        return made;
    }();
    const auto found = bases.find(name);
    return found == bases.end() ? nullptr : &found->second;
}

const AngleBasis::Band& AngleBasis::band_of(int patch) const noexcept
{
    const auto after = std::upper_bound(bands_.begin(), bands_.end(), patch,
                                        [](int wanted, const Band& band) { return wanted < band.first; });
    return *(after - 1);
}

int AngleBasis::patch_at(const DiscPoint& p) const noexcept
{
    const double sine2 = p.x * p.x + p.y * p.y;
    const auto found = std::find_if(bands_.begin(), bands_.end() - 1, [&](const Band& b) { return sine2 < b.upper; });
    const double turns = std::atan2(p.y, p.x) / (2 * pi);
    const int index = static_cast<int>(std::floor((turns + 1) * found->patches + 0.5));
    return found->first + index % found->patches;
}

double AngleBasis::projected_sr(int patch) const noexcept
{
    const Band& band = band_of(patch);
    return pi * (band.upper - band.lower) / band.patches;
}

DiscPoint AngleBasis::within(int patch, UnitSquare u) const noexcept
{
    const Band& band = band_of(patch);
    const double radius = std::sqrt(band.lower + u.u * (band.upper - band.lower));
    const double azimuth = 2 * pi * (patch - band.first + u.v - 0.5) / band.patches;
    return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

} // namespace lightwell
