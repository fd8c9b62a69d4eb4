#pragma once

#include "engine/base/vector.h"

#include <string>
#include <vector>

namespace lightwell {

struct Scene;

/// A point that measures illuminance, and the direction it faces.
struct Sensor {
    Point position;
    Direction normal{0, 0, 1};
};

/// Sensors that belong together. On a regular grid, rows x columns cells, row 0 at the low y end; cells without a
/// sensor (outside the floor) have index -1.
struct SensorGrid {
    std::string name = "grid";
    std::vector<Sensor> sensors;
    int rows = 0, columns = 0; ///< 0 when the sensors are a plain list
    std::vector<int> cells;    ///< rows * columns indices into sensors, or -1
    double spacing_m = 0;
};

/// Where sensors are wanted, before the scene is known: `layer:NAME@HEIGHT/SPACING`, `plane:z,x0,y0,x1,y1/SPACING`
/// or `file:POINTS` (six numbers a line: x y z nx ny nz).
struct GridRequest {
    enum class Kind { layer, plane, file } kind = Kind::layer;
    std::string layer;    ///< glob
    double height_m = 0;  ///< above the layer's upward-facing surfaces
    double plane[5] = {}; ///< z, x0, y0, x1, y1
    std::string file;
    double spacing_m = 0.5;
    std::string name;
};
/// @throws InputError that shows the three forms
GridRequest parse_grid(const std::string& text);
/// Sensors at the centres of square cells; on a layer, those whose centre lies over its upward surfaces.
/// @throws InputError when no sensor results (grid off the building, unknown layer)
SensorGrid make_grid(const GridRequest& request, const Scene& scene);

} // namespace lightwell
