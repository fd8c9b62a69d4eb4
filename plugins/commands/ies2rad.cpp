#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "materials/photometry.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/ies_scene_text.h"
#include "plugins/commands/lamp_table.h"
#include "plugins/commands/library_path.h"
#include "plugins/commands/scene_files.h"

#include <cmath>
#include <fmt/format.h>
#include <ostream>

namespace lightwell::commands {
namespace {

namespace fs = std::filesystem;

struct Wish {
    fs::path library, prefix; ///< `-l`: where files are written; `-p`: a folder within, which scene text names too
    std::string output, lamp_table = "lamp.tab", lamp, units = "meters";
    double units_per_metre = 1, factor = 1;
    Spectrum colour{1, 1, 1};
    std::optional<double> illum_radius;
    bool to_output = false;
    std::vector<std::string> files;
};

/// Words of the command line one after the other; what is wrong ends the command in its own words.
class Options {
public:
    explicit Options(const std::vector<std::string>& words) : words_(words) {}
    bool at_option() const { return next_ < words_.size() && words_[next_].size() > 1 && words_[next_][0] == '-'; }
    const std::string& word(const std::string& option)
    {
        if (next_ == words_.size())
            throw Fatal("missing argument of option: " + option);
        return words_[next_++];
    }
    double number(const std::string& option, double least)
    {
        const std::string& text = word(option);
        const auto number = parse_double(text);
        if (!number || !(*number >= least && std::isfinite(*number)))
            throw Fatal("bad number in option " + option + ": \"" + text + '"');
        return *number;
    }
    std::vector<std::string> rest() const
    {
        return {words_.begin() + static_cast<std::ptrdiff_t>(next_), words_.end()};
    }

private:
    const std::vector<std::string>& words_;
    std::size_t next_ = 1;
};

/// `-dUNIT` or `-dUNIT/DIVISOR`.
void take_units(const std::string& option, Wish& wish)
{
    constexpr struct {
        char letter;
        const char* name;
        double per_metre;
    } units[] = {{'m', "meters", 1}, {'c', "centimeters", 100}, {'f', "feet", 1 / 0.3048}, {'i', "inches", 1 / 0.0254}};
    for (const auto& unit : units) {
        if (option.size() < 3 || option[2] != unit.letter)
            continue;
        wish.units = unit.name + option.substr(3);
        wish.units_per_metre = unit.per_metre;
        if (option.size() == 3)
            return;
        const auto divisor = option[3] == '/' ? parse_double(option.substr(4)) : std::nullopt;
        if (divisor && *divisor > 0 && std::isfinite(*divisor)) {
            wish.units_per_metre *= *divisor;
            return;
        }
    }
    throw Fatal("bad option: " + option);
}

void take_option(const std::string& option, Options& options, Wish& wish)
{
    if (option == "-l")
        wish.library = options.word(option);
    else if (option == "-p")
        wish.prefix = options.word(option);
    else if (option == "-o")
        wish.output = options.word(option);
    else if (option == "-f")
        wish.lamp_table = options.word(option);
    else if (option == "-t")
        wish.lamp = options.word(option);
    else if (option == "-m")
        wish.factor = options.number(option, 0);
    else if (option == "-i")
        wish.illum_radius = options.number(option, 1e-9);
    else if (option == "-s")
        wish.to_output = true;
    else if (option == "-c")
        wish.colour = {options.number(option, 0), options.number(option, 0), options.number(option, 0)};
    else if (option.rfind("-d", 0) == 0)
        take_units(option, wish);
    else if (option != "-g") // geometry in another language, which is not read here
        throw Fatal("bad option: " + option);
}

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    Options options(words);
    while (options.at_option()) {
        const std::string option = options.word("");
        take_option(option, options, wish);
    }
    wish.files = options.rest();
    if (wish.files.empty() && wish.output.empty())
        throw Fatal("missing output file specification");
    if (wish.files.size() > 1 && !wish.output.empty())
        throw Fatal("single input file required");
    return wish;
}

/// The colour of the lamp that `-t` or the file's label names, and a comment about it.
Spectrum lamp_colour(const IesFile& file, const std::string& source, const Wish& wish,
                     std::vector<std::string>& comments, std::ostream& err)
{
    if (wish.lamp == "default")
        return wish.colour;
    const auto table = LampTable::loaded(wish.lamp_table);
    if (!table) {
        err << wish.lamp_table << ": warning - no lamp data\n";
        return wish.colour;
    }
    if (!wish.lamp.empty()) {
        if (const auto kind = table->find(wish.lamp))
            return kind->colour();
        err << wish.lamp << ": warning - unknown lamp type\n";
        return wish.colour;
    }
    constexpr std::string_view keyword = "[LAMP]";
    for (const std::string& line : file.label) {
        const auto kind = line.rfind(keyword, 0) == 0 ? table->find(line.substr(keyword.size())) : std::nullopt;
        if (!kind)
            continue;
        comments.push_back(fmt::format("# CIE(x,y) = ({:f},{:f})", kind->x, kind->y));
        comments.push_back(fmt::format("# Depreciation = {:.1f}%", 100 * kind->depreciation));
        return kind->colour();
    }
    err << source << ": warning - no lamp type\n";
    comments.emplace_back("# Unknown lamp type (used default)");
    return wish.colour;
}

/// A text as standard input or a file holds it.
std::string text_of(const std::string& source, const Streams& streams)
{
    if (source.empty())
        return whole_stream(streams.in);
    if (!fs::is_regular_file(source))
        throw Fatal(source + ": No such file or directory");
    constexpr std::size_t most_bytes = 16 << 20; // the finest measurements take some hundred kilobytes
    const MappedFile mapped{source};
    if (mapped.bytes().size() > most_bytes)
        throw Fatal(source + ": is larger than 16 MB, expected a table of intensities");
    return std::string(mapped.bytes());
}

/// A table of tilts of its own file, and the name of the modifier made of it.
void take_tilt_table(const std::string& source, IesFile& file, IesWish& text)
{
    const std::string word = lowercase_ascii(file.tilt);
    if (word == "none")
        return;
    text.tilt_name = text.name;
    if (word != "include") {
        const fs::path table = fs::path(source).parent_path() / file.tilt;
        if (!fs::is_regular_file(table))
            throw Fatal(file.tilt + ": No such file or directory\n" + source + ": bad tilt data");
        read_tilt_table(MappedFile(table).bytes(), file.tilt, file);
        text.tilt_name = table.stem().string();
    }
    text.tilt_file = (fs::path(text.data_file).parent_path() / (text.tilt_name + "%.dat")).string();
    text.tilt_name += "_tilt";
}

/// Everything that one file becomes, before anything is written.
struct Made {
    std::string scene, data, tilt;
    fs::path scene_file, data_file, tilt_file;
};

Made made_of(const std::vector<std::string>& words, const std::string& source, const Wish& wish, const Streams& streams)
{
    Report report;
    const std::string whole = text_of(source, streams), shown = source.empty() ? "standard input" : source;
    if (!looks_like_ies(whole))
        throw Fatal(shown + ": not in IES format");
    IesFile file = read_ies_file(whole, shown, report);
    IesWish text;
    const fs::path output = wish.output.empty() ? fs::path(source).stem() : fs::path(wish.output);
    text.name = output.filename().string();
    text.data_file = (wish.prefix / (output.string() + ".dat")).string();
    text.comments.push_back("# " + command_line_of(words));
    text.comments.push_back("# Dimensions in " + wish.units);
    for (const std::string& line : file.label)
        text.comments.push_back("#<" + line);
    text.units_per_metre = wish.units_per_metre;
    text.illum_radius = wish.illum_radius;
    text.factor = wish.factor;
    text.colour = lamp_colour(file, shown, wish, text.comments, streams.err);
    take_tilt_table(source, file, text);
    const auto opening = wish.illum_radius ? std::nullopt : ies_opening(file);
    if (!opening && !wish.illum_radius)
        throw Fatal("dosource: illegal source dimensions\n" + shown + ": bad luminaire data");
    if (opening && !opening->replaced.empty())
        streams.err << "makeshape: shape is " << opening->replaced << ", which is not supported.\n"
                    << "makeshape: replaced with " << opening->replacement << '\n';
    write_warnings("ies2rad", report, streams.err);
    const fs::path folder = wish.library;
    return {ies_scene_text(file, opening, text),
            ies_data(file),
            text.tilt_name.empty() ? "" : ies_tilt_data(file),
            folder / wish.prefix / (output.string() + ".rad"),
            folder / text.data_file,
            folder / text.tilt_file};
}

/// The command without words that a file of the records repeats: the file's name is left out.
std::vector<std::string> without_files(const std::vector<std::string>& words, const Wish& wish)
{
    return {words.begin(), words.end() - static_cast<std::ptrdiff_t>(wish.files.size())};
}

} // namespace

/// ies2rad: photometric files in, a lamp as scene text and its intensities as a data file out.
int ies2rad(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    std::vector<std::string> sources = wish.files;
    if (sources.empty())
        sources.emplace_back(); // standard input
    for (const std::string& source : sources) {
        const Made made = made_of(without_files(words, wish), source, wish, streams);
        write_text_atomically(made.data_file, made.data);
        if (!made.tilt.empty())
            write_text_atomically(made.tilt_file, made.tilt);
        if (wish.to_output)
            streams.out << made.scene;
        else
            write_text_atomically(made.scene_file, made.scene);
    }
    return 0;
}

} // namespace lightwell::commands
