#pragma once

#include "importers/importer.h"

#include <filesystem>
#include <map>
#include <string>

namespace lightwell::test {

/// A file that exists as long as the object, in the folder for temporary files.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& content);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// "8 WALLS 10 0 20 0" with one tag for each pair of words: code and value on lines of their own. A value may be
/// written in quotes when it holds blanks.
std::string tags(const std::string& pairs);
/// A drawing in metres from the tags of its blocks and entities.
std::string drawing(const std::string& blocks, const std::string& entities, const std::string& tables = "");
Imported imported_text(const std::string& content, const ImportOptions& options = {});
/// The message of the InputError that the import ends with; empty when it does not.
std::string import_error(const std::string& content);

struct LayerArea {
    std::size_t surfaces = 0;
    double area_m2 = 0;
};
/// Surfaces and area for each layer, instances expanded, inherited layers resolved.
std::map<std::string, LayerArea> layer_areas(const Imported& imported);
/// Bounds of all surfaces, instances expanded, rings and cylinders exact under similarity transforms.
Box exact_bounds(const Imported& imported);

} // namespace lightwell::test
