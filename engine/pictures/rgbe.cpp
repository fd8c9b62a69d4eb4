#include "engine/pictures/rgbe.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/pictures/limits.h"
#include "engine/pictures/rgbe_header.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int exponent_bias = 128;
/// Below this the format holds black.
constexpr float darkest = 1e-32f;
/// Only scan lines of these lengths are packed by component; shorter and longer ones are packed by pixel.
constexpr std::size_t shortest_packed = 8, longest_packed = 0x7fff;
/// Runs of equal bytes shorter than this cost more than they save.
constexpr std::size_t shortest_run = 4;
constexpr std::size_t longest_run = 127, longest_literal = 128;
/// In a packed component, a count above this repeats one byte.
constexpr unsigned run_mark = 128;

/// The order in which a file holds its pixels: the axis of the scan lines' succession first.
struct Resolution {
    bool x_major = false, x_falls = false, y_rises = false;
    std::int64_t width = 0, height = 0;

    std::int64_t lines() const { return x_major ? width : height; }
    std::int64_t length() const { return x_major ? height : width; }
    /// Index of a pixel in a picture with row 0 at the top.
    std::size_t index(std::int64_t line, std::int64_t along) const
    {
        const std::int64_t x = x_major ? line : along, y = x_major ? along : line;
        const std::int64_t column = x_falls ? width - 1 - x : x, row = y_rises ? height - 1 - y : y;
        return static_cast<std::size_t>(row * width + column);
    }
};

Resolution parse_resolution(std::string_view line, const std::string& place)
{
    const auto refuse = [&]() -> Resolution {
        throw InputError{place, "resolution line is \"" + std::string(line.substr(0, 60)) + "\"",
                         "expected -Y height +X width; the header is damaged or this is no Radiance picture"};
    };
    const std::vector<std::string_view> words = split(line, " \t\r");
    if (words.size() != 4)
        return refuse();
    Resolution result;
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        const std::optional<long long> size = parse_integer(words[i + 1]);
        const bool is_x = words[i] == "+X" || words[i] == "-X", is_y = words[i] == "+Y" || words[i] == "-Y";
        if (!(is_x || is_y) || !size || *size < 1)
            return refuse();
        (is_x ? result.width : result.height) = *size;
        if (is_x)
            result.x_falls = words[i][0] == '-';
        else
            result.y_rises = words[i][0] == '+';
    }
    if (result.width == 0 || result.height == 0)
        return refuse();
    result.x_major = words[0][1] == 'X';
    return result;
}

class PixelReader {
public:
    PixelReader(std::string_view bytes, const std::string& place) : bytes_(bytes), place_(place) {}
    void read_line(std::vector<Rgbe>& line);

private:
    std::uint8_t next()
    {
        if (at_ >= bytes_.size())
            throw InputError{place_, "ends in the pixels of scan line " + std::to_string(line_),
                             "write the file again"};
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }
    Rgbe next_pixel()
    {
        const std::uint8_t r = next(), g = next(), b = next();
        return {r, g, b, next()};
    }
    void read_by_pixel(std::vector<Rgbe>& line, Rgbe first);
    void read_by_component(std::vector<Rgbe>& line);
    [[noreturn]] void refuse_run() const
    {
        throw InputError{place_, "a run passes the end of scan line " + std::to_string(line_),
                         "the file is damaged; write it again"};
    }

    std::string_view bytes_;
    const std::string& place_;
    std::size_t at_ = 0, line_ = 0;
};

/// Plain pixels; (1, 1, 1, n) repeats the pixel before n times, and directly following ones count in steps of 256.
void PixelReader::read_by_pixel(std::vector<Rgbe>& line, Rgbe first)
{
    std::size_t done = 0;
    unsigned shift = 0;
    for (Rgbe pixel = first;; pixel = next_pixel()) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : 0;
            if (done == 0 || shift >= 32 || count > line.size() - done)
                refuse_run();
            std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(done), count, Rgbe(line[done - 1]));
            done += count;
            shift += 8;
        } else {
            line[done++] = pixel;
            shift = 0;
        }
        if (done == line.size())
            return;
    }
}

