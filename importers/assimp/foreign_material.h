#pragma once

#include "engine/base/report.h"
#include "importers/assimp/foreign_scene.h"
#include "materials/material.h"

namespace lightwell {

/// Diffuse colour of a material as the file has it, each channel in [0, 1], linear Rec.709.
Spectrum colour_of(const ForeignMaterial& from);
/// The rule of importers/assimp/README.md: emitter, thin glass or matt; always a valid material.
Material material_of(const ForeignMaterial& from, const std::string& place, Report& report);

} // namespace lightwell
