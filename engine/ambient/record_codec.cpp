#include "engine/ambient/record_codec.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Takes numbers from the front; what does not make sense is remembered.
class Numbers {
public:
    explicit Numbers(std::span<const double> numbers) : rest_(numbers) {}

    bool at_end() const { return rest_.empty(); }
    bool sound() const { return sound_; }
    void demand(bool truth) { sound_ = sound_ && truth; }
    double any()
    {
        const double number = rest_.front();
        rest_ = rest_.subspan(1);
        return number;
    }
    double finite()
    {
        const double number = any();
        demand(std::isfinite(number));
        return number;
    }
    Vec3 vector()
    {
        const double x = finite(), y = finite(), z = finite();
        return {x, y, z};
    }
    Direction direction()
    {
        constexpr double rounding = 1e-6;
        const Vec3 v = vector();
        demand(std::fabs(length(v) - 1) < rounding);
        return v;
    }
    Spectrum spectrum()
    {
        const double r = finite(), g = finite(), b = finite();
        return {r, g, b};
    }

private:
    std::span<const double> rest_;
    bool sound_ = true;
};

void put(std::vector<double>& to, const Vec3& v)
{
    to.insert(to.end(), {v.x, v.y, v.z});
}

void put(std::vector<double>& to, Spectrum s)
{
    to.insert(to.end(), {s.r, s.g, s.b});
}

void put(std::vector<double>& to, const AmbientSite& site)
{
    put(to, site.position);
    put(to, site.normal);
    put(to, site.axis);
    to.insert(to.end(), {site.reach_m[0], site.reach_m[1], site.harmonic_m, site.least_horizon_m});
    for (const Horizon& h : site.horizon)
        to.insert(to.end(), {h.distance_m, h.into_x, h.into_y, h.met_m});
}

AmbientSite take_site(Numbers& from)
{
    AmbientSite site;
    site.position = from.vector();
    site.normal = from.direction();
    site.axis = from.direction();
    for (double& reach : site.reach_m) {
        reach = from.finite();
        from.demand(reach > 0);
    }
    site.harmonic_m = from.finite();
    from.demand(site.harmonic_m > 0);
    site.least_horizon_m = from.any(); // infinite where nothing stands around
    from.demand(site.least_horizon_m >= 0);
    for (Horizon& h : site.horizon) {
        h.distance_m = static_cast<float>(from.any());
        h.into_x = static_cast<float>(from.finite());
        h.into_y = static_cast<float>(from.finite());
        h.met_m = static_cast<float>(from.any());
        from.demand(h.distance_m >= 0 && h.met_m >= 0);
    }
    return site;
}

AmbientRecord take_record(Numbers& from)
{
    AmbientRecord record;
    record.site = take_site(from);
    record.irradiance = from.spectrum();
    for (Vec3& gradient : record.gradient.translation)
        gradient = from.vector();
    for (Vec3& gradient : record.gradient.rotation)
        gradient = from.vector();
    for (float& deviation : record.deviation)
        deviation = static_cast<float>(from.finite());
    return record;
}

} // namespace

std::vector<double> encode_records(std::span<const AmbientRecord> records)
{
    std::vector<double> numbers;
    numbers.reserve(records.size() * numbers_in_record);
    for (const AmbientRecord& record : records) {
        put(numbers, record.site);
        put(numbers, record.irradiance);
        for (const Vec3& gradient : record.gradient.translation)
            put(numbers, gradient);
        for (const Vec3& gradient : record.gradient.rotation)
            put(numbers, gradient);
        numbers.insert(numbers.end(), record.deviation.begin(), record.deviation.end());
    }
    return numbers;
}

std::optional<std::vector<AmbientRecord>> decode_records(std::span<const double> numbers)
{
    if (numbers.size() % numbers_in_record != 0)
        return std::nullopt;
    std::vector<AmbientRecord> records;
    Numbers from(numbers);
    while (!from.at_end() && from.sound())
        records.push_back(take_record(from));
    return from.sound() ? std::optional(std::move(records)) : std::nullopt;
}

std::vector<double> encode_deep(const DeepSolution& deep)
{
    std::vector<double> numbers;
    if (deep.sites.size() * numbers_in_deep_site > most_numbers_in_block)
        return numbers;
    for (std::size_t i = 0; i < deep.sites.size(); ++i) {
        put(numbers, deep.sites[i]);
        for (const std::vector<Spectrum>& ambient : deep.ambient)
            put(numbers, ambient[i]);
        put(numbers, deep.direct[i]);
        numbers.insert(numbers.end(), {deep.tested_share[i], deep.lit_W_per_m2[i], deep.visits[i]});
    }
    return numbers;
}

std::optional<DeepSolution> decode_deep(std::span<const double> numbers)
{
    if (numbers.empty() || numbers.size() % numbers_in_deep_site != 0)
        return std::nullopt;
    DeepSolution deep;
    Numbers from(numbers);
    while (!from.at_end() && from.sound()) {
        deep.sites.push_back(take_site(from));
        for (std::vector<Spectrum>& ambient : deep.ambient)
            ambient.push_back(from.spectrum());
        deep.direct.push_back(from.spectrum());
        deep.tested_share.push_back(from.finite());
        from.demand(deep.tested_share.back() > 0 && deep.tested_share.back() <= 1);
        deep.lit_W_per_m2.push_back(from.finite());
        deep.visits.push_back(from.finite());
    }
    return from.sound() ? std::optional(std::move(deep)) : std::nullopt;
}

} // namespace lightwell
