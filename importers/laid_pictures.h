#pragma once

#include "importers/importer.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace lightwell {

class PictureTable; // materials/patterns/picture_table.h

/// Decides which pictures of one material are laid on its surfaces and which count with their mean alone, and notes it.
/// @param first          of the material's pictures in `textures`; they reach to the end
/// @param colours_panes  whether a picture of colours is what a pane of the material lets through
/// @param place          of the material, for the notes
void settle_pictures(std::vector<FileTexture>& textures, std::size_t first, const Material& material,
                     bool colours_panes, const std::string& place, Report& report);

/// Names of the file's materials of which a picture is laid on surfaces: their corners need coordinates.
std::set<std::string> pictured_materials(const std::vector<FileTexture>& textures);

/// Modifiers of surfaces whose corners have coordinates on a picture.
std::set<ModifierId> modifiers_with_coordinates(const Scene& scene);

/// Makes patterns and textures of the pictures that the materials of a file name.
class LaidPictures {
public:
    explicit LaidPictures(Imported& imported) : imported_(imported) {}
    /// What lies on a material of the file: the bent normal first, then the colour. Notes what cannot be read.
    std::vector<Varying> on(const std::string& file_material);

private:
    std::shared_ptr<const PictureTable> table_of(const FileTexture& texture, const std::string& bytes,
                                                 const std::string& identity);
    Varying laid(const FileTexture& texture);

    Imported& imported_;
    std::map<std::string, std::shared_ptr<const PictureTable>> known_;
    std::size_t pixels_ = 0;
};

} // namespace lightwell
