// Light straight from lamps and suns at points, by tested shadow rays.
// Usage: bench_direct_points SCENE.rad POINTS.txt [SETTING=VALUE ...]
// POINTS.txt has six numbers a line: x y z nx ny nz. Settings are those of DirectSettings (threshold, certainty,
// subdivision, penumbra_noise, most_rays, most_lamps, lamp_groups, adaptive, subdivide, analytic, tree,
// sampled_remainder), and
//   passes=N   gathers at every point, averaged (1)
//   sparse=N   shadow rays at random instead of tested ones, N at a time
//   seed=N
// Prints one value a point (photopic irradiance, W/m^2) to standard output; processor seconds of the gathers alone,
// shadow rays, tested and untested sources to standard error.

#include "engine/base/report.h"
#include "engine/direct/direct_light.h"
#include "importers/radiance/radiance.h"
#include "tests/bench/measure.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <vector>

namespace {

using namespace lightwell;

/// Points after which the visibility histories are renewed: the first generations are short, as little is known.
constexpr std::size_t first_generation = 64;

struct Options {
    DirectSettings settings;
    int passes = 1, sparse = 0;
    std::uint64_t seed = 1;
};

bool read_option(Options& o, const char* word)
{
    const char* equals = std::strchr(word, '=');
    if (equals == nullptr)
        return false;
    const std::string name(word, equals);
    const double value = std::atof(equals + 1);
    DirectSettings& s = o.settings;
    const std::pair<const char*, double*> numbers[] = {{"threshold", &s.threshold},
                                                       {"certainty", &s.certainty},
                                                       {"subdivision", &s.subdivision},
                                                       {"penumbra_noise", &s.penumbra_noise}};
    const std::pair<const char*, bool*> switches[] = {{"adaptive", &s.adaptive},
                                                      {"subdivide", &s.subdivide},
                                                      {"analytic", &s.analytic},
                                                      {"tree", &s.tree},
                                                      {"sampled_remainder", &s.sampled_remainder}};
    for (const auto& [known, number] : numbers)
        if (name == known)
            return *number = value, true;
    for (const auto& [known, on] : switches)
        if (name == known)
            return *on = value != 0, true;
    if (name == "most_rays")
        s.most_rays = static_cast<int>(value);
    else if (name == "most_lamps")
        s.most_lamps = static_cast<std::size_t>(value);
    else if (name == "lamp_groups")
        s.lamp_groups = static_cast<std::size_t>(value);
    else if (name == "passes")
        o.passes = static_cast<int>(value);
    else if (name == "sparse")
        o.sparse = static_cast<int>(value);
    else if (name == "seed")
        o.seed = static_cast<std::uint64_t>(value);
    else
        return false;
    return true;
}

std::vector<Hit> read_points(const char* file)
{
    std::ifstream in(file);
    std::vector<Hit> points;
    Hit hit;
    while (in >> hit.position.x >> hit.position.y >> hit.position.z >> hit.normal.x >> hit.normal.y >> hit.normal.z) {
        hit.shading_normal = hit.normal;
        points.push_back(hit);
    }
    return points;
}

void measure(const Options& options, const char* scene_file, const char* points_file)
{
    Report report;
    const Scene scene = read_radiance(scene_file, report);
    const RayQueries rays(scene);
    const double building = cpu_seconds();
    const SourceList sources(scene, rays);
    const double built = cpu_seconds() - building;
    const DirectLight direct(sources, rays, options.settings);
    const Material white = Plastic{Spectrum::grey(1), 0, 0};
    const std::vector<Hit> points = read_points(points_file);
    VisibilityCounts counts(direct.sources());
    VisibilityHistory history;
    std::vector<double> values;
    std::uint64_t shadow_rays = 0, tested = 0, untested = 0;
    std::size_t next_generation = first_generation;
    const double start = cpu_seconds();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == next_generation) {
            history = VisibilityHistory(counts);
            next_generation *= 2;
        }
        const Vertex vertex(points[i], -points[i].normal, white);
        double sum = 0;
        for (int pass = 0; pass < options.passes; ++pass) {
            PathRandom random(options.seed, i, static_cast<std::uint32_t>(pass));
            SourceShares shares;
            const Gathered found = options.sparse > 0
                                       ? direct.gather(vertex, {options.sparse}, random, shares)
                                       : direct.gather_tested(vertex, {}, {&history, &counts}, random, shares);
            sum += photopic(found.irradiance);
            shadow_rays += static_cast<std::uint64_t>(found.shadow_rays);
            tested += static_cast<std::uint64_t>(found.tested);
            untested += static_cast<std::uint64_t>(found.untested);
        }
        values.push_back(sum / options.passes);
    }
    const double seconds = cpu_seconds() - start;
    for (const double value : values)
        std::printf("%.9g\n", value);
    std::fprintf(
        stderr,
        "lamps %zu built %.4f s gathers %.4f s %.2f us/point shadow_rays %.2f/point tested %.2f untested %.2f\n",
        sources.lamps().size(), built, seconds, 1e6 * seconds / static_cast<double>(points.size()),
        static_cast<double>(shadow_rays) / static_cast<double>(points.size()),
        static_cast<double>(tested) / static_cast<double>(points.size()),
        static_cast<double>(untested) / static_cast<double>(points.size()));
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    for (int i = 3; i < argc; ++i)
        if (!read_option(options, argv[i])) {
            std::fprintf(stderr, "%s: no such setting\n", argv[i]);
            return EXIT_FAILURE;
        }
    if (argc < 3) {
        std::fprintf(stderr, "usage: bench_direct_points SCENE.rad POINTS.txt [SETTING=VALUE ...]\n");
        return EXIT_FAILURE;
    }
    try {
        measure(options, argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
