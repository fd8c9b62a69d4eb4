#pragma once

#include "engine/pictures/picture.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace lightwell {

/// What becomes of a written file.
enum class ExrUse {
    keep,     ///< packed (ZIP) and forced onto the disk
    hand_over ///< read at once by another program, and then of no use: neither, since both take longer than the reading
};

/// Tiled FLOAT channels; header entries as text attributes, chromaticities and whiteLuminance of the engine. A part of
/// a larger picture has that one as display window.
/// @throws InputError when the file cannot be written; the final name never holds half a file
void write_exr(const Picture& picture, const std::filesystem::path& file, ExrUse use = ExrUse::keep);
/// @throws InputError: missing, truncated, not an OpenEXR file, no float or half channels, absurd size
Picture read_exr(const std::filesystem::path& file);

/// A picture that grows tile by tile as NAME.partial.exr and becomes NAME when complete. A killed run leaves a file
/// that opens; constructing it again with the same header takes over the tiles that can be read.
class GrowingPicture {
public:
    /// @param layout  size, channel names (contents unused) and header; header "settings" must agree to resume
    GrowingPicture(std::filesystem::path file, const Picture& layout, int tile_size);
    ~GrowingPicture();
    GrowingPicture(const GrowingPicture&) = delete;
    GrowingPicture& operator=(const GrowingPicture&) = delete;

    std::size_t resumed_tiles() const noexcept;
    /// The tile at pixel (x, y) when an earlier run finished it.
    std::optional<Picture> stored(int x, int y) const;
    /// Thread-safe. With the operating system when it returns, so a kill does not lose it; a tile that is already
    /// there is kept.
    /// @throws InputError: no place of a tile, wrong size or channels, disk full
    void put(int x, int y, const Picture& tile);
    /// Writes `complete` (all pixels, final header) under the final name and removes the partial file.
    void finish(const Picture& complete);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Header "settings" of the picture that an interrupted run of `file` has left; empty when there is none.
std::string interrupted_settings(const std::filesystem::path& file);

} // namespace lightwell
