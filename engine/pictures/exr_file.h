#pragma once

#include "engine/pictures/exr.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace lightwell {

/// Checks what ExrWriter needs: tile size, names of channels and of header entries, colour entries.
/// @throws InputError naming the entry
void check_exr_layout(const std::string& place, const Picture& layout, int tile_size);

/// Writes an OpenEXR file tile by tile: FLOAT, packed as its use is. What a call has written is with the operating
/// system when the call returns, so that a killed program leaves a file with all tiles up to the last one; a failure of
/// power loses those of the last second or so.
class ExrWriter {
public:
    /// @param layout     size, channel names and header, checked by check_exr_layout()
    /// @param any_order  tiles come in any order; otherwise row by row from the top
    /// @throws std::exception when the file cannot be written
    ExrWriter(const std::filesystem::path& file, const Picture& layout, int tile_size, bool any_order,
              ExrUse use = ExrUse::keep);
    /// Ends the file even when tiles are missing; errors are lost, so call close() where they matter.
    ~ExrWriter();
    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;

    /// Writes the tile whose first pixel is (x, y) of the layout.
    /// @param from  pixels; its own pixel (0, 0) is pixel (from_x, from_y) of the layout
    void write_tile(int x, int y, const Picture& from, int from_x, int from_y);
    /// Writes the table of tiles and closes. @throws std::exception when not everything could be written
    void close();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// @throws InputError, see read_exr()
Picture read_exr_bytes(std::string_view bytes, const std::string& place);

/// What can be read of a tiled file that was left unfinished.
struct ExrTiles {
    Picture layout; ///< size, empty channels, header
    int tile_size = 0;
    std::map<std::pair<int, int>, Picture> tiles; ///< by first pixel (x, y)
};
/// @throws InputError when not even the header can be read, or tiles are not square
ExrTiles read_exr_tiles(std::string_view bytes, const std::string& place);

/// Primaries as OpenEXR keeps them: x, y of red, green, blue and white.
struct Primaries {
    float red_x, red_y, green_x, green_y, blue_x, blue_y, white_x, white_y;
    bool operator==(const Primaries&) const noexcept = default;
};
inline constexpr Primaries engine_primaries{0.64f, 0.33f, 0.29f, 0.60f, 0.15f, 0.06f, 1.0f / 3, 1.0f / 3};
/// What OpenEXR means when a file names none.
inline constexpr Primaries rec709_primaries{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

} // namespace lightwell
