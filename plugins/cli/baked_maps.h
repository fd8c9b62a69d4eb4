#pragma once

#include "engine/control/surface_charts.h"
#include "engine/simulate/simulate.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lightwell {

/// Which sides of the surfaces are wanted.
enum class BakeSides { front, back, both };

/// Charts and the sensors of all of them: one grid, so that they share what is found.
struct BakeJob {
    std::vector<SurfaceChart> charts;
    BakeSides sides = BakeSides::both;
    double spacing_m = 0;
    GridSettings settings;
    std::filesystem::path folder;
    std::map<std::string, std::string> provenance;
};
/// The fronts of all charts in their order, then the backs.
SensorGrid sensors_of(const BakeJob& job);

/// One NAME.exr a surface and maps.json, which says where each texel lies, with means by surface and by layer.
/// @param result  of sensors_of(job)
void write_baked_maps(const BakeJob& job, const GridResult& result);

/// Mean illuminance by layer, weighted by area, one line each: layer, m2, lx of the sides asked for.
std::string layer_table(const BakeJob& job, const GridResult& result);

} // namespace lightwell
