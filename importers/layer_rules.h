#pragma once

#include "importers/layers.h"

#include <string>

namespace lightwell {

/// A word of a rule that says for which surfaces it is.
struct RuleWord {
    const char* name;
    std::string LayerRule::*pattern;
};
inline constexpr RuleWord rule_words[] = {{"layer", &LayerRule::layer},   {"group", &LayerRule::group},
                                          {"block", &LayerRule::block},   {"material", &LayerRule::material},
                                          {"entity", &LayerRule::entity}, {"colour", &LayerRule::colour}};

/// The file's colour as `#rrggbb` in sRGB, as CAD programs show it; empty when the file has none.
std::string colour_text(const SurfaceKey& key);
/// True when every word that the rule gives fits the key.
bool rule_matches(const LayerRule& rule, const SurfaceKey& key);
/// True when the rule makes luminaires of copies of blocks that draw nothing.
bool places_luminaire(const LayerRule& rule, const SurfaceKey& bare_insert);

} // namespace lightwell
