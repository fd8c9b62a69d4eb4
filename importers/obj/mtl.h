#pragma once

#include "engine/base/report.h"
#include "engine/base/spectrum.h"
#include "importers/file_texture.h"
#include "materials/material.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// One picture of a material as written: `map_Kd -s 2 2 -mm 0 1 wall paper.png`.
struct MtlTexture {
    std::string statement;     ///< "map_Kd", "bump", ...
    std::string file;          ///< as written, with its blanks
    double base = 0, gain = 1; ///< `-mm`: base + gain * value
    double bend = 1;           ///< `-bm`: factor on what a picture of normals bends
    char channel = 'l';        ///< `-imfchan`: r, g, b, m (matte, opacity), l (luminance) or z
    TexturePlacement placement;
    std::size_t line = 0;
};

/// One `newmtl` as written; what the file does not say is empty.
struct MtlMaterial {
    std::string name;
    std::size_t line = 0;
    std::optional<Spectrum> diffuse, specular, emission, filter; ///< Kd, Ks, Ke, Tf: linear Rec.709
    std::optional<double> exponent;                              ///< Ns
    std::optional<double> index;                                 ///< Ni
    std::optional<double> dissolve;                              ///< d, or 1 - Tr: 1 is opaque
    std::optional<double> roughness;                             ///< Pr
    std::optional<double> metallic;                              ///< Pm
    std::optional<Spectrum> sheen;                               ///< Ps
    std::optional<double> coat, coat_roughness;                  ///< Pc, Pcr
    std::optional<double> anisotropy;                            ///< aniso
    std::optional<int> illum;
    std::vector<MtlTexture> textures;
};

/// @param name  of the file, for places in messages
std::vector<MtlMaterial> read_mtl(std::string_view text, const std::string& name, Report& report);

/// Splits the rest of a texture statement into options and file name; odd options are noted and passed over.
/// @param place  file and line, for the notes
MtlTexture read_texture_statement(std::string_view statement, std::string_view rest, const std::string& place,
                                  Report& report);

/// Means of pictures, each file opened once.
class MtlPictures {
public:
    /// @param folder  of the library, where its pictures are looked for
    explicit MtlPictures(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Multiplies the values of a material with the means of its pictures, as MTL lays them over each other.
    /// @param textures  receives what was found
    void apply(MtlMaterial& mtl, const std::string& place, Report& report, std::vector<FileTexture>& textures);

private:
    void apply_one(const MtlTexture& texture, MtlMaterial& mtl, const std::string& place, Report& report,
                   std::vector<FileTexture>& textures);
    const PictureMeans* means_of(const std::filesystem::path& file, const std::string& place, Report& report);
    std::filesystem::path folder_;
    std::map<std::filesystem::path, std::optional<PictureMeans>> known_;
};

/// A file beside a library or model: as written, without its folders, or with other capitals; nothing when none is
/// there.
std::optional<std::filesystem::path> find_beside(std::string written, const std::filesystem::path& folder);

/// The rule of importers/obj/README.md: emitter, glass, metal, plastic or partly open plastic; always a valid material.
/// @param place  file, line and material, for the notes
Material material_of(const MtlMaterial& mtl, const std::string& place, Report& report);

} // namespace lightwell
