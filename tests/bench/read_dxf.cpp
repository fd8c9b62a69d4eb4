// DXF: how fast faces and inserts are read, beside ezdxf and Assimp's own program.
// Usage: bench_read_dxf [MEGABYTES]   (100 unless told)
// Prints processor seconds, megabytes a second and the largest memory of the process above its start for 3DFACEs, the
// bytes that one more insert of a block keeps, and, where /usr/bin/python3 with ezdxf and `assimp` are there, the
// processor seconds of those on a tenth of the file and the ratios. Goals: 100 MB in less than 1.2 s and three times
// the file in memory; 200 bytes an insert.

#include "importers/importer.h"
#include "tests/bench/measure.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>

namespace {

using namespace lightwell;

constexpr double bytes_per_megabyte = 1e6;
constexpr const char* head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\n";
constexpr const char* tail = "0\nENDSEC\n0\nEOF\n";

/// Faces of two layers as release 12 writes them, some 250 bytes each, no two alike.
std::string many_faces(std::size_t bytes)
{
    std::string text = std::string{head} + "ENTITIES\n";
    text.reserve(bytes + 1000);
    char entity[600];
    for (int i = 0; text.size() < bytes; ++i) {
        const double x = i % 1000 * 0.25, y = i / 1000 * 0.25, z = (i * 7919L % 1000) * 0.001 + 0.123456;
        const int length = std::snprintf(
            entity, sizeof entity,
            "  0\n3DFACE\n  5\n%X\n  8\n%s\n 10\n%.6f\n 20\n%.6f\n 30\n%.6f\n 11\n%.6f\n 21\n%.6f\n 31\n"
            "%.6f\n 12\n%.6f\n 22\n%.6f\n 32\n%.6f\n 13\n%.6f\n 23\n%.6f\n 33\n%.6f\n",
            i + 256, i % 10 == 0 ? "A-ROOF" : "A-WALL", x, y, z, x + .2, y, z, x + .2, y + .2, z, x, y + .2, z);
        text.append(entity, static_cast<std::size_t>(length));
    }
    return text + tail;
}

/// A block with one face on its own layer, or on layer 0, and copies of it.
std::string many_inserts(int copies, const char* layer)
{
    std::string text = std::string{head} + "BLOCKS\n0\nBLOCK\n2\nCHAIR\n10\n0\n20\n0\n30\n0\n0\n3DFACE\n8\n" + layer +
                       "\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\n"
                       "ENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    for (int i = 0; i < copies; ++i)
        text += "0\nINSERT\n5\n" + std::to_string(1000 + i) + "\n2\nCHAIR\n8\nFURNITURE\n10\n" +
                std::to_string(i % 100) + "\n20\n" + std::to_string(i / 100) + "\n30\n0\n";
    return text + tail;
}

/// Processor seconds of a program; nothing when it is not there or fails.
double seconds_of(const std::string& command)
{
    const auto used = [] {
        rusage usage;
        getrusage(RUSAGE_CHILDREN, &usage);
        const auto seconds = [](const timeval& t) {
            return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
        };
        return seconds(usage.ru_utime) + seconds(usage.ru_stime);
    };
    const double before = used();
    const int status = std::system((command + " > /dev/null 2>&1").c_str());
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? used() - before : 0;
}

double peak_bytes()
{
    constexpr double bytes_per_kilobyte = 1024;
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * bytes_per_kilobyte;
}

double heap_bytes()
{
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// @return seconds for a megabyte
double measure_faces(const std::filesystem::path& file)
{
    const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / bytes_per_megabyte;
    const double before = resident_bytes();
    double best = 0;
    for (int run = 1; run <= 3; ++run) {
        const double start = cpu_seconds();
        const Imported imported = import_dxf(file, {});
        const double seconds = cpu_seconds() - start;
        best = run == 1 ? seconds : std::min(best, seconds);
        const auto faces = static_cast<double>(imported.scene.root.polygons.size());
        std::printf("run %d: %.1f MB, %.0f faces: %.2f s, %.1f MB/s, %.0f faces/s\n", run, megabytes, faces, seconds,
                    megabytes / seconds, faces / seconds);
        if (run == 1)
            std::printf("       memory above the start: at most %.0f MB, %.2f times the file\n",
                        (peak_bytes() - before) / bytes_per_megabyte,
                        (peak_bytes() - before) / bytes_per_megabyte / megabytes);
    }
    return best / megabytes;
}

void measure_inserts(const TemporaryFolder& folder, const char* layer)
{
    constexpr int copies = 10000;
    const auto kept = [&](int count) {
        const std::filesystem::path file = folder.write("inserts.dxf", many_inserts(count, layer));
        const double before = heap_bytes();
        const Imported imported = import_dxf(file, {});
        return heap_bytes() - before;
    };
    const double one = kept(1), many = kept(copies);
    std::printf("%d inserts of a block drawn on layer %s: %.0f bytes each above one\n", copies, layer,
                (many - one) / (copies - 1));
}

void measure_others(const std::filesystem::path& file, double ours)
{
    const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / bytes_per_megabyte;
    const std::string python = "/usr/bin/python3 -c \"import ezdxf";
    const double ezdxf_start = seconds_of(python + "\""), assimp_start = seconds_of("assimp version");
    const double ezdxf = seconds_of(python + "; d = ezdxf.readfile('" + file.string() +
                                    "'); print(sum(1 for e in d.modelspace() if e.dxf.vtx0))\"");
    const double assimp = seconds_of("assimp info " + file.string());
    for (const auto& [name, seconds] :
         {std::pair{"ezdxf", ezdxf - ezdxf_start}, {"assimp info", assimp - assimp_start}})
        if (seconds > 0)
            std::printf("%s: %.2f s for %.1f MB without its start, %.0f times ours\n", name, seconds, megabytes,
                        seconds / megabytes / ours);
        else
            std::printf("%s: not there, or it refuses the file\n", name);
}

} // namespace

int main(int argc, char** argv)
{
    const double megabytes = argc > 1 ? std::atof(argv[1]) : 100;
    if (!(megabytes > 0 && megabytes < 10000)) {
        std::fprintf(stderr, "usage: bench_read_dxf [MEGABYTES], below 10000\n");
        return EXIT_FAILURE;
    }
    try {
        const TemporaryFolder folder;
        const auto bytes = static_cast<std::size_t>(megabytes * bytes_per_megabyte);
        const std::filesystem::path big = folder.write("big.dxf", many_faces(bytes)); // the text is gone again here
        const double ours = measure_faces(big);
        measure_others(folder.write("tenth.dxf", many_faces(bytes / 10)), ours);
        measure_inserts(folder, "SEAT");
        measure_inserts(folder, "0");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
