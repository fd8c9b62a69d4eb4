#pragma once

#include "importers/importer.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace lightwell {

/// A file with given bytes, removed afterwards.
struct TemporaryFile {
    TemporaryFile(const std::string& name, const std::string& bytes)
        : path(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-" + name))
    {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::filesystem::path path;
};

inline Imported import_text(const std::string& name, const std::string& text, const ImportOptions& options = {})
{
    return import_assimp(TemporaryFile(name, text).path, options);
}

inline std::filesystem::path shared_cad()
{
    const char* shared = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(shared ? shared : LIGHTWELL_ROOT "/../shared") / "fixtures/cad";
}

inline std::string whole_file(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline double total_area_m2(const Imported& imported)
{
    double sum = 0;
    for (const Surface& surface : imported.scene.root.surfaces)
        sum += surface_area_m2(imported.scene.root, surface);
    return sum;
}

} // namespace lightwell
