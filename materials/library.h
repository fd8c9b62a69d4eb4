#pragma once

#include "materials/material.h"

#include <string>
#include <vector>

namespace lightwell {

/// A named material with where its numbers come from.
struct LibraryMaterial {
    std::string name;
    std::string description;
    std::string source;
    Material material;
};

/// All entries, in the order of materials/library/*.toml (compiled into the program).
const std::vector<LibraryMaterial>& material_library();
/// nullptr when there is none of that name.
const LibraryMaterial* find_in_library(const std::string& name);
/// The entry of that name; for messages about unknown ones, the nearest names.
std::vector<std::string> nearest_names(const std::string& name, std::size_t count = 3);

} // namespace lightwell
