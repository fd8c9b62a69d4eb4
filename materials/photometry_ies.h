#pragma once

#include "engine/base/report.h"

#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// What a file of the form IES LM-63 says, as written: no factor applied, no plane completed, nothing turned.
struct IesFile {
    std::vector<std::string> label;      ///< the lines before TILT=, UTF-8
    std::string tilt;                    ///< behind TILT=, as written: NONE, INCLUDE or the name of a file
    int tilt_position = 1;               ///< of the lamp: 1 any, 2 tilted about x, 3 about y
    std::vector<double> tilt_deg;        ///< ascending; empty without a table
    std::vector<double> tilt_share = {}; ///< of the light, at each of tilt_deg
    double lamps = 0, lumens = 0, multiplier = 1, ballast_factor = 1, lamp_factor = 1, watts = 0;
    int type = 1;                             ///< 1: C, 2: B, 3: A
    double metres = 1;                        ///< of the file's unit
    double width = 0, length = 0, height = 0; ///< of the opening, in that unit; below 0: round
    std::vector<double> vertical_deg, horizontal_deg;
    std::vector<double> candela; ///< [horizontal][vertical]
};

/// @param report  receives a note when something stands behind the intensities
/// @throws InputError with file and line: no line TILT=, no number where one is expected, absurd counts or sizes
IesFile read_ies_file(std::string_view text, const std::string& file_name, Report& report);
/// The table that a file named by TILT= holds: lamp position, number of angles, angles, shares.
/// @throws InputError
void read_tilt_table(std::string_view text, const std::string& file_name, IesFile& file);

} // namespace lightwell
