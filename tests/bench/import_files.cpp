// What it takes to read a million quads as OBJ (goal 1.2 s) and 190 MB as GLB (goal 0.8 s), beside Assimp's command
// line without any work after reading. Printed: processor seconds, seconds by the clock, memory.
#include "engine/base/files.h"
#include "importers/importer.h"
#include "tests/bench/measure.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <vector>

namespace lightwell {
namespace {

/// What one run in a process of its own took.
struct Taken {
    double cpu_s = 0, clock_s = 0, peak_bytes = 0;
    bool good = false;
};

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Runs `work` in a child, so that its memory is its own, and takes the fastest of three: the others were disturbed.
Taken best_of_three(const std::function<int()>& work)
{
    Taken best;
    for (int run = 0; run < 3; ++run) {
        const auto start = std::chrono::steady_clock::now();
        const pid_t child = fork();
        if (child == 0)
            _exit(work());
        int status = 0;
        rusage used{};
        wait4(child, &status, 0, &used);
        const double clock_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime);
        if (run == 0 || cpu_s < best.cpu_s)
            best = {cpu_s, clock_s, 1024.0 * static_cast<double>(used.ru_maxrss), status == 0};
    }
    return best;
}

/// A wavy field of n x n quads; the waves are so flat that each quad counts as planar.
std::string field_as_obj(int n)
{
    std::string text = "# up: z\n# unit: m\no Field\ng A-FLOR\n";
    char line[96];
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double z = 0.0005 * std::sin(0.05 * i) * std::cos(0.05 * j);
            text.append(line, static_cast<std::size_t>(
                                  std::snprintf(line, sizeof line, "v %.4f %.4f %.6f\n", 0.1 * i, 0.1 * j, z)));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1, b = a + n + 1;
            text.append(line, static_cast<std::size_t>(
                                  std::snprintf(line, sizeof line, "f %d %d %d %d\n", a, a + 1, b + 1, b)));
        }
    return text;
}

/// Collects accessors, each with a view of its own, and the nodes that show meshes.
struct GlbParts {
    std::string bytes, views, accessors, meshes, nodes, roots;
    int count = 0;

    /// @return the accessor's number as text
    template <class Number>
    std::string add(const std::vector<Number>& numbers, std::size_t width, int component, const char* type)
    {
        const std::string comma = count > 0 ? "," : "", number = std::to_string(count++);
        const std::size_t size = numbers.size() * sizeof(Number);
        views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes.size()) +
                 ",\"byteLength\":" + std::to_string(size) + "}";
        accessors += comma + "{\"bufferView\":" + number + ",\"componentType\":" + std::to_string(component) +
                     ",\"count\":" + std::to_string(numbers.size() / width) + ",\"type\":\"" + type + "\"}";
        bytes.append(reinterpret_cast<const char*>(numbers.data()), size);
        return number;
    }
    std::string file() const;
};

std::string GlbParts::file() const
{
    std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + "]}],\"nodes\":[" +
                       nodes + "],\"meshes\":[" + meshes + "],\"accessors\":[" + accessors + "],\"bufferViews\":[" +
                       views + "],\"buffers\":[{\"byteLength\":" + std::to_string(bytes.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&number), sizeof number);
    };
    return "glTF" + word(2) + word(28 + json.size() + bytes.size()) + word(json.size()) + "JSON" + json +
           word(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

/// One strip of a wavy field with normals and texture coordinates, rows [first, last] of quads with 4 bytes an index.
void add_strip(GlbParts& glb, int strip, int columns, int first, int last)
{
    std::vector<float> positions, normals, texture;
    std::vector<std::uint32_t> triangles;
    for (int j = first; j <= last; ++j)
        for (int i = 0; i <= columns; ++i) {
            const auto u = static_cast<float>(i), v = static_cast<float>(j);
            positions.insert(positions.end(), {0.1F * u, std::sin(0.05F * u), 0.1F * v});
            const float slope = -0.5F * std::cos(0.05F * u), size = std::sqrt(1 + slope * slope);
            normals.insert(normals.end(), {slope / size, 1 / size, 0});
            texture.insert(texture.end(), {u / static_cast<float>(columns), v});
        }
    for (int j = 0; j < last - first; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), b = a + std::uint32_t(columns) + 1;
            triangles.insert(triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    const std::string comma = strip > 0 ? "," : "", number = std::to_string(strip);
    glb.meshes += comma + "{\"primitives\":[{\"attributes\":{\"POSITION\":" + glb.add(positions, 3, 5126, "VEC3");
    glb.meshes += ",\"NORMAL\":" + glb.add(normals, 3, 5126, "VEC3");
    glb.meshes += ",\"TEXCOORD_0\":" + glb.add(texture, 2, 5126, "VEC2");
    glb.meshes += "},\"indices\":" + glb.add(triangles, 1, 5125, "SCALAR") + "}]}";
    glb.nodes += comma + "{\"name\":\"Strip " + number + "\",\"mesh\":" + number + "}";
    glb.roots += comma + number;
}

std::string field_as_glb(int columns, int rows)
{
    constexpr int strips = 8;
    GlbParts glb;
    for (int s = 0; s < strips; ++s)
        add_strip(glb, s, columns, rows * s / strips, rows * (s + 1) / strips);
    return glb.file();
}

void compare(const std::filesystem::path& file, const std::function<Imported()>& import)
{
    const double megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(file));
    const Taken empty = best_of_three([] { return 0; });
    const Taken ours = best_of_three([&] { return import().ledger.made_count() > 0 ? 0 : 1; });
    const std::string command = "assimp info " + file.string() + " --raw > /dev/null 2>&1";
    const Taken theirs = best_of_three([&] { return std::system(command.c_str()) == 0 ? 0 : 1; });
    const auto times = [](const Taken& taken) {
        std::cout << (taken.good ? "" : "FAILED ") << taken.cpu_s << " s (" << taken.clock_s << " s)\t";
    };
    std::cout << file.extension().string() << '\t' << megabytes << " MB\t";
    times(ours);
    std::cout << 1e-6 * (ours.peak_bytes - empty.peak_bytes) << " MB\t";
    times(theirs);
    std::cout << theirs.cpu_s / ours.cpu_s << std::endl;
}

} // namespace
} // namespace lightwell

int main()
{
    using namespace lightwell;
    const TemporaryFolder folder;
    std::cout << "file\tsize\tLightwell: processor (clock)\tmemory\tAssimp, raw\tratio\n";
    const std::filesystem::path obj = folder.write("field.obj", field_as_obj(1000));
    compare(obj, [&] { return import_obj(obj, {}); });
    const std::filesystem::path glb = folder.write("field.glb", field_as_glb(1800, 1860));
    compare(glb, [&] { return import_gltf(glb, {}); });
}
