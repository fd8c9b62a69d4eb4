#pragma once

#include <string>
#include <string_view>

namespace lightwell {

/// A format of the long tail, known by its content.
struct ForeignFormat {
    const char* extension; ///< what collect_scene calls the reader
    const char* name;      ///< for people
    /// Why a file of this kind is not read; nullptr when it is.
    const char* refusal;
};

/// @return nullptr when the first bytes are those of no format known here
/// @param size  of the whole file: binary STL is known by it
const ForeignFormat* foreign_format_of(std::string_view bytes, std::size_t size);

} // namespace lightwell
