#include "engine/simulate/simulate.h"

#include "engine/simulate/parts.h"
#include "engine/simulate/replicates.h"
#include "materials/bsdf.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {
namespace {

/// Dimmer items than this share of the mean say nothing about relative accuracy.
constexpr double dark_share = 1e-4;

} // namespace

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_relative(const std::vector<double>& values, const std::vector<double>& errors)
{
    double mean = 0;
    for (const double v : values)
        mean += v / static_cast<double>(values.size());
    std::vector<double> relative;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] > dark_share * mean)
            relative.push_back(errors[i] / values[i]);
    if (relative.empty())
        return 0;
    const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::nth_element(relative.begin(), middle, relative.end());
    return *middle;
}

int whole_replicates(int samples)
{
    return std::max(1, (samples + replicates - 1) / replicates) * replicates;
}

namespace {

double without_shared(double found, double shared)
{
    return std::sqrt(std::fmax(found * found - shared * shared, 0));
}

} // namespace

PilotErrors pilot_errors(double found, int samples, double shared) noexcept
{
    constexpr double least_share = 0.25; // of what was found: a smaller rest is lost in the noise of both
    return {shared, std::fmax(without_shared(found, shared), least_share * found), samples, 0.5};
}

PilotErrors pilot_errors(double found, int samples, double shared, double found_with_fewer, int fewer) noexcept
{
    constexpr double least = 0.5, most = 0.9; // independent samples; more than this is chance
    const double times = static_cast<double>(samples) / fewer;
    const double own_with_fewer = without_shared(found_with_fewer, shared);
    PilotErrors pilot = pilot_errors(found, samples, shared);
    pilot.own = std::fmax(pilot.own, own_with_fewer * std::pow(times, -most));
    if (own_with_fewer > pilot.own)
        pilot.order = std::clamp(std::log(own_with_fewer / pilot.own) / std::log(times), least, most);
    return pilot;
}

int samples_for(const PilotErrors& pilot, double wanted, int most) noexcept
{
    constexpr double least_own = 0.5; // of the wanted error
    const double own_wanted = std::fmax(without_shared(wanted, pilot.shared), least_own * wanted);
    const double samples = pilot.samples * std::pow(pilot.own / own_wanted, 1 / pilot.order);
    return whole_replicates(static_cast<int>(std::ceil(std::min(samples, static_cast<double>(most)))));
}

void check_accuracy(double accuracy, const std::string& place)
{
    if (!(accuracy > 0 && accuracy < 1))
        throw InputError{place, fmt::format("accuracy is {}, expected between 0 and 1", accuracy), "write 5% or 0.05"};
}

Simulation::Simulation(Scene scene, const Preparation& preparation)
{
    validate(scene);
    parts_ = std::make_unique<SimulationParts>(std::move(scene), preparation);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const Scene& Simulation::scene() const noexcept
{
    return parts_->scene;
}

const Preparation& Simulation::preparation() const noexcept
{
    return parts_->preparation;
}

const Plan& Simulation::plan() const noexcept
{
    return parts_->plan;
}

PreparedStages Simulation::prepared() const
{
    const SourceList& sources = parts_->sources;
    PreparedStages found;
    found.lamps = sources.lamps().size();
    found.suns = sources.suns().size();
    found.openings = sources.guide().openings();
    found.mirrors = parts_->virtual_sources.mirrors().mirrors().size();
    found.virtual_sources = parts_->virtual_sources.images().size();
    for (const auto& [modifier, usage] : usage_by_modifier(scene())) {
        const ResolvedMaterial resolved = resolve(scene(), modifier);
        found.patterns += resolved.brightness != nullptr || resolved.varies ? 1 : 0;
        if (resolved.material == nullptr || is_emitter(*resolved.material))
            continue;
        const Lobes lobes = Bsdf(*resolved.material, true).lobes();
        found.see_through += lobes.transparent_to_shadows ? 1 : 0;
        found.both_sides += lobes.diffuse_transmittance.is_black() ? 0 : 1;
    }
    return found;
}

std::size_t Simulation::query_bytes() const noexcept
{
    return parts_->rays.bytes();
}

} // namespace lightwell
