#include "plugins/insight/explain.h"

#include "engine/base/errors.h"
#include "engine/base/random.h"
#include "engine/base/threads.h"
#include "engine/sampling/replicates.h"
#include "engine/sampling/statistics.h"
#include "engine/simulate/follow_paths.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

namespace lightwell {
namespace {

/// Beyond this many reflections they are told together.
constexpr std::size_t most_bounces = 12;
constexpr const char* straight = "(straight from the sources)";
constexpr std::uint32_t first_paths = 256, most_paths = 1u << 22; ///< of a replicate and source

/// What emits on its own, under its layer's name.
struct Emitter {
    ModifierId modifier;
    std::string name;
};

/// The modifier at the end of a chain of other names.
const Modifier* end_of(const Scene& scene, ModifierId id)
{
    while (id != void_modifier) {
        const Modifier& modifier = scene.modifiers[static_cast<std::size_t>(id)];
        const auto* alias = std::get_if<Alias>(&modifier.what);
        if (alias == nullptr)
            return &modifier;
        id = alias->target;
    }
    return nullptr;
}

bool emits(const Modifier* modifier)
{
    const Material* material = modifier != nullptr ? std::get_if<Material>(&modifier->what) : nullptr;
    return material != nullptr && is_emitter(*material) && !emitted_radiance(*material).is_black();
}

/// Everything that emits, in the order in which it is met; each gets a material of its own, so that it can be put out.
std::vector<Emitter> separate_emitters(Scene& scene)
{
    std::vector<Emitter> emitters;
    std::set<ModifierId> seen;
    const auto consider = [&](ModifierId id, const std::string& name) {
        if (id == void_modifier || !seen.insert(id).second)
            return;
        const Modifier* end = end_of(scene, id);
        if (!emits(end))
            return;
        const Modifier own{scene.modifiers[static_cast<std::size_t>(id)].name, end->what, end->parent};
        emitters.push_back({id, name.empty() ? own.name : name});
        scene.modifiers[static_cast<std::size_t>(id)] = own;
    };
    visit_expanded(scene, [&](const Part&, const Surface& surface, const Affine&, ModifierId modifier) {
        consider(modifier, surface.shape == Shape::source ? surface.name : "");
    });
    return emitters;
}

void put_out(Scene& scene, ModifierId id)
{
    Material& material = std::get<Material>(scene.modifiers[static_cast<std::size_t>(id)].what);
    material = tinted(material, Spectrum::grey(0));
}

/// Sums of one replicate of one source.
class Tally : public PathListener {
public:
    explicit Tally(std::size_t modifiers) : layers_(modifiers + 1), effects_(modifiers) {}

    void begin() override
    {
        way_.clear();
        ++paths;
    }
    void bent(ModifierId modifier) override { way_.push_back(modifier); }
    void added(const Spectrum& irradiance, ModifierId at) override
    {
        const double lux = illuminance_of(irradiance).value;
        total += lux;
        const std::size_t bounces = way_.size() + (at == void_modifier ? 0 : 1);
        bounced[std::min(bounces, most_bounces)] += lux;
        const ModifierId first = way_.empty() ? at : way_.front();
        layers_[static_cast<std::size_t>(first + 1)] += lux;
        for (const ModifierId modifier : way_)
            effects_[static_cast<std::size_t>(modifier)] += lux;
        if (at != void_modifier)
            effects_[static_cast<std::size_t>(at)] += lux;
    }

    std::uint64_t paths = 0;
    double total = 0;
    std::array<double, most_bounces + 1> bounced{};
    double mean() const { return total / static_cast<double>(paths); }
    double mean_bounced(std::size_t i) const { return bounced[i] / static_cast<double>(paths); }
    double mean_layer(std::size_t i) const { return layers_[i] / static_cast<double>(paths); }
    double mean_effect(std::size_t i) const { return effects_[i] / static_cast<double>(paths); }

private:
    std::vector<ModifierId> way_;
    std::vector<double> layers_, effects_;
};

/// One source alone.
struct Run {
    std::string name;
    PathFollower follower;
    std::vector<Tally> tallies;
    std::uint64_t key;

