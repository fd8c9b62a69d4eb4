#include "engine/base/text.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/picture_stream.h"
#include "plugins/commands/radiance_settings.h"
#include "plugins/commands/records.h"
#include "plugins/commands/scene_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <ostream>

namespace lightwell::commands {
namespace {

enum class Kind { text, integers, bytes, words, floats, doubles };

struct Wish {
    bool unique = false, original = false, header = true, size = true, positions = true, brightness = false;
    bool reversed = false, interleaved = true, backwards = false;
    char primary = 0;
    Kind kind = Kind::text;
    double exposure = 1, gamma = 1;
    int columns = 0, rows = 0;
    std::string file;
};

bool read_flag(const std::string& word, Wish& wish)
{
    const bool minus = word[0] == '-';
    if (word.size() != 2)
        return false;
    switch (word[1]) {
    case 'u':
        return wish.unique = minus, true;
    case 'o':
        return wish.original = minus, true;
    case 'h':
        return wish.header = !minus, true;
    case 'H':
        return wish.size = !minus, true;
    case 'b':
        return wish.brightness = minus, true;
    case 'R':
        return wish.reversed = minus, true;
    case 'n':
        return wish.interleaved = !minus, true;
    case 'r':
        return wish.backwards = minus, true;
    default:
        return false;
    }
}

void read_kind(const std::string& word, Wish& wish)
{
    static constexpr std::pair<char, Kind> kinds[] = {{'a', Kind::text},  {'i', Kind::integers}, {'b', Kind::bytes},
                                                      {'w', Kind::words}, {'f', Kind::floats},   {'d', Kind::doubles}};
    const char letter = word.size() > 2 ? word[2] : 'a';
    const auto* kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.first == letter; });
    if (kind == std::end(kinds) || word.size() > 3)
        throw Fatal("command line error at '" + word + "'");
    wish.kind = kind->second;
    wish.positions = word[0] == '+';
}

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    OptionReader reader(words);
    while (reader.more() && reader.peek().size() > 1 && (reader.peek()[0] == '-' || reader.peek()[0] == '+')) {
        const std::string word = reader.take();
        if (read_flag(word, wish))
            continue;
        const char option = word[1];
        if (option == 'd')
            read_kind(word, wish);
        else if (option == 'e' && word.size() == 2)
            wish.exposure = reader.number(word);
        else if (option == 'g' && word.size() == 2)
            wish.gamma = reader.number(word);
        else if (option == 'p' && word.size() == 3 &&
                 std::string_view("RGBrgb").find(word[2]) != std::string_view::npos)
            wish.primary = static_cast<char>(std::toupper(word[2]));
        else if ((option == 'y' || option == 'Y') && word.size() == 2)
            wish.rows = reader.integer(word);
        else if ((option == 'x' || option == 'X') && word.size() == 2)
            wish.columns = reader.integer(word);
        else
            throw Fatal("command line error at '" + word + "'");
    }
    if (reader.more())
        wish.file = reader.take();
    if (reader.more())
        throw Fatal("command line error at '" + reader.take() + "'");
    if (!(wish.gamma > 0) || !(wish.exposure > 0))
        throw Fatal("exposure and gamma must be positive");
    return wish;
}

/// The factor between the numbers in the file and radiance.
double exposure_of(const Picture& picture)
{
    const auto found = picture.header.find("EXPOSURE");
    return found == picture.header.end() ? 1 : parse_double(trimmed(found->second)).value_or(1);
}

class PixelText {
public:
    PixelText(const Wish& wish, const Picture& picture, std::ostream& out)
        : wish_(wish), picture_(picture), out_(out), factor_((wish.original ? 1 : exposure_of(picture)) * wish.exposure)
    {
        channels_ = wish.reversed ? "BGR" : "RGB";
        if (wish.primary != 0)
            channels_ = std::string(1, wish.primary);
    }

    void write()
    {
        if (wish_.interleaved || wish_.brightness || channels_.size() == 1)
            return write_plane(channels_);
        for (const char channel : channels_)
            write_plane(std::string(1, channel));
    }

private:
    void write_plane(const std::string& channels)
    {
        std::vector<double> last;
        for (int y = 0; y < picture_.height; ++y)
            for (int x = 0; x < picture_.width; ++x) {
                std::vector<double> values;
                if (wish_.brightness)
                    values.push_back(value("brightness", x, y));
                else
                    for (const char channel : channels)
                        values.push_back(value(std::string(1, channel), x, y));
                if (wish_.unique && values == last)
                    continue;
                write_pixel(x, picture_.height - 1 - y, values);
                last = std::move(values);
            }
    }

    double value(const std::string& channel, int x, int y) const
    {
        const double linear = channel == "brightness"
                                  ? photopic({picture_.at("R", x, y), picture_.at("G", x, y), picture_.at("B", x, y)})
                                  : static_cast<double>(picture_.at(channel, x, y));
        return wish_.gamma == 1 ? linear * factor_ : std::pow(linear * factor_, 1 / wish_.gamma);
    }

