#pragma once

#include "engine/control/surface_charts.h"
#include "engine/simulate/simulate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lightwell::serve {

/// A face with the sensors over it.
struct ChartedFace {
    SurfaceChart chart;
    std::string object;       ///< it belongs to
    std::int64_t number = -1; ///< in its mesh file; -1: not from one
};

/// What is written about faces, and told.
struct FaceResults {
    std::vector<ChartedFace> faces;
    double spacing_m = 0;
    std::string program;

    /// The fronts of all faces in their order, then the backs.
    SensorGrid sensors() const;
    /// Objects with their faces: area, mean of front and back with the largest standard error that it can have, and the
    /// map that the means are taken from.
    /// @param result  of sensors()
    void write(const std::filesystem::path& file, const GridResult& result) const;
};

} // namespace lightwell::serve
