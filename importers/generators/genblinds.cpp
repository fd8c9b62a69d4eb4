#include "importers/generators/scene_text_out.h"

#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

constexpr const char* usage = "Usage: genblinds material name depth width height nslats angle [-r|+r rcurv]\n";
/// Slats and the pieces of one: beyond this it is a slip.
constexpr int most_slats = 100'000;
constexpr double most_turn_rad = 10 * radians_per_degree; ///< from one piece of a curved slat to the next

/// Across a slat from its lower edge at the origin: x along the depth, z up.
std::vector<Vec3> profile_of(double depth, double angle_rad, double curvature_m)
{
    std::vector<Vec3> across;
    const double radius = std::fabs(curvature_m);
    const double half_turn = radius > 0 ? std::asin(depth / 2 / radius) : 0;
    const int pieces = radius > 0 ? std::max(1, static_cast<int>(std::ceil(2 * half_turn / most_turn_rad))) : 1;
    for (int i = 0; i <= pieces; ++i) {
        double along = depth * i / pieces, up = 0;
        if (radius > 0) {
            const double turn = half_turn * (2.0 * i / pieces - 1);
            along = depth / 2 + radius * std::sin(turn);
            up = (curvature_m > 0 ? 1 : -1) * radius * (std::cos(turn) - std::cos(half_turn));
        }
        across.push_back({along * std::cos(angle_rad) - up * std::sin(angle_rad), 0,
                          along * std::sin(angle_rad) + up * std::cos(angle_rad)});
    }
    return across;
}

} // namespace

GeneratorAnswer genblinds(const std::vector<std::string>& words, const GeneratorInput&)
{
    return answered(words, usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        const std::string material = reader.word("material"), name = reader.word("name");
        const double depth = reader.number("depth"), width = reader.number("width"), height = reader.number("height");
        const int slats = reader.count("number of slats", 1, most_slats);
        const double angle = reader.number("angle") * radians_per_degree;
        double curvature = 0;
        if (reader.more()) {
            const std::string option = reader.word("option");
            if (option != "-r" && option != "+r")
                throw BadWords("Use error - unknown option: " + option);
            curvature = reader.number("radius") * (option == "+r" ? 1 : -1);
        }
        if (!(depth > 0 && width > 0 && height > 0))
            throw BadWords("Use error - depth, width and height must be positive");
        if (curvature != 0 && !(2 * std::fabs(curvature) >= depth))
            throw BadWords("Use error - the radius of a curved slat is at least half its depth");
        answer.text = comment_of(words);
        const std::vector<Vec3> across = profile_of(depth, angle, curvature);
        for (int slat = 0; slat < slats; ++slat) {
            const Vec3 base{0, 0, height / slats * (slat + 0.5)};
            for (std::size_t i = 1; i < across.size(); ++i) {
                const Point from = base + across[i - 1], to = base + across[i];
                const Vec3 along{0, width, 0};
                append_polygon(answer.text, material, fmt::format("{}.{}.{}", name, slat + 1, i),
                               {from, to, to + along, from + along});
            }
        }
    });
}

} // namespace lightwell