    void write_pixel(int x, int y, const std::vector<double>& values)
    {
        const bool is_text = wish_.kind == Kind::text || wish_.kind == Kind::integers;
        if (is_text && wish_.positions)
            out_ << fmt::format("{:7} {:7}", x, y);
        for (std::size_t i = 0; i < values.size(); ++i)
            write_value(values[i], i);
        if (is_text)
            out_ << '\n';
    }

    template <class T>
    void binary(T value)
    {
        out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void write_value(double value, std::size_t index)
    {
        switch (wish_.kind) {
        case Kind::text:
            out_ << fmt::format(" {:15.3e}", value);
            break;
        case Kind::integers:
            out_ << (index > 0 || wish_.positions ? " " : "") << static_cast<int>(std::clamp(value * 256, 0.0, 1e9));
            break;
        case Kind::bytes:
            binary(static_cast<std::uint8_t>(std::clamp(value * 256, 0.0, 255.0)));
            break;
        case Kind::words:
            binary(static_cast<std::uint16_t>(std::clamp(value * 65536, 0.0, 65535.0)));
            break;
        case Kind::floats:
            binary(static_cast<float>(value));
            break;
        case Kind::doubles:
            binary(value);
        }
    }

    const Wish& wish_;
    const Picture& picture_;
    std::ostream& out_;
    double factor_;
    std::string channels_;
};

std::string format_of(Kind kind)
{
    static constexpr const char* names[] = {"ascii", "ascii", "byte", "16-bit", "float", "double"};
    return names[static_cast<int>(kind)];
}

void forward(const std::vector<std::string>& words, const Wish& wish, const Streams& streams)
{
    std::string bytes;
    const Picture picture = read_picture(wish.file, streams.in, bytes);
    if (wish.header) {
        const std::size_t end = bytes.find("\n\n");
        for (const std::string_view line : split(std::string_view(bytes).substr(0, end), "\n"))
            if (!line.starts_with("FORMAT="))
                streams.out << line << '\n';
        streams.out << command_line_of(words) << "\nFORMAT=" << format_of(wish.kind) << "\n\n";
    }
    if (wish.size)
        streams.out << fmt::format("-Y {:8} +X {:8}\n", picture.height, picture.width);
    PixelText(wish, picture, streams.out).write();
}

/// The numbers of a picture, back to a picture.
void backward(const std::vector<std::string>& words, const Wish& asked, const Streams& streams)
{
    Wish wish = asked;
    std::string line, history;
    while (wish.header && std::getline(streams.in, line) && !line.empty())
        if (line.rfind("#?", 0) != 0 && line.rfind("FORMAT=", 0) != 0)
            history += line + '\n';
    if (wish.size && wish.rows == 0 && std::getline(streams.in, line)) {
        const auto size = split(line);
        if (size.size() != 4 || size[0] != "-Y" || size[2] != "+X")
            throw Fatal("bad resolution line \"" + line.substr(0, 40) + "\", expected -Y rows +X columns");
        wish.rows = static_cast<int>(parse_integer(size[1]).value_or(0));
        wish.columns = static_cast<int>(parse_integer(size[3]).value_or(0));
    }
    constexpr int most = 1 << 15;
    if (wish.rows < 1 || wish.columns < 1 || wish.rows > most || wish.columns > most)
        throw Fatal("the size of the picture is not known; give -y rows +x columns");
    if (wish.kind != Kind::text && wish.kind != Kind::floats && wish.kind != Kind::doubles)
        throw Fatal("pictures are made of text (-da), float (-df) or double (-dd) values");
    const NumberFormat format = wish.kind == Kind::text     ? NumberFormat::text
                                : wish.kind == Kind::floats ? NumberFormat::floats
                                                            : NumberFormat::doubles;
    NumberInput in(streams.in, format);
    Picture picture{wish.columns, wish.rows, {}, {{"history", history + command_line_of(words) + '\n'}}};
    for (const char* channel : {"R", "G", "B"})
        picture.add_channel(channel);
    const auto next = [&] {
        const auto value = in.next();
        if (!value)
            throw Fatal("the input ends before the picture does");
        return static_cast<float>(*value * wish.exposure);
    };
    for (std::size_t i = 0; i < picture.channels.at("R").size(); ++i) {
        if (wish.kind == Kind::text && wish.positions)
            next(), next();
        const float first = next(), second = wish.brightness ? first : next(), third = wish.brightness ? first : next();
        picture.channels.at("R")[i] = wish.reversed ? third : first;
        picture.channels.at("G")[i] = second;
        picture.channels.at("B")[i] = wish.reversed ? first : third;
    }
    write_picture(picture, streams.out);
}

} // namespace

/// pvalue: the numbers of a Radiance picture, and back.
int pvalue(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    if (!wish.backwards)
        forward(words, wish, streams);
    else if (wish.file.empty())
        backward(words, wish, streams);
    else
        throw Fatal("-r reads the standard input");
    return 0;
}

} // namespace lightwell::commands
