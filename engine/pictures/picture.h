#pragma once

#include <map>
#include <string>
#include <vector>

namespace lightwell {

/// A picture of named float channels, row 0 at the top. Colour channels "R", "G", "B" in the engine's primaries are
/// radiance in W/(m^2 sr); "illuminance.Y" lx, "Z" m along the view ray, "N.X" "N.Y" "N.Z", "error.R/G/B/Y"
/// standard errors in the unit of what they belong to, "bias.Y" the expected bias of the luminance, cd/m^2.
struct Picture {
    /// Where the pixels lie in a larger picture: its column and row of pixel (0, 0), and its size.
    struct Place {
        int x = 0, y = 0;
        int width = 0, height = 0; ///< 0: the picture is the whole
        bool operator==(const Place&) const noexcept = default;
    };
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels; ///< each width * height values
    std::map<std::string, std::string> header;          ///< VIEW, settings, provenance: text attributes
    Place place = {};

    float at(const std::string& channel, int x, int y) const
    {
        return channels.at(
            channel)[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    std::vector<float>& add_channel(const std::string& name)
    {
        return channels.try_emplace(name, static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
            .first->second;
    }
};

} // namespace lightwell