void PixelReader::read_by_component(std::vector<Rgbe>& line)
{
    for (std::size_t component = 0; component < 4; ++component) {
        for (std::size_t done = 0; done < line.size();) {
            const unsigned code = next();
            const bool run = code > run_mark;
            const std::size_t count = run ? code - run_mark : code;
            if (count == 0 || count > line.size() - done)
                refuse_run();
            std::uint8_t value = run ? next() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i)
                line[done++][component] = run ? value : next();
        }
    }
}

void PixelReader::read_line(std::vector<Rgbe>& line)
{
    const Rgbe start = next_pixel();
    const bool packed = line.size() >= shortest_packed && line.size() <= longest_packed && start[0] == 2 &&
                        start[1] == 2 && start[2] < run_mark;
    if (packed && (std::size_t{start[2]} << 8 | start[3]) != line.size())
        throw InputError{place_,
                         "scan line " + std::to_string(line_) + " claims " +
                             std::to_string(std::size_t{start[2]} << 8 | start[3]) + " pixels, expected " +
                             std::to_string(line.size()),
                         "the file is damaged; write it again"};
    if (packed)
        read_by_component(line);
    else
        read_by_pixel(line, start);
    ++line_;
}

void append_component(std::string& out, const std::vector<Rgbe>& line, std::size_t component)
{
    const auto run_at = [&](std::size_t at) {
        std::size_t end = at + 1;
        while (end < line.size() && end - at < longest_run && line[end][component] == line[at][component])
            ++end;
        return end - at;
    };
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t begin = at;
        std::size_t run = run_at(at);
        while (run < shortest_run && at < line.size()) {
            at += run;
            run = at < line.size() ? run_at(at) : 0;
        }
        for (std::size_t i = begin; i < at;) {
            const std::size_t count = std::min(longest_literal, at - i);
            out += static_cast<char>(count);
            for (const std::size_t end = i + count; i < end; ++i)
                out += static_cast<char>(line[i][component]);
        }
        if (run >= shortest_run) {
            out += static_cast<char>(run_mark + run);
            out += static_cast<char>(line[at][component]);
            at += run;
        }
    }
}

void append_line(std::string& out, const std::vector<Rgbe>& line)
{
    if (line.size() < shortest_packed || line.size() > longest_packed) {
        for (const Rgbe& pixel : line)
            out.append(pixel.begin(), pixel.end());
        return;
    }
    out += {2, 2, static_cast<char>(line.size() >> 8), static_cast<char>(line.size() & 0xff)};
    for (std::size_t component = 0; component < 4; ++component)
        append_component(out, line, component);
}

const std::vector<float>& colour_channel(const Picture& picture, const char* name, const std::string& place)
{
    const auto found = picture.channels.find(name);
    if (found == picture.channels.end())
        throw InputError{place, std::string("picture to be written has no channel ") + name,
                         "a Radiance picture holds R, G and B; write .exr for other channels"};
    return found->second;
}

} // namespace

std::array<std::uint8_t, 4> encode_rgbe(float r, float g, float b) noexcept
{
    // fmax passes over NaN; what is not finite becomes the brightest that the format can hold.
    const float brightest = std::fmax(r, std::fmax(g, b));
    if (!(brightest >= darkest))
        return {0, 0, 0, 0};
    int exponent = 0;
    std::frexp(brightest, &exponent);
    exponent = std::isfinite(brightest) ? std::min(exponent, 255 - exponent_bias) : 255 - exponent_bias;
    const auto mantissa = [&](float c) {
        const double scaled = std::ldexp(static_cast<double>(c), 8 - exponent);
        return static_cast<std::uint8_t>(scaled > 0 ? std::min(scaled, 255.0) : 0.0);
    };
    return {mantissa(r), mantissa(g), mantissa(b), static_cast<std::uint8_t>(exponent + exponent_bias)};
}

