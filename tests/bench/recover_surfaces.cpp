// What it takes to turn triangles back into flat faces and to find crease normals, beside the half edges that both are
// walked over. Printed as JSON: processor seconds of one thread for a million triangles, the fastest of three runs.
// There is no goal; whoever changes engine/geometry sees here what it costs.
#include "importers/surfaces/recover_surfaces.h"
#include "engine/geometry/half_edges.h"
#include "tests/bench/measure.h"

#include <cmath>
#include <cstdio>
#include <functional>

namespace lightwell {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// n x n squares cut in two, bent by `height(x, y)`.
Mesh field(int n, double x0, const std::function<double(int, int)>& height)
{
    Mesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            mesh.points.push_back({x0 + 0.1 * x, 0.1 * y, height(x, y)});
    const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (const auto& [a, b, c] : {std::array{at(x, y), at(x + 1, y), at(x + 1, y + 1)},
                                          std::array{at(x, y), at(x + 1, y + 1), at(x, y + 1)}})
                mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
    return mesh;
}

double fastest_of_three(const std::function<void()>& prepare, const std::function<void()>& work)
{
    double fastest = 1e9;
    for (int run = 0; run < 3; ++run) {
        prepare();
        const double before = cpu_seconds();
        work();
        fastest = std::fmin(fastest, cpu_seconds() - before);
    }
    return fastest;
}

double half_edge_seconds(const Mesh& mesh)
{
    Triangles triangles;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    return fastest_of_three([] {}, [&] { const HalfEdges edges(mesh.points.size(), triangles); });
}

double recover_seconds(const std::vector<Mesh>& meshes, const ImportOptions& options, std::size_t& surfaces)
{
    Imported imported;
    const auto prepare = [&] {
        imported = {};
        KeyTable keys(imported);
        SurfaceKey key;
        key.layer = "A";
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            key.group = std::to_string(i);
            imported.scene.root.add_mesh(std::make_shared<const Mesh>(meshes[i]), keys.modifier_for(key), "m");
        }
    };
    const double seconds = fastest_of_three(prepare, [&] { recover_surfaces(imported, options); });
    surfaces = imported.scene.root.surfaces.size();
    return seconds;
}

void run()
{
    constexpr int walls = 500, wall_side = 32, terrain_side = 708; // a million triangles each
    const auto flat = [](int, int) { return 0.0; };
    const auto hills = [](int x, int y) { return std::sin(0.05 * x) * std::cos(0.05 * y); };
    std::vector<Mesh> flat_walls;
    for (int i = 0; i < walls; ++i)
        flat_walls.push_back(field(wall_side, 10.0 * i, flat));
    const std::vector<Mesh> terrain{field(terrain_side, 0, hills)};
    ImportOptions round;
    round.crease_angle_deg = 30;
    std::size_t faces = 0, meshes = 0;
    const double edges = half_edge_seconds(terrain.front());
    const double recovered = recover_seconds(flat_walls, {}, faces);
    const double creased = recover_seconds(terrain, round, meshes);
    std::printf("{\n \"half_edges_s\": %.3f,\n \"flat_walls_s\": %.3f,\n \"flat_walls_become\": %zu,\n"
                " \"crease_normals_s\": %.3f,\n \"unit\": \"processor seconds for a million triangles\"\n}\n",
                edges, recovered, faces, creased);
}

} // namespace
} // namespace lightwell

int main()
{
    lightwell::run();
    return 0;
}
