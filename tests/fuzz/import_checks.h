#pragma once

#include "importers/layer_report.h"
#include "importers/layers.h"

#include <cstdlib>

namespace lightwell {

/// What must hold for every file that an importer accepts: reports can be made, each surface gets a material, the
/// scene is valid.
inline void check_import(Imported imported)
{
    // A few bytes can ask for millions of copies; the importers' own tests hold them to their bounds.
    constexpr std::size_t most_surfaces = 20000;
    if (expanded_count(imported.scene) > most_surfaces)
        return;
    const std::size_t read = imported.ledger.read_count();
    layers_json(imported, "fuzz");
    propose_layer_map(imported);
    apply_layer_map(imported, {});
    validate(imported.scene);
    if (imported.ledger.read_count() != read)
        std::abort();
}

} // namespace lightwell
