#pragma once

#include "engine/simulate/simulate.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell::serve {

/// One line of the host, checked: known words, right types, sizes within reason.
struct Request {
    enum class Task { load, edit, plan, render, illuminance, surfaces, cancel, quit };

    std::int64_t id = 0;
    Task task = Task::quit;
    std::string scene, map;              ///< load
    std::string view, grid;              ///< plan, render, illuminance
    std::optional<std::string> layer;    ///< render: channels as Blender names them
    std::string file;                    ///< of the result
    std::string ambient_file;            ///< empty: none
    std::vector<std::string> parts{"*"}; ///< surfaces: globs of objects
    int width = 960, height = 540;
    Tile region;         ///< width 0: all
    double accuracy = 0; ///< 0: not given
    double seconds = 0;  ///< 0: not given
    int samples = 0;     ///< 0: not given
    double spacing_m = 0.25;
    std::uint64_t seed = 1;
    int threads = 0;
    bool progressive = false;
    std::int64_t target = 0; ///< cancel
};

/// What is wrong with a line, and whose it was as far as that can be told.
struct BadRequest {
    std::optional<std::int64_t> id;
    std::string text, way_out;
};

/// @throws BadRequest  no JSON, no object, unknown or missing words, wrong types, numbers out of range
Request parse_request(std::string_view line);

const char* name_of(Request::Task task) noexcept;

} // namespace lightwell::serve
