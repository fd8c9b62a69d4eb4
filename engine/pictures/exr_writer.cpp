#include "engine/base/errors.h"
#include "engine/base/spectrum.h"
#include "engine/base/text.h"
#include "engine/pictures/exr_file.h"
#include "engine/pictures/exr_header.h"
#include "engine/pictures/limits.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace lightwell {

namespace {

/// Collects what belongs to one tile and hands it over in one call, so that a kill rarely splits a tile, and
/// remembers errors, which OpenEXR forgets when it closes a file.
class FileStream : public Imf::OStream {
public:
    explicit FileStream(const std::filesystem::path& file, ExrUse use)
        : OStream(file.c_str()), use_(use),
          descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666))
    {
        if (descriptor_ < 0)
            throw std::system_error(errno, std::generic_category());
    }
    ~FileStream() override
    {
        if (descriptor_ >= 0)
            ::close(descriptor_);
    }
    FileStream(const FileStream&) = delete;
    FileStream& operator=(const FileStream&) = delete;

    void write(const char bytes[], int count) override { pending_.append(bytes, static_cast<std::size_t>(count)); }
    std::uint64_t tellp() override { return start_ + pending_.size(); }
    void seekp(std::uint64_t position) override
    {
        flush();
        start_ = position;
    }
    void flush()
    {
        std::size_t done = 0;
        while (done < pending_.size()) {
            const ssize_t written =
                pwrite(descriptor_, pending_.data() + done, pending_.size() - done, static_cast<off_t>(start_ + done));
            if (written < 0 && errno == EINTR)
                continue;
            if (written <= 0) {
                error_ = written < 0 ? errno : ENOSPC;
                throw std::system_error(error_, std::generic_category());
            }
            done += static_cast<std::size_t>(written);
        }
        start_ += pending_.size();
        pending_.clear();
    }
    /// To the disk itself, so that a power failure does not lose it, but not for each small piece: a disk takes some
    /// milliseconds to answer.
    void sync_now_and_then()
    {
        constexpr std::chrono::seconds between{1};
        const auto now = std::chrono::steady_clock::now();
        if (use_ == ExrUse::hand_over || now - synced_ < between)
            return;
        fdatasync(descriptor_); // what fails here shows again at finish()
        synced_ = now;
    }
    void finish()
    {
        flush();
        if (error_ == 0 && use_ == ExrUse::keep && fsync(descriptor_) != 0 && errno != EINVAL &&
            errno != EROFS) // not on every file system
            error_ = errno;
        if (error_ == 0 && ::close(std::exchange(descriptor_, -1)) != 0)
            error_ = errno;
        if (error_ != 0)
            throw std::system_error(error_, std::generic_category());
    }

private:
    ExrUse use_;
    int descriptor_;
    int error_ = 0;
    std::uint64_t start_ = 0; ///< where `pending_` goes
    std::chrono::steady_clock::time_point synced_{};
    std::string pending_;
};

/// Unit of what a channel holds, by its name (picture.h); empty for a channel that is not ours.
std::string unit_of(std::string_view channel)
{
    if (channel.starts_with("error."))
        channel.remove_prefix(6);
    if (channel == "R" || channel == "G" || channel == "B")
        return "W/(m^2 sr)";
    if (channel.starts_with("illuminance."))
        return "lx";
    if (channel == "Y")
        return "cd/m^2";
    if (channel == "Z")
        return "m";
    return channel.starts_with("N.") ? "1" : "";
}

Primaries primaries_of(const Picture& layout, const std::string& place)
{
    const auto entry = layout.header.find("chromaticities");
    if (entry == layout.header.end())
        return engine_primaries;
    std::array<float, 8> numbers{};
    const std::vector<std::string_view> words = split(entry->second);
    bool good = words.size() == numbers.size();
    for (std::size_t i = 0; good && i < numbers.size(); ++i) {
        const std::optional<double> number = parse_double(words[i]);
        good = number && *number >= -10 && *number <= 10;
        numbers[i] = static_cast<float>(number.value_or(0));
    }
    if (!good)
        throw InputError{place, "header entry chromaticities is \"" + entry->second + "\"",
                         "expected eight numbers x y"};
    return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7]};
}

/// @return 0 when the picture says that it is not known
float white_luminance_of(const Picture& layout, const std::string& place)
{
    const auto entry = layout.header.find("whiteLuminance");
    if (entry == layout.header.end())
        return static_cast<float>(lumens_per_watt);
    const std::optional<double> number = parse_double(entry->second);
    if (!(number && *number >= 0 && *number <= 1e30))
        throw InputError{place, "header entry whiteLuminance is \"" + entry->second + "\"",
                         "expected cd/m^2, or 0 for unknown"};
    return static_cast<float>(*number);
}

