#pragma once

/// \file The one public header: CAD files in, scene, light, pictures and maps out.
///
///     Imported imported = import_file("building.dxf");
///     apply_layer_map(imported, read_layer_map("map.toml"));
///     Simulation simulation(std::move(imported.scene));
///     write_exr(simulation.render(view, {}).picture, "out.exr");

#include "engine/pictures/exr.h"
#include "engine/pictures/false_colour.h"
#include "engine/pictures/png.h"
#include "engine/pictures/rgbe.h"
#include "engine/scene/add_sky.h"
#include "engine/scene/scene.h"
#include "engine/simulate/simulate.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"
#include "importers/radiance/radiance.h"
#include "importers/units.h"
#include "materials/library.h"
