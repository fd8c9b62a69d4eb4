// Scene text: how fast polygons are read.
// Usage: bench_read_radiance [MEGABYTES]   (100 unless told)
// Prints, for each of three runs, processor seconds of the reading thread, megabytes a second and polygons a second,
// then the memory that the scene takes. Goal: 100 MB in less than 2 s on one processor.

#include "importers/radiance/radiance.h"
#include "tests/bench/measure.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

using namespace lightwell;

constexpr double bytes_per_megabyte = 1e6;

/// Quadrilaterals of two materials, some 150 bytes each, no two alike.
std::string many_polygons(std::size_t bytes)
{
    std::string text = "void plastic grey\n0\n0\n5 .5 .5 .5 0 0\nvoid plastic white\n0\n0\n5 .8 .8 .8 0 0\n";
    text.reserve(bytes + 1000);
    char line[300];
    for (int i = 0; text.size() < bytes; ++i) {
        const double x = i % 1000 * 0.25, y = i / 1000 * 0.25, z = (i * 7919L % 1000) * 0.001 + 0.123456;
        const int length = std::snprintf(
            line, sizeof line, "%s polygon p%d\n0\n0\n12 %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n",
            i % 10 == 0 ? "white" : "grey", i, x, y, z, x + .2, y, z, x + .2, y + .2, z, x, y + .2, z);
        text.append(line, static_cast<std::size_t>(length));
    }
    return text;
}

void measure(const std::filesystem::path& file)
{
    const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / bytes_per_megabyte;
    const double before = resident_bytes();
    for (int run = 1; run <= 3; ++run) {
        Report report;
        const double start = cpu_seconds();
        const Scene scene = read_radiance(file, report);
        const double seconds = cpu_seconds() - start;
        const auto polygons = static_cast<double>(scene.root.polygons.size());
        std::printf("run %d: %.1f MB, %.0f polygons: %.2f s, %.1f MB/s, %.0f polygons/s\n", run, megabytes, polygons,
                    seconds, megabytes / seconds, polygons / seconds);
        if (run == 1)
            std::printf("       memory above the start: %.0f MB, %.0f bytes a polygon\n",
                        (resident_bytes() - before) / bytes_per_megabyte, (resident_bytes() - before) / polygons);
    }
}

} // namespace

int main(int argc, char** argv)
{
    const double megabytes = argc > 1 ? std::atof(argv[1]) : 100;
    if (!(megabytes > 0 && megabytes < 10000)) {
        std::fprintf(stderr, "usage: bench_read_radiance [MEGABYTES], below 10000\n");
        return EXIT_FAILURE;
    }
    try {
        const TemporaryFolder folder;
        measure(folder.write("big.rad", many_polygons(static_cast<std::size_t>(megabytes * bytes_per_megabyte))));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
