#pragma once

#include <string>
#include <string_view>

namespace lightwell::dxf {

/// Turns the texts of a drawing into UTF-8.
class CodePage {
public:
    /// Windows-1252 until the header says otherwise.
    CodePage() = default;
    /// @param name  value of $DWGCODEPAGE: "ANSI_1252", "ANSI_936", "dos850", ...
    explicit CodePage(std::string_view name);
    /// False when the name is unknown: texts are then read as Windows-1252.
    bool known() const noexcept { return known_; }
    /// Bytes that are UTF-8 already stay (releases since 2007 write it); else the code page is applied. \U+XXXX
    /// becomes the character.
    std::string decoded(std::string_view bytes) const;

private:
    std::string name_; ///< for iconv; empty: Windows-1252
    bool known_ = true;
};

} // namespace lightwell::dxf
