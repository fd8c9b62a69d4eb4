#include "engine/base/text.h"
#include "importers/radiance/material_text.h"
#include "materials/library.h"
#include "plugins/cli/subcommands.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace lightwell {
namespace {

struct MaterialsOptions {
    std::string pattern = "*";
    bool json = false;
};

constexpr const char* examples = R"(Examples:
  lightwell materials              all, with their reflectance
  lightwell materials 'glass*'     those whose name matches
  lightwell materials --json       for programs, with the source of the numbers
A name stands in a layer map as: use = "NAME".)";

void print_table(const std::vector<const LibraryMaterial*>& chosen, std::ostream& out)
{
    std::size_t width = 4;
    for (const LibraryMaterial* entry : chosen)
        width = std::max(width, entry->name.size());
    const int name_width = static_cast<int>(width) + 2;
    out << std::left << std::setw(name_width) << "name" << std::setw(12) << "type"
        << "reflectance  description\n";
    for (const LibraryMaterial* entry : chosen) {
        const double reflectance = photopic(typical_reflectance(entry->material));
        out << std::left << std::setw(name_width) << entry->name << std::setw(12) << type_name(entry->material)
            << std::right << std::setw(9) << std::lround(reflectance * 100) << " %  " << entry->description << '\n';
    }
}

void print_json(const std::vector<const LibraryMaterial*>& chosen, std::ostream& out)
{
    auto list = nlohmann::ordered_json::array();
    for (const LibraryMaterial* entry : chosen) {
        const Spectrum reflectance = typical_reflectance(entry->material);
        const Spectrum radiance = emitted_radiance(entry->material);
        std::string text;
        scene_text::append_material(text, "void", entry->name, entry->material);
        list.push_back({{"name", entry->name},
                        {"type", type_name(entry->material)},
                        {"description", entry->description},
                        {"source", entry->source},
                        {"reflectance", {reflectance.r, reflectance.g, reflectance.b}},
                        {"luminance_cd_per_m2", luminance_of(radiance).value},
                        {"text", text}});
    }
    out << list.dump(2) << '\n';
}

Status materials(const MaterialsOptions& options, std::ostream& out, std::ostream& err)
{
    std::vector<const LibraryMaterial*> chosen;
    for (const LibraryMaterial& entry : material_library())
        if (matches(options.pattern, entry.name))
            chosen.push_back(&entry);
    if (options.json)
        print_json(chosen, out);
    else if (!chosen.empty())
        print_table(chosen, out);
    if (chosen.empty()) {
        err << "lightwell: no material matches \"" << options.pattern << "\"; near it:";
        for (const std::string& name : nearest_names(options.pattern))
            err << ' ' << name;
        err << '\n';
    }
    return chosen.empty() ? Status::no : Status::done;
}

} // namespace

/// lightwell materials [PATTERN] [--json]: the named materials of the library. Status 1 when none matches.
void add_materials(CLI::App& app, Status& status)
{
    auto options = std::make_shared<MaterialsOptions>();
    CLI::App& command = *app.add_subcommand("materials", "the named materials that a layer map can use");
    command.add_option("pattern", options->pattern, "part of the list: * any run, ? one character");
    command.add_flag("--json", options->json, "for programs");
    command.footer(examples);
    command.callback([options, &status] { status = materials(*options, std::cout, std::cerr); });
}

} // namespace lightwell
