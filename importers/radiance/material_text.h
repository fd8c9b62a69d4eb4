#pragma once

#include "engine/scene/scene.h"
#include "importers/radiance/words.h"
#include "materials/patterns/pattern_reader.h"

#include <functional>
#include <optional>

namespace lightwell::scene_text {

/// What a type word of the scene language stands for.
enum class TypeClass { surface, material, pattern, texture, mixture, alias, unknown };
TypeClass classify(std::string_view type) noexcept;

/// The material that the arguments describe; numbers are checked by validate_material(). Not for those with functions.
/// @throws InputError for a wrong number of arguments, showing what they are
Material material_of(const Primitive& primitive, const std::string& place);
/// A material whose functions and files have been read (materials/patterns/pattern_reader.h).
/// @throws InputError for a wrong number of arguments, and files of scattering that cannot be read
Material functional_material_of(const Primitive& primitive, const PatternReader::MaterialWords& words,
                                const std::string& place, Report& report);
/// The sky's brightness when the pattern is `skybr skybright.cal`, else nothing.
/// @throws InputError for arguments that are no sky
std::optional<SkyBrightness> sky_brightness_of(const Primitive& primitive, const std::string& place);

/// `TYPE NAME` and its arguments, as four lines.
/// @param modifier, name  words, already encoded
void append_material(std::string& text, const std::string& modifier, const std::string& name, const Material& material);
/// Before a sky's brightness function that follows the CIE formula down to the horizon; other programs skip it and
/// blend sky and ground.
inline const std::string sharp_horizon_comment = "#@horizon sharp";
void append_sky_brightness(std::string& text, const std::string& modifier, const std::string& name,
                           const SkyBrightness& sky);
/// What to write where a pattern names a file.
struct FileWords {
    std::function<std::string(const std::string& path)> found;
    std::function<std::string(const std::string& text)> made; ///< for one that is nowhere yet, with this content
};
/// A material with functions as it was read.
/// @return  as append_varying()
bool append_functions(std::string& text, const std::string& modifier, const std::string& name,
                      const PlaceProgram& functions, const FileWords& file_words);
/// A pattern, texture or mixture as it was read.
/// @param mixed  the words of a mixture's foreground and background; empty for the others
/// @return       false when its transform cannot be told by words: it is left out
bool append_varying(std::string& text, const std::string& modifier, const std::string& name,
                    const PlaceFunction& function, const std::vector<std::string>& mixed, const FileWords& file_words);

} // namespace lightwell::scene_text
