#include "plugins/insight/peers.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/pictures/rgbe.h"
#include "importers/radiance/radiance.h"
#include "plugins/insight/child_run.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace lightwell {
namespace {

/// What its own driver chooses for low, medium and high quality, with six reflections.
struct Quality {
    const char* name;
    const char* words;
};
constexpr Quality quality_table[RadiancePeers::qualities] = {
    {"low", "-ar 16 -ds .4 -dt .1 -dc .5 -dr 2 -ss 0 -st .5 -aa .25 -ad 512 -as 0 -lr 6 -lw .001 -dp 128 -ab 6"},
    {"medium",
     "-ar 32 -ds .2 -dj .9 -dt .07 -dc .7 -dr 2 -ss 1 -st .1 -aa .15 -ad 800 -as 128 -lr 8 -lw 1e-4 -dp 512 -ab 6"},
    {"high", "-ar 64 -ds .1 -dj .9 -dt .04 -dc .9 -dr 3 -ss 16 -st .01 -aa .1 -ad 1536 -as 768 -lr 12 -lw 5e-6 -dp "
             "2048 -ab 8"}};

std::vector<std::string> with_words(std::vector<std::string> words, const std::string& more)
{
    std::istringstream stream(more);
    for (std::string word; stream >> word;)
        words.push_back(word);
    return words;
}

std::string ending(const ChildResult& result)
{
    if (result.timed_out)
        return fmt::format("ended after {:.0f} s of CPU time", result.cpu_s);
    if (result.status == 0)
        return "";
    const std::string how = result.status < 0 ? fmt::format("ended by signal {}", -result.status)
                                              : fmt::format("exit status {}", result.status);
    return result.last_words.empty() ? how : how + ": " + result.last_words;
}

double number_of(std::string_view word, const std::string& place, bool may_be_negative)
{
    const std::optional<double> number = parse_double(trimmed(word));
    if (!number || !std::isfinite(*number) || (*number < 0 && !may_be_negative))
        throw InputError{place,
                         "\"" + std::string(word) + "\" is no finite number" + (may_be_negative ? "" : " from 0"),
                         "expected program,setting,cpu_s,wall_s,values"};
    return *number;
}

PeerRun run_of(const std::string& line, const std::string& place, std::size_t count)
{
    constexpr std::size_t before_values = 4;
    const std::vector<std::string_view> words = split(line, ",");
    if (words.size() != before_values + count)
        throw InputError{place,
                         fmt::format("has {} values after program, setting and times, expected {}",
                                     words.size() < before_values ? 0 : words.size() - before_values, count),
                         "one for each sensor or pixel of this very grid or view"};
    PeerRun run;
    run.program = trimmed(words[0]);
    run.setting = trimmed(words[1]);
    run.cpu_s = number_of(words[2], place, false);
    run.wall_s = number_of(words[3], place, false);
    for (std::size_t i = before_values; i < words.size(); ++i)
        run.values.push_back(number_of(words[i], place, true));
    return run;
}

} // namespace

std::vector<PeerRun> read_peer_runs(const std::filesystem::path& file, std::size_t count)
{
    std::ifstream stream(file);
    if (!stream)
        throw InputError{file.string(), "cannot be read", "is it there?"};
    std::vector<PeerRun> runs;
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (!trimmed(line).empty() && line[0] != '#')
            runs.push_back(run_of(line, fmt::format("{}:{}", file.string(), number), count));
    }
    if (runs.empty())
        throw InputError{file.string(), "has no run in it", "a line each: program,setting,cpu_s,wall_s,values"};
    return runs;
}

RadiancePeers::RadiancePeers(const Scene& scene, double most_cpu_s) : most_cpu_s_(most_cpu_s)
{
    if (std::getenv("RAYPATH") == nullptr) { // its library stands beside its programs
        const std::filesystem::path library = program_on_path("rtrace").parent_path().parent_path() / "lib";
        setenv("RAYPATH", (".:" + library.string()).c_str(), 0);
    }
    for (const char* program : {"oconv", "rtrace", "rpict"})
        if (program_on_path(program).empty()) {
            absent_ = std::string(program).append(" is not on the PATH");
            return;
        }
    std::string pattern = (std::filesystem::temp_directory_path() / "lightwell-peers-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw InputError{pattern, "a folder for the other programs cannot be made", "is TMPDIR writable?"};
    folder_ = pattern;
    Report ignored;
    WriteOptions options;
    options.flat = true;
    write_radiance(scene, folder_ / "scene.rad", options, ignored);
    octree_ = folder_ / "scene.oct";
    const ChildResult made = run_child({"oconv", (folder_ / "scene.rad").string()}, {}, octree_, most_cpu_s);
    if (made.status != 0 || made.timed_out)
        absent_ = "oconv: " + ending(made);
}

RadiancePeers::~RadiancePeers()
{
    std::error_code ignored;
    if (!folder_.empty())
        std::filesystem::remove_all(folder_, ignored);
}

PeerRun RadiancePeers::illuminance(const SensorGrid& grid, int quality) const
{
    const Quality& q = quality_table[quality];
    PeerRun run;
    run.program = "Radiance rtrace";
    run.setting = q.name;
    const std::filesystem::path points = folder_ / "points.txt", found = folder_ / "found.txt";
    {
        std::ofstream file(points);
        for (const Sensor& s : grid.sensors)
            file << fmt::format("{} {} {} {} {} {}\n", s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y,
                                s.normal.z);
    }
    std::vector<std::string> words = with_words({"rtrace", "-h", "-w", "-I"}, q.words);
    words.push_back(octree_.string());
    const ChildResult result = run_child(words, points, found, most_cpu_s_);
    run.cpu_s = result.cpu_s;
    run.wall_s = result.wall_s;
    run.failure = ending(result);
    std::ifstream file(found);
    for (double r, g, b; file >> r >> g >> b;)
        run.values.push_back(illuminance_of({r, g, b}).value);
    if (run.failure.empty() && run.values.size() != grid.sensors.size())
        run.failure = "it answered for other sensors than were asked for";
    return run;
}

PeerRun RadiancePeers::picture(const View& view, int width, int height, int quality) const
{
    constexpr int finer = 2;
    const Quality& q = quality_table[quality];
    PeerRun run;
    run.program = "Radiance rpict";
    run.setting = q.name;
    std::vector<std::string> words = with_words({"rpict", "-w", "-ps", "1", "-pa", "0"}, to_text(view));
    words = with_words(words, fmt::format("-x {} -y {} {}", finer * width, finer * height, q.words));
    words.push_back(octree_.string());
    const std::filesystem::path file = folder_ / "found.hdr";
    const ChildResult result = run_child(words, {}, file, most_cpu_s_);
    run.cpu_s = result.cpu_s;
    run.wall_s = result.wall_s;
    run.failure = ending(result);
    if (!run.failure.empty())
        return run;
    const Picture picture = read_rgbe(file);
    if (picture.width != finer * width || picture.height != finer * height) {
        run.failure = "its picture has another size than was asked for";
        return run;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int k = 0; k < finer * finer; ++k) {
                const int px = finer * x + k % finer, py = finer * y + k / finer;
                sum += luminance_of({picture.at("R", px, py), picture.at("G", px, py), picture.at("B", px, py)}).value;
            }
            run.values.push_back(sum / (finer * finer));
        }
    return run;
}

} // namespace lightwell