std::array<float, 3> decode_rgbe(std::array<std::uint8_t, 4> bytes) noexcept
{
    if (bytes[3] == 0)
        return {0, 0, 0};
    const double step = std::ldexp(1.0, int{bytes[3]} - exponent_bias - 8);
    const auto value = [&](std::uint8_t mantissa) { return static_cast<float>((mantissa + 0.5) * step); };
    return {value(bytes[0]), value(bytes[1]), value(bytes[2])};
}

void write_rgbe(const Picture& picture, const std::filesystem::path& file)
{
    const std::string place = file.string();
    check_picture(place, picture);
    const std::array channels{&colour_channel(picture, "R", place), &colour_channel(picture, "G", place),
                              &colour_channel(picture, "B", place)};
    const RgbeHeaderText header = rgbe_header_of(picture, place);
    std::string out =
        header.text + "-Y " + std::to_string(picture.height) + " +X " + std::to_string(picture.width) + "\n";
    std::vector<Rgbe> line(static_cast<std::size_t>(picture.width));
    for (std::size_t start = 0; start < channels[0]->size(); start += line.size()) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            std::array<float, 3> pixel{};
            for (std::size_t c = 0; c < 3; ++c)
                pixel[c] = static_cast<float>(static_cast<double>((*channels[c])[start + i]) * header.factors[c]);
            line[i] = encode_rgbe(pixel[0], pixel[1], pixel[2]);
        }
        append_line(out, line);
    }
    write_text_atomically(file, out);
}

Picture read_rgbe(const std::filesystem::path& file)
{
    const std::string place = file.string();
    const MappedFile mapped(file);
    const std::string_view bytes = mapped.bytes();
    // The header ends with an empty line, which may be the first line of all.
    const std::size_t header_end = bytes.starts_with('\n') ? 0 : bytes.find("\n\n");
    const std::string_view lines = bytes.substr(0, header_end);
    if (header_end == std::string_view::npos || lines.find('\0') != std::string_view::npos)
        throw InputError{place, "is not a Radiance picture",
                         "expected text lines, an empty line, and a resolution line"};
    const RgbeHeader header = parse_rgbe_header(lines, place);
    if (!header.format.empty() && header.format != "32-bit_rle_rgbe")
        throw InputError{place, "format is " + header.format + ", expected 32-bit_rle_rgbe",
                         "convert it (ra_xyze -r makes RGBE of XYZE)"};
    const std::string_view rest = bytes.substr(header_end + (header_end == 0 ? 1 : 2));
    const std::string_view resolution_line = rest.substr(0, rest.find('\n'));
    const Resolution resolution = parse_resolution(resolution_line, place);
    check_picture_size(place, resolution.width, resolution.height, 3, bytes.size());

    Picture picture{static_cast<int>(resolution.width), static_cast<int>(resolution.height), {}, header.variables};
    if (!header.history.empty())
        picture.header["history"] = header.history;
    const std::array channels{&picture.add_channel("R"), &picture.add_channel("G"), &picture.add_channel("B")};
    PixelReader reader(rest.substr(std::min(rest.size(), resolution_line.size() + 1)), place);
    std::vector<Rgbe> line(static_cast<std::size_t>(resolution.length()));
    for (std::int64_t i = 0; i < resolution.lines(); ++i) {
        reader.read_line(line);
        for (std::int64_t k = 0; k < resolution.length(); ++k) {
            const std::array<float, 3> pixel = decode_rgbe(line[static_cast<std::size_t>(k)]);
            for (std::size_t c = 0; c < 3; ++c)
                (*channels[c])[resolution.index(i, k)] =
                    static_cast<float>(static_cast<double>(pixel[c]) / header.factors[c]);
        }
    }
    return picture;
}

} // namespace lightwell