    RunningStatistics statistics() const
    {
        RunningStatistics s;
        for (const Tally& tally : tallies)
            s.add(tally.mean());
        return s;
    }
    void go_on(const Sensor& sensor, std::uint32_t count, int threads)
    {
        const auto first = static_cast<std::uint32_t>(tallies[0].paths);
        parallel_for(tallies.size(), threads,
                     [&](std::size_t r) { follower.follow(sensor, mix_bits(key, r), first, count, tallies[r]); });
    }
};

std::vector<Run> runs_of(Scene scene, const ExplainSettings& settings)
{
    const std::vector<Emitter> emitters = separate_emitters(scene);
    if (emitters.empty())
        throw InputError{"explain", "nothing in the scene emits light",
                         "add a sky with its place and time, or map a layer to an emitting material"};
    std::map<std::string, std::vector<ModifierId>> groups; // layers of one name are one source
    for (const Emitter& emitter : emitters)
        groups[emitter.name].push_back(emitter.modifier);
    std::vector<Run> runs;
    for (const auto& [name, members] : groups) {
        Scene alone = scene;
        for (const Emitter& emitter : emitters)
            if (std::find(members.begin(), members.end(), emitter.modifier) == members.end())
                put_out(alone, emitter.modifier);
        const std::size_t modifiers = alone.modifiers.size();
        runs.push_back({name, PathFollower(std::move(alone), settings.preparation),
                        std::vector<Tally>(replicates, Tally(modifiers)), mix_bits(settings.seed, runs.size())});
    }
    return runs;
}

double whole_error(const std::vector<Run>& runs, double& whole)
{
    double squares = 0;
    whole = 0;
    for (const Run& run : runs) {
        const RunningStatistics s = run.statistics();
        whole += s.mean();
        squares += s.standard_error() * s.standard_error();
    }
    return std::sqrt(squares);
}

/// The source whose error is largest gets twice its paths, until the whole is known well enough.
void measure(std::vector<Run>& runs, const Sensor& sensor, const ExplainSettings& settings, const Progress& progress)
{
    for (Run& run : runs)
        run.go_on(sensor, first_paths, settings.threads);
    for (;;) {
        if (progress.stop())
            throw Cancelled{};
        double whole = 0;
        const double error = whole_error(runs, whole);
        progress.tell("paths", std::min(0.99, error > 0 ? settings.accuracy * whole / error : 0.99));
        Run* worst = nullptr;
        for (Run& run : runs)
            if (run.tallies[0].paths < most_paths &&
                (worst == nullptr || run.statistics().standard_error() > worst->statistics().standard_error()))
                worst = &run;
        if (error <= settings.accuracy * whole || worst == nullptr)
            return;
        worst->go_on(sensor, static_cast<std::uint32_t>(worst->tallies[0].paths), settings.threads);
    }
}

/// A sum over all sources, replicate by replicate.
template <class Mean>
Share sum_over(const std::string& name, const std::vector<Run>& runs, const Mean& mean)
{
    Share share{name};
    double squares = 0;
    for (const Run& run : runs) {
        RunningStatistics s;
        for (const Tally& tally : run.tallies)
            s.add(mean(tally));
        share.lux += s.mean();
        squares += s.standard_error() * s.standard_error();
    }
    share.standard_error = std::sqrt(squares);
    return share;
}

void sort_by_size(std::vector<Share>& shares)
{
    std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.lux > b.lux; });
}

void check_sensor(const Sensor& sensor)
{
    const double sum =
        sensor.position.x + sensor.position.y + sensor.position.z + sensor.normal.x + sensor.normal.y + sensor.normal.z;
    if (!std::isfinite(sum) || !(length(sensor.normal) > 0))
        throw InputError{"sensor", "a number is not finite, or the direction is 0", "x,y,z or x,y,z,nx,ny,nz"};
}

} // namespace

double half_width_95(double standard_error) noexcept
{
    constexpr double t = 2.365; // Student's t with 7 degrees of freedom
    return t * standard_error;
}

Explanation explain(const Scene& scene, const Sensor& sensor, const ExplainSettings& settings, const Progress& progress)
{
    check_sensor(sensor);
    std::vector<Run> runs = runs_of(scene, settings);
    measure(runs, sensor, settings, progress);
    Explanation found;
    found.sensor = sensor;
    const Share whole = sum_over("", runs, [](const Tally& t) { return t.mean(); });
    found.lux = whole.lux;
    found.standard_error = whole.standard_error;
    for (const Run& run : runs) {
        const RunningStatistics s = run.statistics();
        found.sources.push_back({run.name, s.mean(), s.standard_error()});
        found.paths += run.tallies[0].paths * run.tallies.size();
    }
    sort_by_size(found.sources);
    for (std::size_t i = 0; i <= most_bounces; ++i) {
        const Share share = sum_over(std::to_string(i) + (i == most_bounces ? " and more" : ""), runs,
                                     [i](const Tally& t) { return t.mean_bounced(i); });
        if (share.lux > 0)
            found.bounces.push_back(share);
    }
    // Layers of one name are one layer.
    std::map<std::string, std::vector<std::size_t>> names;
    const std::vector<Modifier>& modifiers = runs[0].follower.scene().modifiers;
    for (std::size_t i = 0; i < modifiers.size(); ++i)
        names[modifiers[i].name].push_back(i);
    found.layers.push_back(sum_over(straight, runs, [](const Tally& t) { return t.mean_layer(0); }));
    for (const auto& [name, ids] : names) {
        const auto over = [&ids = ids](const auto& of) {
            double sum = 0;
            for (const std::size_t id : ids)
                sum += of(id);
            return sum;
        };
        const Share seen = sum_over(
            name, runs, [&](const Tally& t) { return over([&](std::size_t id) { return t.mean_layer(id + 1); }); });
        if (seen.lux > 0)
            found.layers.push_back(seen);
        const Share met = sum_over(
            name, runs, [&](const Tally& t) { return over([&](std::size_t id) { return t.mean_effect(id); }); });
        const ResolvedMaterial resolved = resolve(runs[0].follower.scene(), static_cast<ModifierId>(ids.back()));
        const double reflectance = resolved.material != nullptr ? photopic(typical_reflectance(*resolved.material)) : 0;
        if (met.lux > 0 && reflectance > 0)
            found.effects.push_back({name, reflectance, met.lux / reflectance, met.standard_error / reflectance});
    }
    sort_by_size(found.layers);
    std::stable_sort(found.effects.begin(), found.effects.end(), [](const LayerEffect& a, const LayerEffect& b) {
        return a.lux_per_reflectance > b.lux_per_reflectance;
    });
    return found;
}

} // namespace lightwell
