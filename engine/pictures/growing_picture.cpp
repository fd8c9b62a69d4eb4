#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/pictures/exr.h"
#include "engine/pictures/exr_file.h"
#include "engine/pictures/limits.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <unistd.h>

namespace lightwell {

namespace {

using TileKey = std::pair<int, int>;

std::filesystem::path partial_name(const std::filesystem::path& file)
{
    std::filesystem::path partial = file;
    partial.replace_extension(".partial.exr");
    return partial;
}

/// A part as large as the whole is the whole: a file cannot tell them apart.
Picture::Place place_of(const Picture& layout)
{
    const bool whole = layout.place == Picture::Place{0, 0, layout.width, layout.height};
    return whole ? Picture::Place{} : layout.place;
}

std::string settings_of(const Picture& picture)
{
    const auto found = picture.header.find("settings");
    return found == picture.header.end() ? std::string() : found->second;
}

bool same_layout(const Picture& a, const Picture& b)
{
    return a.width == b.width && a.height == b.height && place_of(a) == place_of(b) &&
           settings_of(a) == settings_of(b) &&
           std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first; });
}

/// Tiles of an interrupted run; none when there was none, or it had other settings, or its file is damaged.
std::map<TileKey, Picture> earlier_tiles(const std::filesystem::path& partial, const Picture& layout, int tile_size)
{
    if (!std::filesystem::exists(partial))
        return {};
    try {
        const MappedFile mapped(partial);
        ExrTiles found = read_exr_tiles(mapped.bytes(), partial.string());
        if (found.tile_size == tile_size && same_layout(found.layout, layout))
            return std::move(found.tiles);
    } catch (const InputError&) {
        // Unreadable work in progress is worth no more than none: the tiles are computed again.
    }
    return {};
}

} // namespace

std::string interrupted_settings(const std::filesystem::path& file)
{
    const std::filesystem::path partial = partial_name(file);
    if (!std::filesystem::exists(partial))
        return {};
    try {
        const MappedFile mapped(partial);
        return settings_of(read_exr_tiles(mapped.bytes(), partial.string()).layout);
    } catch (const InputError&) {
        return {}; // as good as none
    }
}

struct GrowingPicture::State {
    std::filesystem::path file, partial;
    Picture layout; ///< without pixels
    int tile_size = 0;
    std::map<TileKey, Picture> resumed;
    std::mutex mutex; ///< guards what follows
    std::set<TileKey> written;
    std::unique_ptr<ExrWriter> writer;

    void check_tile(int x, int y, const Picture& tile) const;
    void write(int x, int y, const Picture& tile);
    void start();
};

void GrowingPicture::State::check_tile(int x, int y, const Picture& tile) const
{
    const std::string place = partial.string() + ": tile at " + std::to_string(x) + ", " + std::to_string(y);
    if (x < 0 || y < 0 || x >= layout.width || y >= layout.height || x % tile_size != 0 || y % tile_size != 0)
        throw InputError{place, "is not a place where a tile of " + std::to_string(tile_size) + " pixels begins"};
    const int width = std::min(tile_size, layout.width - x), height = std::min(tile_size, layout.height - y);
    if (tile.width != width || tile.height != height)
        throw InputError{place, "is " + std::to_string(tile.width) + " x " + std::to_string(tile.height) +
                                    " pixels, expected " + std::to_string(width) + " x " + std::to_string(height)};
    check_picture(place, tile);
    for (const auto& [name, values] : layout.channels)
        if (!tile.channels.contains(name))
            throw InputError{place, "has no channel \"" + name + "\""};
}

void GrowingPicture::State::write(int x, int y, const Picture& tile)
{
    if (!writer)
        throw InputError{partial.string(), "is already finished; no tile can be added"};
    if (!written.insert({x, y}).second)
        return;
    try {
        writer->write_tile(x, y, tile, x, y);
    } catch (const std::exception& error) {
        throw InputError{partial.string(), std::string("cannot be written: ") + error.what(), "check free space"};
    }
}

/// Begins a new file under another name, brings the earlier tiles over, and only then replaces the old one, so that a
/// kill at any moment loses nothing.
void GrowingPicture::State::start()
{
    const std::filesystem::path beginning = partial.string() + ".writing-" + std::to_string(getpid());
    const std::filesystem::path folder = partial.has_parent_path() ? partial.parent_path() : ".";
    if (!std::filesystem::is_directory(folder))
        throw InputError{file.string(), "the folder " + folder.string() + " does not exist", "make it first"};
    try {
        writer = std::make_unique<ExrWriter>(beginning, layout, tile_size, true);
        for (const auto& [place, tile] : resumed)
            write(place.first, place.second, tile);
        std::filesystem::rename(beginning, partial);
    } catch (const std::exception& error) {
        writer.reset();
        std::error_code ignored;
        std::filesystem::remove(beginning, ignored);
        if (dynamic_cast<const InputError*>(&error) != nullptr)
            throw;
        throw InputError{partial.string(), std::string("cannot be written: ") + error.what(),
                         "check rights and free space"};
    }
}

GrowingPicture::GrowingPicture(std::filesystem::path file, const Picture& layout, int tile_size)
    : state_(std::make_unique<State>())
{
    state_->file = std::move(file);
    state_->partial = partial_name(state_->file);
    state_->layout = {layout.width, layout.height, {}, layout.header, layout.place};
    for (const auto& [name, values] : layout.channels)
        state_->layout.channels[name];
    state_->tile_size = tile_size;
    check_layout_size(state_->file.string(), layout.width, layout.height);
    check_exr_layout(state_->file.string(), layout, tile_size);
    state_->resumed = earlier_tiles(state_->partial, layout, tile_size);
    state_->start();
}

GrowingPicture::~GrowingPicture() = default;

std::size_t GrowingPicture::resumed_tiles() const noexcept
{
    return state_->resumed.size();
}

std::optional<Picture> GrowingPicture::stored(int x, int y) const
{
    const auto found = state_->resumed.find({x, y});
    return found == state_->resumed.end() ? std::nullopt : std::optional(found->second);
}

void GrowingPicture::put(int x, int y, const Picture& tile)
{
    state_->check_tile(x, y, tile);
    const std::lock_guard lock(state_->mutex);
    state_->write(x, y, tile);
}

void GrowingPicture::finish(const Picture& complete)
{
    write_exr(complete, state_->file);
    const std::lock_guard lock(state_->mutex);
    state_->writer.reset();
    std::error_code gone; // a partial file that someone else removed already is no error
    std::filesystem::remove(state_->partial, gone);
}

} // namespace lightwell
