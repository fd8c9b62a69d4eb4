// A forest of 2e8 needles in four levels of instances: memory, and rays per second.
// Usage: bench_forest [FOREST.rad]   (without a file it plants its own: 150 needles a spray, 60 sprays a branch,
// 90 branches a tree, 30 trees a stand, 9 stands, a cabin, sun and sky)
// Prints bytes of the scene and of its ray queries, resident memory above the start, and for pictures of rising size
// the rays to the eye and to the sun per second of one processor (goal: a picture's time does not grow with needles).

#include "engine/accel/ray_queries.h"
#include "engine/base/random.h"
#include "importers/radiance/radiance.h"
#include "tests/bench/measure.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

using namespace lightwell;

constexpr double bytes_per_megabyte = 1e6;
constexpr const char* view_words = "-vtv -vp -42 -55 7 -vd .6 .78 -.02 -vu 0 0 1 -vh 55 -vv 42";
constexpr Vec3 to_sun{-.5, -.6, .62};

[[gnu::format(printf, 2, 3)]] void add(std::string& text, const char* format, ...)
{
    char line[400];
    va_list arguments;
    va_start(arguments, format);
    const int length = std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text.append(line, static_cast<std::size_t>(length));
}

/// Numbers for the shape of the forest, the same each time.
class Dice {
public:
    double between(double low, double high) { return low + (high - low) * random_.next(); }

private:
    RandomStream random_{5};
};

std::string spray(Dice& dice)
{
    std::string text = "void plastic needle_m\n0\n0\n5 .08 .2 .06 .02 .1\n";
    for (int i = 0; i < 150; ++i) {
        const double x = dice.between(0, .18), angle = dice.between(0, 2 * pi), tip = x + dice.between(.02, .05);
        add(text, "needle_m cone n%d\n0\n0\n8 %g 0 0 %g %g %g .0008 .0002\n", i, x, tip, .06 * std::cos(angle),
            .06 * std::sin(angle));
    }
    return text;
}

std::string branch(Dice& dice)
{
    std::string text = "void plastic bark_m\n0\n0\n5 .2 .13 .08 0 0\n"
                       "bark_m cone twig\n0\n0\n8 0 0 0 1.6 0 0 .015 .003\n";
    for (int i = 0; i < 60; ++i) {
        const double x = dice.between(.2, 1.6), width = .3 * (1.7 - x), size = dice.between(.8, 1.3);
        const double roll = dice.between(0, 360), lean = dice.between(-55, 55);
        const double y = dice.between(-width, width), z = dice.between(-.05, .05);
        add(text, "void instance sp%d\n11 spray.rad -s %g -rx %g -rz %g -t %g %g %g\n0\n0\n", i, size, roll, lean, x, y,
            z);
    }
    return text;
}

std::string tree(Dice& dice)
{
    std::string text = "void plastic trunk_m\n0\n0\n5 .2 .13 .08 0 0\n"
                       "trunk_m cone trunk\n0\n0\n8 0 0 0 0 0 9 .18 .02\n";
    for (int i = 0; i < 90; ++i) {
        const double z = 1.2 + 7.6 * i / 90;
        add(text, "void instance br%d\n11 branch.rad -s %g -ry %g -rz %g -t 0 0 %g\n0\n0\n", i, 1.25 - .95 * z / 9,
            dice.between(5, 25), 137.5 * i, z);
    }
    return text;
}

std::string stand(Dice& dice)
{
    std::string text;
    for (int i = 0; i < 30; ++i) {
        const double size = dice.between(.7, 1.4), turn = dice.between(0, 360);
        const double x = dice.between(-12, 12), y = dice.between(-12, 12);
        add(text, "void instance tr%d\n9 tree.rad -s %g -rz %g -t %g %g 0\n0\n0\n", i, size, turn, x, y);
    }
    return text;
}

