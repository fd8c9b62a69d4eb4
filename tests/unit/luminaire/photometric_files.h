#pragma once

#include "materials/photometry.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

namespace lightwell {

/// Files beside the repository, if they are there.
inline std::filesystem::path shared(const std::string& file)
{
    const char* set = std::getenv("LIGHTWELL_SHARED");
    return std::filesystem::path(set ? set : LIGHTWELL_ROOT "/../shared") / file;
}

/// An IES file of one plane with an intensity every degree.
/// @param size  of the opening: width, length, height in metres
inline std::string ies_text(const std::function<double(double theta_rad)>& candela, const std::string& size,
                            int last_deg = 180)
{
    std::string text = "IESNA:LM-63-2002\n[LUMINAIRE] test\nTILT=NONE\n1 -1 1 " + std::to_string(last_deg + 1) +
                       " 1 1 2 " + size + "\n1 1 20\n";
    for (int angle = 0; angle <= last_deg; ++angle)
        text += std::to_string(angle) + (angle % 20 == 19 ? '\n' : ' ');
    text += "\n0\n";
    for (int angle = 0; angle <= last_deg; ++angle)
        text += std::to_string(std::max(0.0, candela(angle * pi / 180))) + (angle % 10 == 9 ? '\n' : ' ');
    return text;
}

inline double lambertian(double theta_rad)
{
    return 1000 * std::cos(theta_rad);
}

} // namespace lightwell
