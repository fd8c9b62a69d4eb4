#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

namespace lightwell {

/// What the reader of IFC geometry leaves out, taken from the text of the file itself.
struct IfcText {
    /// Presentation layer of each product by its GlobalId; products without one are missing.
    std::unordered_map<std::string, std::string> layer_of_product;
    double metres_per_unit = 0; ///< of the project's length unit; 0: not stated
    std::string unit_name;      ///< as the file says it, "MILLI METRE", "FOOT"
    /// Names of surface styles as the file has them, by the same without blanks, as the reader gives them.
    std::unordered_map<std::string, std::string> style_names;
    std::size_t spaces = 0; ///< IfcSpace: volumes of air, without surfaces
};

/// Never throws for what is damaged: a statement that cannot be understood is passed over.
/// Source  ISO 10303-21 (text of statements); IFC 2x3 TC1, IfcPresentationLayerAssignment, IfcUnitAssignment
IfcText read_ifc_text(std::string_view text);

/// Characters of other alphabets in a string of ISO 10303-21: `\X2\00FC\X0\`, `\X\FC`, `\S\|`, `''`.
std::string decode_step_string(std::string_view text);

} // namespace lightwell
