// Scene text: how fast polygons are read.
// Usage: bench_read_radiance [MEGABYTES]   (100 unless told)
// First a process of its own compiles the text, and another loads what came of it: processor seconds and the most
// memory in use. Goal for a million polygons (152 MB): 4 s and 600 MB, 0.5 s. Then prints, for each of three runs,
// processor seconds of the reading thread, megabytes a second and polygons a second, then the memory that the scene
// takes. Goal: 100 MB in less than 2 s on one processor.

#include "importers/radiance/compiled_scene.h"
#include "importers/radiance/radiance.h"
#include "tests/bench/measure.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>

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

/// Runs this in a process of its own, and prints what it took.
void measure_apart(const char* what, const std::function<void()>& work)
{
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        try {
            work();
            _exit(EXIT_SUCCESS);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            _exit(EXIT_FAILURE);
        }
    }
    int status = 0;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0)
        throw std::runtime_error(std::string(what) + " failed");
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    constexpr double kilobytes_per_megabyte = 1024;
    std::printf("%s: %.2f s user, %.2f s system, at most %.0f MB in use\n", what, seconds(used.ru_utime),
                seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / kilobytes_per_megabyte);
}

/// What oconv does, and what the programs that take its output begin with.
void measure_compiled(const std::filesystem::path& file, const std::filesystem::path& compiled)
{
    measure_apart("compiled", [&] {
        Report report;
        const NamedScene named = read_radiance_sources({{file.string()}}, report);
        std::ofstream out(compiled, std::ios::binary);
        write_compiled(named, {}, out);
    });
    measure_apart("loaded", [&] {
        Report report;
        const NamedScene named = read_radiance_sources({{compiled.string()}}, report);
        if (named.scene.root.polygons.empty())
            throw std::runtime_error("the compiled scene is empty");
    });
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
        const std::filesystem::path file =
            folder.write("big.rad", many_polygons(static_cast<std::size_t>(megabytes * bytes_per_megabyte)));
        measure_compiled(file, std::filesystem::path(file).replace_extension(".oct"));
        measure(file);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
