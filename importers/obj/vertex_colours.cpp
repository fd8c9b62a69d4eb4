#include "importers/obj/vertex_colours.h"

#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace lightwell {
namespace {

/// Sum over faces of area times colour.
struct ColourSum {
    Spectrum weighted;
    double area = 0;
    std::size_t faces = 0;
};

double face_area(const ObjFile& file, const ObjFace& face)
{
    const auto at = [&](std::uint32_t i) {
        return file.points[static_cast<std::size_t>(file.corners[face.first + i].point)];
    };
    Vec3 twice;
    for (std::uint32_t i = 1; i + 1 < face.count; ++i)
        twice += cross(at(i) - at(0), at(i + 1) - at(0));
    return 0.5 * length(twice);
}

/// Mean over the corners that have a colour, linear Rec.709; nothing when none has.
std::optional<Spectrum> face_colour(const ObjFile& file, const ObjFace& face, double scale)
{
    Spectrum sum;
    int coloured = 0;
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
        const float* rgb = &file.colours[3 * static_cast<std::size_t>(file.corners[i].point)];
        if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2]))
            continue;
        const auto linear = [&](float c) { return srgb_to_linear(std::clamp(scale * double{c}, 0.0, 1.0)); };
        sum += {linear(rgb[0]), linear(rgb[1]), linear(rgb[2])};
        ++coloured;
    }
    return coloured > 0 ? std::optional(sum / coloured) : std::nullopt;
}

std::string hex_name(const Spectrum& linear)
{
    std::string name = "vertex colour #";
    for (int c = 0; c < 3; ++c) {
        const auto value = static_cast<unsigned>(std::lround(255 * linear_to_srgb(linear[c])));
        name += "0123456789abcdef"[value >> 4 & 15];
        name += "0123456789abcdef"[value & 15];
    }
    return name;
}

/// Colours above 1 are counts to 255; a file uses one of both throughout.
double scale_of(const ObjFile& file)
{
    constexpr float one = 1.001F; // 1 with a rounding error
    const bool counts = std::any_of(file.colours.begin(), file.colours.end(), [](float c) { return c > one; });
    return counts ? 1.0 / 255 : 1;
}

Plastic matt(const Spectrum& linear)
{
    const Spectrum engine = from_rec709(linear);
    return {{std::clamp(engine.r, 0.0, 1.0), std::clamp(engine.g, 0.0, 1.0), std::clamp(engine.b, 0.0, 1.0)}, 0, 0};
}

/// Means by set of names (where faces name no material) and by material that nothing describes.
struct Sums {
    std::map<std::uint32_t, ColourSum> nameless;
    std::map<std::string, ColourSum> named;
    std::size_t described_faces = 0;
};

Sums sum_colours(const ObjFile& file, const std::set<std::string>& described)
{
    Sums sums;
    const double scale = scale_of(file);
    for (const ObjFace& face : file.faces) {
        const std::optional<Spectrum> colour = face_colour(file, face, scale);
        if (!colour)
            continue;
        const std::string& material = file.states[face.state].material;
        if (described.count(material) > 0) {
            ++sums.described_faces;
            continue;
        }
        ColourSum& sum = material.empty() ? sums.nameless[face.state] : sums.named[material];
        const double area = face_area(file, face);
        sum.weighted += *colour * area;
        sum.area += area;
        ++sum.faces;
    }
    return sums;
}

} // namespace

void take_vertex_colours(ObjFile& file, Imported& imported)
{
    if (file.colours.empty())
        return;
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    file.colours.resize(3 * file.points.size(), none);
    std::set<std::string> described;
    for (const auto& [name, material] : imported.file_materials)
        described.insert(name);
    const Sums sums = sum_colours(file, described);
    std::size_t faces = 0;
    const auto take = [&](const std::string& name, const ColourSum& sum) {
        if (described.insert(name).second)
            imported.file_materials.emplace_back(name, matt(sum.weighted / sum.area));
        faces += sum.faces;
    };
    for (const auto& [state, sum] : sums.nameless)
        if (sum.area > 0)
            take(file.states[state].material = hex_name(sum.weighted / sum.area), sum);
    for (const auto& [name, sum] : sums.named)
        if (sum.area > 0)
            take(name, sum);
    if (faces > 0)
        imported.report.add(Finding::approximated, file.name,
                            "vertex colours, read as sRGB: faces of one material take their mean as reflectance",
                            faces);
    if (sums.described_faces > 0)
        imported.report.add(Finding::ignored, file.name, "vertex colours of faces whose material is described",
                            sums.described_faces);
}

} // namespace lightwell