void add_text(Imf::Header& header, const std::string& name, const std::string& text, const std::string& place)
{
    constexpr std::size_t longest_name = 255;
    if (name.empty() || name.size() > longest_name || name.find('\0') != std::string::npos ||
        is_reserved_exr_name(name))
        throw InputError{place, "header entry \"" + name + "\" has a name that OpenEXR cannot hold or keeps for itself",
                         "choose another name of 1 to 255 bytes"};
    header.insert(name, Imf::StringAttribute(text));
}

void check_place(const Picture& layout, const std::string& place)
{
    constexpr int farthest = 1 << 29; // so that no corner leaves the range of whole numbers
    const Picture::Place& within = layout.place;
    for (const int number : {within.x, within.y, within.width, within.height})
        if (number < -farthest || number > farthest)
            throw InputError{place, "lies at pixel " + std::to_string(within.x) + ", " + std::to_string(within.y) +
                                        " of a whole of " + std::to_string(within.width) + " x " +
                                        std::to_string(within.height) + ", expected numbers below 2^29"};
    if (within.height < 1)
        throw InputError{place, "is part of a whole of " + std::to_string(within.height) + " rows"};
}

Imf::Header header_of(const Picture& layout, int tile_size, bool any_order, ExrUse use, const std::string& place)
{
    Imf::Header header(layout.width, layout.height);
    if (const Picture::Place& within = layout.place; within.width > 0) {
        check_place(layout, place);
        header.displayWindow() = Imath::Box2i({0, 0}, {within.width - 1, within.height - 1});
        header.dataWindow() =
            Imath::Box2i({within.x, within.y}, {within.x + layout.width - 1, within.y + layout.height - 1});
    }
    header.compression() = use == ExrUse::keep ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
    header.lineOrder() = any_order ? Imf::RANDOM_Y : Imf::INCREASING_Y;
    const auto side = static_cast<unsigned>(tile_size);
    header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
    const Primaries p = primaries_of(layout, place);
    Imf::addChromaticities(header, Imf::Chromaticities({p.red_x, p.red_y}, {p.green_x, p.green_y}, {p.blue_x, p.blue_y},
                                                       {p.white_x, p.white_y}));
    if (const float white = white_luminance_of(layout, place); white > 0)
        Imf::addWhiteLuminance(header, white);
    for (const auto& [name, values] : layout.channels) {
        constexpr std::size_t longest_channel = 240; // leaves room for "units." in the name of its attribute
        if (name.empty() || name.size() > longest_channel || name.find('\0') != std::string::npos)
            throw InputError{place, "channel \"" + name + "\" has a name that OpenEXR cannot hold",
                             "use 1 to 240 bytes"};
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        if (const std::string unit = unit_of(name); !unit.empty())
            add_text(header, "units." + name, unit, place);
    }
    for (const auto& [name, text] : layout.header)
        if (name != "chromaticities" && name != "whiteLuminance")
            add_text(header, name, text, place);
    return header;
}

} // namespace

struct ExrWriter::State {
    State(const std::filesystem::path& file, const Imf::Header& header, ExrUse use)
        : stream(file, use), output(std::in_place, stream, header, 0)
    {
        stream.flush();
    }
    FileStream stream;
    std::optional<Imf::TiledOutputFile> output;
};

void check_exr_layout(const std::string& place, const Picture& layout, int tile_size)
{
    constexpr int largest_tile = 4096;
    if (tile_size < 1 || tile_size > largest_tile)
        throw InputError{place, "tile size is " + std::to_string(tile_size) + ", expected 1 to 4096 pixels"};
    if (layout.channels.empty())
        throw InputError{place, "picture to be written has no channel", "add at least one"};
    header_of(layout, tile_size, false, ExrUse::keep, place);
}

ExrWriter::ExrWriter(const std::filesystem::path& file, const Picture& layout, int tile_size, bool any_order,
                     ExrUse use)
{
    state_ = std::make_unique<State>(file, header_of(layout, tile_size, any_order, use, file.string()), use);
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write_tile(int x, int y, const Picture& from, int from_x, int from_y)
{
    const Imath::V2i origin = state_->output->header().dataWindow().min;
    Imf::FrameBuffer buffer;
    for (const auto& [name, values] : from.channels)
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), {origin.x + from_x, origin.y + from_y},
                                             from.width, from.height));
    const auto side_x = static_cast<int>(state_->output->tileXSize()),
               side_y = static_cast<int>(state_->output->tileYSize());
    state_->output->setFrameBuffer(buffer);
    state_->output->writeTile(x / side_x, y / side_y);
    state_->stream.flush();
    state_->stream.sync_now_and_then();
}

void ExrWriter::close()
{
    state_->output.reset();
    state_->stream.finish();
}

} // namespace lightwell
