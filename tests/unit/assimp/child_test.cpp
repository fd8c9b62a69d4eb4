#include "engine/base/errors.h"
#include "importers/assimp/run_child.h"
#include "tests/unit/assimp/long_tail.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <random>

namespace lightwell {
namespace {

/// A program of the test's own in the place of the child.
struct StandIn {
    explicit StandIn(const std::string& script) : file("stand-in.sh", "#!/bin/sh\n" + script)
    {
        chmod(file.path.c_str(), 0700);
        setenv("LIGHTWELL_IMPORT_ASSIMP", file.path.c_str(), 1);
    }
    ~StandIn() { unsetenv("LIGHTWELL_IMPORT_ASSIMP"); }
    TemporaryFile file;
};

std::string complaint(const ChildLimits& limits)
{
    try {
        run_import_program("/dev/null", "stl", limits, "a.stl");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

constexpr ChildLimits one_second{1, 3, 100'000'000, 1'000'000};

TEST(ImportProgram, ACrashBecomesAnErrorThatNamesTheFile)
{
    const StandIn crash("kill -SEGV $$");
    EXPECT_NE(complaint(one_second).find("a.stl: the import program broke down while reading it (signal 11)"),
              std::string::npos);
}

TEST(ImportProgram, AStatusOtherThanZeroIsNeverTakenForAnAnswer)
{
    const StandIn failing("echo LWFS0001 >&3; exit 3");
    EXPECT_NE(complaint(one_second).find("(status 3)"), std::string::npos);
}

TEST(ImportProgram, AHangIsEndedAndAnAnswerWithoutEndIsCutOff)
{
    const auto begin = std::chrono::steady_clock::now();
    {
        const StandIn hang("exec sleep 600");
        EXPECT_NE(complaint(one_second).find("takes longer than a file of its size should"), std::string::npos);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
    const StandIn endless("exec cat /dev/zero >&3");
    EXPECT_NE(complaint(one_second).find("it unfolds to more than 1 MB"), std::string::npos);
}

TEST(ImportProgram, ANamedProgramThatIsMissingDoesNotEndTheSearch)
{
    StandIn stand_in("exit 0");
    setenv("LIGHTWELL_IMPORT_ASSIMP", "/no/such/program", 1);
    // The real one is beside the build; a name that does not exist must not stop the search.
    EXPECT_EQ(complaint(one_second).find("was not found"), std::string::npos);
}

TEST(ImportProgram, LimitsGrowWithTheFile)
{
    EXPECT_EQ(child_limits(0).memory_bytes, 200'000'000u);
    EXPECT_EQ(child_limits(100'000'000).memory_bytes, 600'000'000u);
    EXPECT_GT(child_limits(100'000'000).processor_seconds, child_limits(0).processor_seconds);
}

std::string damaged(std::string bytes, std::mt19937& random)
{
    for (std::uint32_t i = 1 + random() % 8; i > 0 && !bytes.empty(); --i)
        bytes[random() % bytes.size()] = static_cast<char>(random());
    if (random() % 4 == 0)
        bytes.resize(random() % (bytes.size() + 1));
    return bytes;
}

/// Every outcome is fine but a crash or hang of this process, an unbalanced ledger, or too much memory.
TEST(ImportProgram, DamagedFilesAreReadOrRefusedWithinTheirMemory)
{
    if (!std::filesystem::exists(shared_cad()))
        GTEST_SKIP() << "the shared CAD files are not here";
    std::mt19937 random(20);
    for (const char* name : {"3ds/cube_with_materials.3ds", "collada/cube_triangulate.dae", "fbx/phong_cube.fbx",
                             "ifc/SimpleWall.ifc", "ply/online3dviewer/cube.ply", "stl/cube_meshlab_ascii.stl"})
        for (int round = 0; round < 4; ++round) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(round));
            const std::string bytes = damaged(whole_file(shared_cad() / name), random);
            const TemporaryFile file("damaged", bytes);
            try {
                const Imported imported = import_assimp(file.path, {});
                validate(imported.scene);
                std::size_t skipped = 0;
                for (const Ledger::Skipped& entry : imported.ledger.skipped_list())
                    skipped += entry.count;
                EXPECT_EQ(imported.ledger.read_count(), imported.ledger.made_count() + skipped);
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos) << error.what();
            }
        }
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    EXPECT_LT(children.ru_maxrss, 210'000); // kB; the files are below 100 kB
}

} // namespace
} // namespace lightwell
