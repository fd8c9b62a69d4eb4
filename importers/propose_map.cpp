#include "engine/base/toml.h"
#include "importers/layers.h"
#include "materials/library.h"

#include <fmt/format.h>
#include <map>
#include <set>

namespace lightwell {
namespace {

/// A text as a pattern that matches itself only (but for the case of letters).
std::string exactly(const std::string& text)
{
    std::string pattern;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool range = text[i] == '.' && i + 1 < text.size() && text[i + 1] == '.';
        if (text[i] == '*' || text[i] == '?' || text[i] == '[' || range)
            pattern += {'[', text[i], ']'};
        else
            pattern += text[i];
    }
    return pattern;
}

/// What the map says for one key: a name of the library or `file:NAME`, and why.
struct Use {
    std::string material, reason;
    bool operator==(const Use& other) const { return material == other.material; }
};

class Proposer {
public:
    explicit Proposer(const Imported& imported)
    {
        for (const auto& [name, material] : imported.file_materials)
            of_file_.try_emplace(name, &material);
    }
    Use use_for(const SurfaceKey& key) const
    {
        const auto own = of_file_.find(key.material);
        if (own != of_file_.end() && is_emitter(*own->second))
            return {"file:" + key.material, "emitter described by the file"};
        if (const std::string name = propose_material(key); !name.empty())
            return {name, find_in_library(name)->description};
        if (own != of_file_.end())
            return {"file:" + key.material, "described by the file"};
        return {"grey_50", "no proposal: please choose"};
    }

private:
    std::map<std::string, const Material*> of_file_;
};

std::string rule_text(const std::string& layer, const std::string& material, const Use& use, const std::string& amount)
{
    std::string text =
        "[[rule]]" + (amount.empty() ? "" : "  # " + amount) + "\nlayer = " + toml_quoted(exactly(layer));
    if (!material.empty())
        text += "\nmaterial = " + toml_quoted(exactly(material));
    return text + "\nuse = " + toml_quoted(use.material) + "  # " + use.reason + "\n\n";
}

std::string plural(std::size_t count)
{
    return count == 1 ? "1 surface" : fmt::format("{} surfaces", count);
}

} // namespace

std::string propose_layer_map(const Imported& imported)
{
    const Proposer proposer{imported};
    std::map<std::string, std::map<std::string, Use>> uses; // by layer, by material of the file
    for (std::size_t i = 0; i < imported.keys.size(); ++i) {
        const SurfaceKey& key = imported.keys[i];
        if (!std::holds_alternative<Inherited>(imported.scene.modifiers[i].what))
            uses[key.layer].try_emplace(key.material, proposer.use_for(key));
    }
    std::string text =
        "# Which material each layer gets. The last rule that matches wins; patterns know * ? [a-z] and A..B;\n"
        "# use = \"void\" leaves the surfaces out. `lightwell materials` lists the library.\n"
        "# Materials are proposed by name only: please check them.\n\n";
    for (const LayerSummary& layer : summarize_layers(imported)) {
        const auto entry = uses.find(layer.name);
        if (entry == uses.end())
            continue;
        const std::map<std::string, Use>& by_material = entry->second;
        const std::string amount = fmt::format("{}, {:.6g} m2", plural(layer.surfaces), layer.area_m2);
        // One rule for the layer; materials of the file that end elsewhere follow as exceptions.
        const Use& common = by_material.begin()->second;
        text += rule_text(layer.name, {}, common, amount);
        for (const auto& [material, use] : by_material)
            if (!(use == common))
                text += rule_text(layer.name, material, use, {});
    }
    return text;
}

} // namespace lightwell
