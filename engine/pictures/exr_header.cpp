#include "engine/pictures/exr_header.h"

#include "engine/base/errors.h"
#include "engine/pictures/limits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>

namespace lightwell {

namespace {

// Source  "OpenEXR File Layout", openexr.com: little-endian; magic, version with flags, attributes, chunk offsets.
constexpr std::uint32_t magic = 20000630;
constexpr std::uint32_t tiled_flag = 0x200, deep_flag = 0x800, multipart_flag = 0x1000;
constexpr std::size_t longest_name = 255;
/// More than any renderer writes; each one costs a scan of the list.
constexpr std::size_t most_channels = 1024, most_attributes = 4096;
/// Tiles are decoded whole, so a tile must stay small even in a big picture.
constexpr std::int64_t largest_tile_bytes = std::int64_t{1} << 28;

class HeaderCheck {
public:
    HeaderCheck(std::string_view bytes, const std::string& place) : bytes_(bytes), place_(place) {}
    void run();

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw InputError{place_, what, "the file is truncated or damaged; write it again"};
    }
    std::uint32_t number(std::string_view from, std::size_t at) const;
    std::int64_t signed_number(std::string_view from, std::size_t at) const
    {
        return static_cast<std::int32_t>(number(from, at));
    }
    std::string_view name(std::string_view from, std::size_t& at) const;
    void read_attributes();
    std::string_view value(const char* name, const char* type, std::size_t least_size) const;
    void check_kind(std::uint32_t flags) const;
    void check_channels();
    void check_size(bool tiled) const;
    void check_previews() const;
    std::int64_t lines_per_chunk() const;

