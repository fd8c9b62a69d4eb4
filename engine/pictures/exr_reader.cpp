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
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledInputFile.h>

#include <cstring>
#include <stdexcept>

namespace lightwell {

namespace {

/// Bytes in memory as OpenEXR wants to see them.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(std::string_view bytes, const std::string& place) : IStream(place.c_str()), bytes_(bytes) {}
    bool read(char to[], int count) override
    {
        const auto wanted = static_cast<std::size_t>(count);
        if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < wanted)
            throw std::runtime_error("ends too early");
        std::memcpy(to, bytes_.data() + at_, wanted);
        at_ += wanted;
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

std::string text_of(const Primaries& p)
{
    std::string text;
    for (const float number : {p.red_x, p.red_y, p.green_x, p.green_y, p.blue_x, p.blue_y, p.white_x, p.white_y})
        text.append(shortest(static_cast<double>(number))).append(" ");
    text.pop_back();
    return text;
}

/// Colours are handed over as they are; when they are not the engine's, the header says what they are.
void note_colour(const Imf::Header& from, Picture& picture)
{
    if (!picture.channels.contains("R") || !picture.channels.contains("G") || !picture.channels.contains("B"))
        return;
    Primaries primaries = rec709_primaries;
    if (Imf::hasChromaticities(from)) {
        const Imf::Chromaticities& c = Imf::chromaticities(from);
        primaries = {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
    }
    if (primaries != engine_primaries)
        picture.header["chromaticities"] = text_of(primaries);
    const float white = Imf::hasWhiteLuminance(from) ? Imf::whiteLuminance(from) : 0;
    if (white != static_cast<float>(lumens_per_watt))
        picture.header["whiteLuminance"] = shortest(static_cast<double>(white));
}

/// Size, empty channels of float and half, text attributes.
Picture layout_of(const Imf::Header& from, const std::string& place)
{
    Picture picture;
    const Imath::Box2i window = from.dataWindow();
    picture.width = window.max.x - window.min.x + 1;
    picture.height = window.max.y - window.min.y + 1;
    const Imath::Box2i whole = from.displayWindow();
    if (whole != window)
        picture.place = {window.min.x - whole.min.x, window.min.y - whole.min.y, whole.max.x - whole.min.x + 1,
                         whole.max.y - whole.min.y + 1};
    for (auto channel = from.channels().begin(); channel != from.channels().end(); ++channel) {
        if (channel.channel().type == Imf::UINT)
            continue; // ids of objects and the like: no quantity
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw InputError{place, std::string("channel \"") + channel.name() + "\" is not stored for every pixel",
                             "save the picture as R, G, B"};
        picture.channels[channel.name()];
    }
    if (picture.channels.empty())
        throw InputError{place, "has no float or half channel", "save the picture with float channels"};
    for (auto attribute = from.begin(); attribute != from.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            if (!is_reserved_exr_name(attribute.name()))
                picture.header[attribute.name()] = text->value();
    note_colour(from, picture);
    return picture;
}

/// Channels of `picture`, whose pixel (0, 0) is pixel (x, y) of the file, as places to read into.
Imf::FrameBuffer places_in(Picture& picture, int x, int y)
{
    Imf::FrameBuffer buffer;
    for (auto& [name, values] : picture.channels) {
        values.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0.0f);
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), {x, y}, picture.width, picture.height));
    }
    return buffer;
}

ExrTiles read_tiles(std::string_view bytes, const std::string& place)
{
    MemoryStream stream(bytes, place);
    Imf::TiledInputFile input(stream, 0);
    ExrTiles result{layout_of(input.header(), place), static_cast<int>(input.tileXSize()), {}};
    if (input.tileXSize() != input.tileYSize())
        throw InputError{place, "tiles are not square"};
    const Imath::V2i origin = input.header().dataWindow().min;
    for (int row = 0; row < input.numYTiles(0); ++row)
        for (int column = 0; column < input.numXTiles(0); ++column) {
            const Imath::Box2i window = input.dataWindowForTile(column, row);
            Picture tile = result.layout;
            tile.header.clear();
            tile.place = {};
            tile.width = window.max.x - window.min.x + 1;
            tile.height = window.max.y - window.min.y + 1;
            try {
                input.setFrameBuffer(places_in(tile, window.min.x, window.min.y));
                input.readTile(column, row);
            } catch (const std::exception&) {
                continue; // never written, or torn by the kill: it is computed again
            }
            result.tiles.try_emplace({window.min.x - origin.x, window.min.y - origin.y}, std::move(tile));
        }
    return result;
}

/// Runs `read` and turns whatever the library throws into an InputError.
template <class Read>
auto as_input_error(const std::string& place, const Read& read)
{
    try {
        return read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError{place, std::string("cannot be read: ") + error.what(),
                         "the file is truncated or damaged; write it again"};
    }
}

} // namespace

Picture read_exr_bytes(std::string_view bytes, const std::string& place)
{
    check_exr_header(bytes, place);
    return as_input_error(place, [&] {
        MemoryStream stream(bytes, place);
        Imf::InputFile input(stream, 0);
        Picture picture = layout_of(input.header(), place);
        const Imath::Box2i window = input.header().dataWindow();
        input.setFrameBuffer(places_in(picture, window.min.x, window.min.y));
        input.readPixels(window.min.y, window.max.y);
        return picture;
    });
}

ExrTiles read_exr_tiles(std::string_view bytes, const std::string& place)
{
    check_exr_header(bytes, place);
    return as_input_error(place, [&] { return read_tiles(bytes, place); });
}

} // namespace lightwell
