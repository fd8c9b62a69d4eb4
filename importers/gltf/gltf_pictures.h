#pragma once

#include "importers/gltf/gltf_document.h"

#include <map>

namespace lightwell {

/// The pictures of one file, each opened once.
class GltfPictures {
public:
    explicit GltfPictures(const GltfDocument& document) : document_(document) {}
    /// Where a picture's bytes are, without material and use.
    /// @throws InputError when they cannot be had
    FileTexture located(int image) const;
    /// @return null, with a note, when the picture cannot be had or read
    const PictureMeans* means(int image, const std::string& place, Report& report);

private:
    const GltfDocument& document_;
    std::map<int, std::optional<PictureMeans>> known_;
};

} // namespace lightwell
