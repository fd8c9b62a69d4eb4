#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "importers/formats/formats.h"
#include "tests/unit/import_measures/measure.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <new>
#include <random>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// How a reading in a process of its own has ended.
enum Ending { was_read, was_refused, refused_without_the_name, out_of_memory, unbalanced, other_exception };

Ending ending_of(const fs::path& file)
{
    try {
        const Imported imported = import_file(file, {});
        validate(imported.scene);
        std::size_t skipped = 0;
        for (const Ledger::Skipped& entry : imported.ledger.skipped_list())
            skipped += entry.count;
        return imported.ledger.read_count() == imported.ledger.made_count() + skipped ? was_read : unbalanced;
    } catch (const InputError& error) {
        return std::string(error.what()).find(file.filename().string()) != std::string::npos ? was_refused
                                                                                             : refused_without_the_name;
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    } catch (...) {
        return other_exception;
    }
}

/// Memory for data that this process has now, bytes.
std::size_t data_bytes()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    std::size_t kilobytes = 0;
    while (status >> word)
        if (word == "VmData:")
            status >> kilobytes;
    return 1024 * kilobytes;
}

/// Reads a file in a child that may hold 4 times the file plus 200 MB and take 20 s of the processor.
Ending read_within_bounds(const fs::path& file)
{
    constexpr rlim_t spare_bytes = 200'000'000, of_the_file = 4, seconds = 20;
    const pid_t child = fork();
    if (child == 0) {
        const auto lower = [](__rlimit_resource what, rlim_t value) {
            rlimit limit{};
            getrlimit(what, &limit);
            limit.rlim_cur = std::min(value, limit.rlim_max);
            setrlimit(what, &limit);
        };
        lower(RLIMIT_DATA, data_bytes() + spare_bytes + of_the_file * fs::file_size(file));
        lower(RLIMIT_CPU, seconds);
        lower(RLIMIT_CORE, 0);
        _exit(ending_of(file));
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << file << ": ended by signal " << WTERMSIG(status);
    return WIFEXITED(status) ? static_cast<Ending>(WEXITSTATUS(status)) : other_exception;
}

struct Counts {
    std::size_t read = 0, refused = 0;
    void add(const fs::path& file)
    {
        const Ending ending = read_within_bounds(file);
        EXPECT_TRUE(ending == was_read || ending == was_refused) << file << ": ending " << ending;
        ++(ending == was_read ? read : refused);
    }
};

bool sanitized()
{
#if defined(__SANITIZE_ADDRESS__)
    return true; // its shadow memory does not fit any bound
#else
    return false;
#endif
}

TEST(Malformed, EveryBrokenFileOfTheCollectionIsReadOrRefusedWithinFourTimesItsSizeAnd200Megabytes)
{
    if (sanitized() || !fs::exists(shared_fixtures() / "gltf-malformed"))
        GTEST_SKIP() << "no broken files beside the repository, or the sanitizer counts memory of its own";
    for (const char* kind : {"dxf", "obj", "gltf-malformed", "cad"}) {
        const auto manifest = nlohmann::json::parse(std::ifstream(shared_fixtures() / kind / "MANIFEST.json"));
        Counts counts;
        for (const auto& entry : manifest["entries"])
            if (entry.contains("malformed") && entry.contains("file"))
                counts.add(shared_fixtures() / kind / entry["file"].get<std::string>());
        std::cout << kind << ": " << counts.read << " read, " << counts.refused << " refused\n";
        EXPECT_GT(counts.read + counts.refused, 3u) << kind;
    }
}

/// Bytes changed, cut off, repeated: what a bad disk, an aborted copy and a bad merge leave.
std::string damaged(std::string bytes, std::mt19937& random)
{
    const auto somewhere = [&] { return random() % bytes.size(); };
    for (std::uint32_t i = random() % 6; i > 0; --i)
        bytes[somewhere()] = static_cast<char>(random());
    if (random() % 3 == 0)
        bytes.insert(somewhere(), bytes.substr(somewhere(), random() % 2000));
    if (random() % 3 == 0)
        bytes.resize(somewhere() + 1);
    return bytes;
}

TEST(Malformed, DamagedFixturesAreReadOrRefusedWithinFourTimesTheirSizeAnd200Megabytes)
{
    if (sanitized())
        GTEST_SKIP() << "the sanitizer counts memory of its own";
    const fs::path folder = fs::path(testing::TempDir()) / ("malformed-" + std::to_string(getpid()));
    fs::create_directories(folder);
    std::mt19937 random(41);
    Counts counts;
    for (const char* name : {"dxf/entities_r2018.dxf", "dxf/areas_r2007_binary.dxf", "dxf/references_r2000.dxf",
                             "dxf/styles_r12_binary.dxf", "obj/room.obj", "obj/warped.obj", "gltf/looks.glb",
                             "gltf/packings.gltf", "gltf/poses.gltf"}) {
        const fs::path original = fs::path(LIGHTWELL_ROOT "/tests/fixtures") / name;
        const std::string bytes{MappedFile(original).bytes()};
        for (int round = 0; round < 8; ++round) {
            const fs::path copy = folder / ("damaged" + original.extension().string());
            std::ofstream(copy, std::ios::binary) << damaged(bytes, random);
            SCOPED_TRACE(std::string(name) + " round " + std::to_string(round));
            counts.add(copy);
        }
    }
    fs::remove_all(folder);
    std::cout << counts.read << " read, " << counts.refused << " refused\n";
    EXPECT_GT(counts.read, 5u);
    EXPECT_GT(counts.refused, 5u);
}

} // namespace
} // namespace lightwell