    struct Attribute {
        std::string_view type, value;
    };
    std::string_view bytes_;
    const std::string& place_;
    std::size_t at_ = 8;
    std::map<std::string_view, Attribute> attributes_;
    std::int64_t channels_ = 0, bytes_per_pixel_ = 0;
};

std::uint32_t HeaderCheck::number(std::string_view from, std::size_t at) const
{
    if (at > from.size() || from.size() - at < 4)
        refuse("ends inside the header");
    std::array<unsigned char, 4> b{};
    std::memcpy(b.data(), from.data() + at, 4);
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

/// A name that ends with a zero byte; `at` moves past it.
std::string_view HeaderCheck::name(std::string_view from, std::size_t& at) const
{
    if (at >= from.size())
        refuse("ends inside the header");
    const std::string_view rest = from.substr(at, longest_name + 1);
    const std::size_t end = rest.find('\0');
    if (end == std::string_view::npos)
        refuse("a name in the header does not end within " + std::to_string(longest_name) + " bytes");
    at += end + 1;
    return rest.substr(0, end);
}

void HeaderCheck::read_attributes()
{
    while (true) {
        const std::string_view attribute = name(bytes_, at_);
        if (attribute.empty())
            return;
        const std::string_view type = name(bytes_, at_);
        const std::size_t size = number(bytes_, at_);
        at_ += 4;
        if (size > bytes_.size() - at_)
            refuse("attribute \"" + std::string(attribute) + "\" of " + std::to_string(size) +
                   " bytes runs past the end of the file");
        if (!attributes_.try_emplace(attribute, Attribute{type, bytes_.substr(at_, size)}).second)
            refuse("attribute \"" + std::string(attribute) + "\" appears twice");
        if (attributes_.size() > most_attributes)
            refuse("has more than " + std::to_string(most_attributes) + " attributes");
        at_ += size;
    }
}

std::string_view HeaderCheck::value(const char* wanted, const char* type, std::size_t least_size) const
{
    const auto found = attributes_.find(wanted);
    if (found == attributes_.end())
        refuse(std::string("has no attribute \"") + wanted + "\"");
    if (found->second.type != type || found->second.value.size() < least_size)
        refuse(std::string("attribute \"") + wanted + "\" is not a complete " + type);
    return found->second.value;
}

void HeaderCheck::check_kind(std::uint32_t flags) const
{
    if ((flags & 0xff) != 2)
        refuse("is version " + std::to_string(flags & 0xff) + " of OpenEXR, expected 2");
    const auto type = attributes_.find("type");
    const bool flat =
        type == attributes_.end() || type->second.value == "scanlineimage" || type->second.value == "tiledimage";
    if ((flags & (deep_flag | multipart_flag)) != 0 || !flat)
        throw InputError{place_, "holds several parts or deep data, expected one flat picture",
                         "save it as one flat part"};
}

void HeaderCheck::check_channels()
{
    constexpr std::size_t after_name = 16; // type, linear flag and padding, two samplings
    const std::string_view list = value("channels", "chlist", 1);
    std::size_t at = 0;
    while (true) {
        const std::string_view channel = name(list, at);
        if (channel.empty())
            break;
        const std::uint32_t type = number(list, at);
        const std::int64_t x_sampling = signed_number(list, at + 8), y_sampling = signed_number(list, at + 12);
        if (type > 2 || x_sampling < 1 || y_sampling < 1)
            refuse("channel \"" + std::string(channel) + "\" has type " + std::to_string(type) + " and sampling " +
                   std::to_string(x_sampling) + " x " + std::to_string(y_sampling) +
                   ", expected type 0 to 2, sampling >= 1");
        at += after_name;
        bytes_per_pixel_ += type == 1 ? 2 : 4;
        if (++channels_ > static_cast<std::int64_t>(most_channels))
            refuse("has more than " + std::to_string(most_channels) + " channels");
    }
    if (channels_ == 0)
        refuse("has no channel");
}

/// How many lines are packed together, by the number of the compression method.
std::int64_t HeaderCheck::lines_per_chunk() const
{
    constexpr std::array<std::int64_t, 10> lines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    const auto method = static_cast<unsigned char>(value("compression", "compression", 1)[0]);
    if (method >= lines.size())
        refuse("compression method is " + std::to_string(method) + ", expected 0 to 9");
    return lines[method];
}

void HeaderCheck::check_size(bool tiled) const
{
    const std::string_view window = value("dataWindow", "box2i", 16);
    const std::int64_t width = signed_number(window, 8) - signed_number(window, 0) + 1;
    const std::int64_t height = signed_number(window, 12) - signed_number(window, 4) + 1;
    check_picture_size(place_, width, height, channels_, bytes_.size());
    const std::int64_t lines = lines_per_chunk();
    std::int64_t chunks = (height + lines - 1) / lines;
    if (tiled) {
        const std::string_view tiles = value("tiles", "tiledesc", 9);
        const std::int64_t tile_width = number(tiles, 0), tile_height = number(tiles, 4);
        if (tile_width < 1 || tile_height < 1 || tile_width > most_pixels || tile_height > most_pixels ||
            tile_width * tile_height > largest_tile_bytes / bytes_per_pixel_)
            refuse("tiles are " + std::to_string(tile_width) + " x " + std::to_string(tile_height) + " pixels");
        chunks = ((width + tile_width - 1) / tile_width) * ((height + tile_height - 1) / tile_height);
    }
    constexpr std::int64_t bytes_per_offset = 8;
    if (chunks > static_cast<std::int64_t>(bytes_.size() - at_) / bytes_per_offset)
        refuse("ends before the table of its " + std::to_string(chunks) + " chunks");
}

/// The library allocates a thumbnail by its own claim of width and height, not by the size of the attribute.
void HeaderCheck::check_previews() const
{
    for (const auto& [attribute, content] : attributes_) {
        if (content.type != "preview")
            continue;
        const std::int64_t width = number(content.value, 0), height = number(content.value, 4);
        if (width > most_pixels || height > most_pixels ||
            width * height > static_cast<std::int64_t>(content.value.size()) / 4)
            refuse("thumbnail claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    }
}

void HeaderCheck::run()
{
    if (bytes_.size() < 8 || number(bytes_, 0) != magic)
        throw InputError{place_, "is not an OpenEXR file", "give a file that ends in .exr and was written completely"};
    const std::uint32_t flags = number(bytes_, 4);
    if ((flags & (deep_flag | multipart_flag)) == 0)
        read_attributes();
    check_kind(flags);
    check_channels();
    check_size((flags & tiled_flag) != 0);
    check_previews();
}

} // namespace

void check_exr_header(std::string_view bytes, const std::string& place)
{
    HeaderCheck{bytes, place}.run();
}

bool is_reserved_exr_name(std::string_view name) noexcept
{
    constexpr std::array<std::string_view, 18> reserved{"channels",
                                                        "chromaticities",
                                                        "chunkCount",
                                                        "compression",
                                                        "dataWindow",
                                                        "displayWindow",
                                                        "envmap",
                                                        "lineOrder",
                                                        "maxSamplesPerPixel",
                                                        "name",
                                                        "pixelAspectRatio",
                                                        "preview",
                                                        "screenWindowCenter",
                                                        "screenWindowWidth",
                                                        "tiles",
                                                        "type",
                                                        "version",
                                                        "whiteLuminance"};
    return std::find(reserved.begin(), reserved.end(), name) != reserved.end();
}

} // namespace lightwell