std::string forest(Dice& dice)
{
    std::string text = "void plastic earth_m\n0\n0\n5 .25 .2 .12 0 0\nvoid plastic log_m\n0\n0\n5 .35 .22 .12 0 0\n"
                       "earth_m polygon ground\n0\n0\n12 -80 -80 0 80 -80 0 80 80 0 -80 80 0\n"
                       "log_m polygon wall\n0\n0\n12 -22 -38 0 -15 -38 0 -15 -38 3 -22 -38 3\n"
                       "log_m polygon roof\n0\n0\n12 -22.4 -38.4 2.9 -14.6 -38.4 2.9 -14.6 -35.5 5 -22.4 -35.5 5\n"
                       "void light solar\n0\n0\n3 4.5e6 4.5e6 4.5e6\nsolar source sun\n0\n0\n4 -.5 -.6 .62 .533\n"
                       "void glow sky_glow\n0\n0\n4 9 10 13 0\nsky_glow source sky\n0\n0\n4 0 0 1 180\n";
    for (int i = 0; i < 9; ++i)
        add(text, "void instance sd%d\n7 stand.rad -rz %g -t %d %d 0\n0\n0\n", i, dice.between(0, 360),
            26 * (i % 3 - 1), 26 * (i / 3 - 1) + 5);
    return text;
}

std::filesystem::path plant(const TemporaryFolder& folder)
{
    Dice dice;
    folder.write("spray.rad", spray(dice));
    folder.write("branch.rad", branch(dice));
    folder.write("tree.rad", tree(dice));
    folder.write("stand.rad", stand(dice));
    return folder.write("forest.rad", forest(dice));
}

template <class T>
double bytes_of(const std::vector<T>& values)
{
    return static_cast<double>(values.capacity() * sizeof(T));
}

double bytes_of(const Part& part)
{
    double sum = bytes_of(part.surfaces) + bytes_of(part.points) + bytes_of(part.polygons) + bytes_of(part.spheres) +
                 bytes_of(part.cones) + bytes_of(part.rings) + bytes_of(part.sources) + bytes_of(part.instances);
    for (const Surface& surface : part.surfaces)
        sum += surface.name.capacity() > std::string().capacity() ? static_cast<double>(surface.name.capacity()) : 0;
    for (const Instance& instance : part.instances)
        sum += bytes_of(instance.bindings);
    return sum;
}

/// Without meshes, which a forest of cones has not.
double bytes_of(const Scene& scene)
{
    double sum = bytes_of(scene.root) + bytes_of(scene.modifiers) + bytes_of(scene.prototypes);
    for (const Part& part : scene.prototypes)
        sum += bytes_of(part);
    return sum;
}

/// One ray through each picture element, and from what it meets one to the sun.
void trace(const RayQueries& queries, const Camera& camera, int width, int height)
{
    const Direction sun = normalized(to_sun);
    int eye_rays = 0, sun_rays = 0, lit = 0;
    const double start = cpu_seconds();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            ViewRay from;
            Hit hit;
            camera.ray((x + 0.5) / width, (y + 0.5) / height, from);
            ++eye_rays;
            if (!queries.closest({from.origin, from.direction, infinity}, hit))
                continue;
            ++sun_rays;
            lit += queries.transmittance({hit.leave(sun), sun, infinity}).is_black() ? 0 : 1;
        }
    const double seconds = cpu_seconds() - start;
    std::printf("%4d x %-4d %8d eye rays, %8d sun rays (%.1f %% lit): %.2f s, %.0f rays/s\n", width, height, eye_rays,
                sun_rays, 100.0 * lit / std::max(1, sun_rays), seconds, (eye_rays + sun_rays) / seconds);
}

void measure(const std::filesystem::path& file)
{
    const double empty = resident_bytes();
    Report report;
    const double start = cpu_seconds();
    const Scene scene = read_radiance(file, report);
    validate(scene);
    const double read = cpu_seconds();
    const RayQueries queries(scene);
    std::printf("surfaces, instances expanded: %zu\n", expanded_count(scene));
    std::printf("read and checked: %.2f s, ray queries: %.2f s\n", read - start, cpu_seconds() - read);
    const double scene_bytes = bytes_of(scene), query_bytes = static_cast<double>(queries.bytes());
    std::printf("scene %.2f MB + ray queries %.2f MB = %.2f MB; resident above the start: %.2f MB\n",
                scene_bytes / bytes_per_megabyte, query_bytes / bytes_per_megabyte,
                (scene_bytes + query_bytes) / bytes_per_megabyte, (resident_bytes() - empty) / bytes_per_megabyte);
    const Camera camera(parse_view(view_words, "bench_forest"));
    for (const int width : {80, 160, 320})
        trace(queries, camera, width, width * 3 / 4);
}

} // namespace

int main(int argc, char** argv)
{
    try {
        const TemporaryFolder folder;
        measure(argc > 1 ? std::filesystem::path(argv[1]) : plant(folder));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
