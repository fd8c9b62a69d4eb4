#pragma once

#include "engine/base/report.h"
#include "engine/base/spectrum.h"
#include "materials/material.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// One `newmtl` as written; what the file does not say is empty.
struct MtlMaterial {
    std::string name;
    std::size_t line = 0;
    std::optional<Spectrum> diffuse, specular, emission, filter; ///< Kd, Ks, Ke, Tf: linear Rec.709
    std::optional<double> exponent;                              ///< Ns
    std::optional<double> index;                                 ///< Ni
    std::optional<double> dissolve;                              ///< d, or 1 - Tr: 1 is opaque
    std::optional<double> roughness;                             ///< Pr
    std::optional<double> metallic;                              ///< Pm
    std::optional<int> illum;
};

/// @param name  of the file, for places in messages
std::vector<MtlMaterial> read_mtl(std::string_view text, const std::string& name, Report& report);

/// The rule of importers/obj/README.md: emitter, glass, metal or plastic; always a valid material.
/// @param place  file, line and material, for the notes
Material material_of(const MtlMaterial& mtl, const std::string& place, Report& report);

} // namespace lightwell
