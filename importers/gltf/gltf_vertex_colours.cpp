#include "importers/gltf/gltf_vertex_colours.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_primitive.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace lightwell {
namespace {

/// Elements read for this before a file counts as a trap: primitives may share one large accessor thousands of times.
constexpr std::size_t most_elements = 50'000'000;
/// More materials than this help nobody; later colours are left out.
constexpr std::size_t most_materials = 1000;
constexpr int white = 0xFFFFFF;

/// 0xrrggbb of sRGB; numbers above 1 count as 1.
int packed(const Spectrum& linear)
{
    int packed = 0;
    for (int channel = 0; channel < 3; ++channel) {
        const double value = linear_to_srgb(std::clamp(linear[channel], 0.0, 1.0));
        packed = packed * 256 + static_cast<int>(std::lround(255 * value));
    }
    return packed;
}

Spectrum unpacked(int colour)
{
    const auto channel = [&](int shift) { return srgb_to_linear((colour >> shift & 255) / 255.0); };
    return {channel(16), channel(8), channel(0)};
}

std::string name_of(const std::string& material, int colour)
{
    char digits[8];
    std::snprintf(digits, sizeof digits, "#%06x", static_cast<unsigned>(colour));
    return material.empty() ? digits : material + ' ' + digits;
}

class Painter {
public:
    Painter(GltfDocument& document, Report& report) : document_(document), report_(report) {}
    void paint(GltfPrimitive& primitive)
    {
        const auto colours = primitive.attributes.find("COLOR_0");
        if (colours == primitive.attributes.end())
            return;
        if (primitive.draco || !within_budget(colours->second)) {
            ++left_out_;
            return;
        }
        try {
            if (const auto mean = mean_vertex_colour(document_, primitive))
                primitive.material = material_for(primitive.material, packed(*mean));
        } catch (const InputError& error) {
            report_.add(Finding::ignored, document_.name, std::string("vertex colours left out: ") + error.what());
        }
    }
    void write_notes()
    {
        if (painted_ > 0)
            report_.add(Finding::approximated, document_.name,
                        "vertex colours: their mean over each primitive multiplies the base colour", painted_);
        if (left_out_ > 0)
            report_.add(Finding::unsupported, document_.name,
                        "vertex colours in packed data, or too many of them: the base colour is used", left_out_);
    }

private:
    bool within_budget(int accessor)
    {
        if (accessor >= 0 && static_cast<std::size_t>(accessor) < document_.accessors.size())
            elements_ += std::min(document_.accessors[static_cast<std::size_t>(accessor)].count, most_elements);
        return elements_ < most_elements;
    }
    int material_for(int base, int colour)
    {
        if (colour == white)
            return base;
        const bool known = base >= 0 && static_cast<std::size_t>(base) < document_.materials.size();
        const auto [entry, fresh] = made_.try_emplace({known ? base : -1, colour}, base);
        if (fresh && made_.size() <= most_materials) {
            GltfMaterial painted = known ? document_.materials[static_cast<std::size_t>(base)] : GltfMaterial{};
            if (known && painted.name.empty())
                painted.name = "material" + std::to_string(base);
            painted.name = name_of(painted.name, colour);
            painted.base_colour *= unpacked(colour);
            entry->second = static_cast<int>(document_.materials.size());
            document_.materials.push_back(std::move(painted));
        }
        ++(made_.size() <= most_materials ? painted_ : left_out_);
        return entry->second;
    }

    GltfDocument& document_;
    Report& report_;
    std::map<std::pair<int, int>, int> made_; ///< by base material and colour
    std::size_t elements_ = 0, painted_ = 0, left_out_ = 0;
};

} // namespace

void take_vertex_colours(GltfDocument& document, Report& report)
{
    Painter painter(document, report);
    for (GltfMesh& mesh : document.meshes)
        for (GltfPrimitive& primitive : mesh.primitives)
            painter.paint(primitive);
    painter.write_notes();
}

} // namespace lightwell
