#pragma once

#include "engine/base/transform.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell::scene_text {

/// One copy that an xform command asks for.
struct XformCopy {
    Affine map;
    double scale = 1;                ///< its uniform factor, without sign
    std::vector<std::string> words;  ///< its transform: `-i 0 -rz 40`
    std::optional<std::string> name; ///< prefix of the surfaces' names
};
/// The words of an xform command.
struct XformWords {
    std::vector<XformCopy> copies;  ///< more than one for arrays
    std::vector<std::string> shown; ///< options in the order given, for the header of a single copy
    std::optional<std::string> modifier;
    bool expand = true, inverted = false, array = false;
    std::vector<std::string> files;
};
/// @param words  the command's name first
/// @throws BadWords that names the word
XformWords read_xform_words(const std::vector<std::string>& words, const std::string& place);

} // namespace lightwell::scene_text
