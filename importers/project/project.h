#pragma once

#include "engine/scene/sensor.h"
#include "engine/scene/view.h"
#include "engine/sky/sky.h"
#include "importers/importer.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lightwell {

struct ProjectInputs {
    std::vector<std::filesystem::path> files; ///< at least one; relative paths count from the project's folder
    std::filesystem::path map;                ///< empty: none, as apply_layer_map() treats an empty map
    std::string unit;                         ///< empty: what the file says
    std::string up;                           ///< "", "y" or "z"
    std::vector<RaisedLayer> raised;          ///< layers of plans that become walls
};

struct ProjectView {
    View view;
    int width = 960, height = 540; ///< pixels
};

/// How much work is wanted; at most one of accuracy, samples, time and quality.
struct ProjectWish {
    std::optional<double> accuracy; ///< (0, 1], standard error over value
    std::optional<int> samples;     ///< per pixel or sensor
    std::optional<double> time_s;   ///< for all results together
    std::string quality;            ///< "draft", "normal", "fine"; empty: not given
    std::optional<long long> seed;
};

struct ProjectOutput {
    std::filesystem::path folder = "out"; ///< relative paths count from the project's folder
    bool png = true;
    bool hdr = false; ///< Radiance picture beside the OpenEXR one
};

/// One study: project.toml, checked.
struct Project {
    std::filesystem::path file;
    ProjectInputs inputs;
    std::optional<PlaceAndTime> place; ///< always there when there is a sky
    double north_deg = 0;              ///< the model's north, counter-clockwise from +y
    std::optional<SkyOptions> sky;     ///< nothing: electric light only
    std::vector<ProjectView> views;
    std::vector<GridRequest> grids;
    ProjectWish wish;
    ProjectOutput output;
};

/// Words: `[inputs] files, map, unit, up, extrude`; `[place] latitude, longitude (east positive), utc_offset, north,
/// time`;
/// `[sky] type = "clear" | "intermediate" | "overcast" | "uniform" | "none", sun, turbidity, ground_reflectance`;
/// `[[view]] name, text or position with direction or target, up, kind, horizontal, vertical, shift, lift, fore, aft,
/// lens, focus; size`;
/// `[[grid]] on, spacing, name`; `[wish] accuracy, samples, time or quality; seed`; `[output] folder, png, hdr`.
/// @throws InputError with file and line: TOML errors, unknown words, values out of range, what is missing
Project read_project(const std::filesystem::path& file);

} // namespace lightwell
