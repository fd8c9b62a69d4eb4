#pragma once

#include "engine/base/report.h"
#include "engine/base/spectrum.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lightwell {

/// Where a material's picture lies on a surface: coordinates (u, v) of the mesh become, in the picture,
/// (m[0] u + m[1] v + m[2], m[3] u + m[4] v + m[5]).
/// Frame  both: u to the right, v up, (0, 0) at the lower left corner of the picture and (1, 1) at the upper right one
struct TexturePlacement {
    std::array<double, 6> to_picture{1, 0, 0, 0, 1, 0};
    bool repeats = true; ///< beyond the picture it begins anew; else its rim goes on for ever
};

/// A picture that a material of the file names. Materials carry the mean of it; the picture itself is kept at hand here
/// for whoever lays it on the surface.
struct FileTexture {
    enum class Use { colour, emission, opacity, roughness, metal, highlight, transmission, normal, height, other };
    std::string material; ///< a name of Imported::file_materials
    Use use = Use::colour;
    std::filesystem::path file;               ///< that holds the picture; empty when `bytes` has it
    std::size_t offset = 0, length = 0;       ///< the slice of that file; length 0: the whole file
    std::shared_ptr<const std::string> bytes; ///< decoded from text inside the file; null otherwise
    TexturePlacement placement = {};
    std::string what;                     ///< for notes: "baseColorTexture", "`map_Kd` wall.png"
    Spectrum mean{1, 1, 1};               ///< of colours, linear Rec.709
    std::array<double, 2> strength{1, 1}; ///< of a picture of normals: factors on what it has to the right and up
    bool as_stored = true;                ///< nothing in the file changes its values
    bool laid = false;                    ///< surfaces of the material show it; else its mean stands for it
};

/// Means over the pixels of a picture.
struct PictureMeans {
    Spectrum colour; ///< linear Rec.709 of the sRGB-coded pixels, each weighed with its opacity
    Spectrum plain;  ///< of the stored numbers, [0, 1]: for pictures that hold data instead of colours
    double opacity = 1;
    std::array<double, 256> opacity_shares{}; ///< share of the pixels with each stored opacity
    /// Share of the pixels that stay when those whose opacity times `factor` is below `cutoff` are cut away.
    double share_kept(double cutoff, double factor) const noexcept;
};

/// @param place  of the picture, for messages
/// @throws InputError when it is neither PNG nor JPEG, or damaged
PictureMeans picture_means(std::string_view image_bytes, const std::string& place);
/// The bytes of the picture, from where a texture says that they are.
/// @throws InputError when they are not there any more
std::string bytes_of(const FileTexture& texture, const std::string& place);
/// The same from where a texture says that its picture is.
PictureMeans picture_means(const FileTexture& texture, const std::string& place);

} // namespace lightwell
