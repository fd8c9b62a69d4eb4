#include "materials/patterns/pattern_reader.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "materials/patterns/channels.h"
#include "materials/patterns/spectral_colour.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// How the words of a type are laid out, from left to right.
struct Form {
    std::string_view type;
    std::size_t values; ///< functions that give the values: one or three
    enum class Source { formula, data, picture, letters, spectrum, spectral_data, spectral_formula } source;
};
constexpr Form forms[] = {
    {"colorfunc", 3, Form::Source::formula},
    {"brightfunc", 1, Form::Source::formula},
    {"texfunc", 3, Form::Source::formula},
    {"mixfunc", 1, Form::Source::formula},
    {"colordata", 3, Form::Source::data},
    {"brightdata", 1, Form::Source::data},
    {"texdata", 3, Form::Source::data},
    {"mixdata", 1, Form::Source::data},
    {"colorpict", 3, Form::Source::picture},
    {"mixpict", 1, Form::Source::picture},
    {"texpict", 3, Form::Source::picture},
    {"specpict", 1, Form::Source::picture},
    {"colortext", 3, Form::Source::letters},
    {"brighttext", 1, Form::Source::letters},
    {"mixtext", 0, Form::Source::letters},
    {"spectrum", 0, Form::Source::spectrum},
    {"specfile", 0, Form::Source::spectral_data},
    {"specdata", 1, Form::Source::spectral_data},
    {"specfunc", 1, Form::Source::spectral_formula},
};

const Form* form_of(std::string_view type) noexcept
{
    const auto* found = std::find_if(std::begin(forms), std::end(forms), [&](const Form& f) { return f.type == type; });
    return found == std::end(forms) ? nullptr : found;
}

/// How the words of a material are laid out: v a value at the place, l a function of the direction to the light, n the
/// name of a modifier, t a file of measured scattering, d a function of a data file and that file; after the function
/// file, c the coordinates of the data.
struct MaterialForm {
    std::string_view type, words;
};
constexpr MaterialForm material_forms[] = {
    {"plastic2", "vvv."},       {"metal2", "vvv."},
    {"trans2", "vvv."},         {"ashik2", "vvv."},
    {"plasfunc", "l."},         {"metfunc", "l."},
    {"transfunc", "l."},        {"plasdata", "d.c"},
    {"metdata", "d.c"},         {"transdata", "d.c"},
    {"BRTDfunc", "vvvvvvlll."}, {"BSDF", "vtvvv."},
    {"aBSDF", "tvvv."},         {"WGMDfunc", "nvvvnvvvnvvv."},
    {"prism1", "vvvv."},        {"prism2", "vvvvvvvv."},
};

const MaterialForm* material_form_of(std::string_view type) noexcept
{
    const auto* found = std::find_if(std::begin(material_forms), std::end(material_forms),
                                     [&](const MaterialForm& f) { return f.type == type; });
    return found == std::end(material_forms) ? nullptr : found;
}

/// What stands at a path, made once.
template <class T, class Make>
std::shared_ptr<const T> kept(std::map<fs::path, std::shared_ptr<const T>>& all, const fs::path& path, const Make& make)
{
    std::shared_ptr<const T>& entry = all[path];
    if (entry == nullptr)
        entry = std::make_shared<const T>(make());
    return entry;
}

constexpr std::string_view no_file = ".";

std::string call_of(std::string function, std::size_t channel)
{
    return function.append("(").append(channel_word(channel)).append(")");
}

} // namespace

/// One pattern on its way.
class PatternReader::Build {
public:
    Build(PatternReader& reader, const Request& request) : reader_(reader), request_(request) {}

    std::shared_ptr<const PlaceFunction> pattern()
    {
        const Form* form = form_of(request_.type);
        if (form == nullptr)
            throw InputError{request_.place, "type " + request_.type + " is no pattern that is read"};
        text_ = {request_.type, {}, request_.numbers, {}, {}, {}};
        PlaceFunction::What what = of_form(*form);
        text_.words.assign(request_.words.begin(), request_.words.begin() + static_cast<std::ptrdiff_t>(next_));
        const Affine to_scene =
            next_ < request_.words.size() ? request_.read_transform(request_.words, next_) : Affine{};
        return std::make_shared<const PlaceFunction>(std::move(what), to_scene, std::move(text_));
    }

    MaterialWords material()
    {
        const MaterialForm* form = material_form_of(request_.type);
        if (form == nullptr)
            throw InputError{request_.place, "type " + request_.type + " is no material with functions"};
        of_material_ = true;
        text_ = {request_.type, {}, request_.numbers, {}, {}, {}};
        MaterialWords read;
        std::vector<std::string> at_place, functions, coordinates;
        std::shared_ptr<const DataTable> table;
        std::string context;
        for (const char kind : form->words) {
            if (kind == 'v')
                at_place.push_back(word("a formula"));
            else if (kind == 'l' || kind == 'd')
                functions.push_back(word("the name of a function"));
            else if (kind == 'n')
                read.names.push_back(word("the name of a modifier"));
            else if (kind == 't')
                read.table = file("file of measured scattering");
            else if (kind == '.')
                context = function_file();
            else
                coordinates = words(table->dimensions(), "a coordinate");
            if (kind == 'd')
                table = data(0);
        }
        for (std::string& coordinate : coordinates)
            coordinate = towards_light(coordinate, context);
        for (std::string& function : functions)
            function = table != nullptr ? call_of(function, value_channel) : towards_light(function, context);
        PlaceProgram::What what{compile(at_place, context), compile(functions, context), table,
                                compile(coordinates, context)};
        text_.words.assign(request_.words.begin(), request_.words.begin() + static_cast<std::ptrdiff_t>(next_));
        const Affine to_scene =
            next_ < request_.words.size() ? request_.read_transform(request_.words, next_) : Affine{};
        read.functions = std::make_shared<const PlaceProgram>(std::move(what), to_scene, std::move(text_));
        return read;
    }

private:
    using Source = Form::Source;

    /// A function of the direction, called with it; anything else as it stands. A fourth argument, the size of the
    /// light, is 0: lamps are sampled point by point.
    std::string towards_light(const std::string& text, const std::string& context) const
    {
        const Definition* found = definitions_->find(text, context.empty() ? "" : '`' + context);
        if (found == nullptr || found->parameters.empty())
            return text;
        std::string call = text + '(';
        for (std::size_t i = 0; i < found->parameters.size(); ++i)
            call.append(i > 0 ? "," : "").append(i < 3 ? channel_word(light_channel + i) : "0");
        return call.append(")");
    }

    PlaceFunction::What of_form(const Form& form)
    {
        switch (form.source) {
        case Source::formula: {
            const std::vector<std::string> formulas = words(form.values, "a formula");
            const std::string context = function_file();
            return PlaceFunction::Formula{compile(formulas, context)};
        }
        case Source::letters:
            return letters(form.values);
        case Source::spectrum:
            return spectrum();
        case Source::spectral_data:
            return spectral_data(form.values > 0);
        case Source::spectral_formula:
            return spectral_formula();
        default:
            return table(form);
        }
    }
    /// First and last wavelength, then values at even distances.
    PlaceFunction::What spectrum()
    {
        const std::vector<double>& n = request_.numbers;
        constexpr std::size_t least = 4;
        if (n.size() < least || n[0] == n[1])
            throw InputError{request_.place, std::to_string(n.size()) + " numbers make no spectrum",
                             "they are the first and the last wavelength in nm and at least two values"};
        return PlaceFunction::Constant{colour_of_bands(n[0], n[1], {n.begin() + 2, n.end()})};
    }
    /// Each value holds for a band around its wavelength, half a step beyond both ends too.
    static Spectrum colour_of_bands(double first_nm, double last_nm, const std::vector<double>& values)
    {
        const double last = static_cast<double>(values.size() - 1);
        return spectral_colour([&](double nm) {
            const double band = std::floor((nm - first_nm) / (last_nm - first_nm) * last + 0.5);
            return band >= 0 && band <= last ? values[static_cast<std::size_t>(band)] : 0;
        });
    }
    static Spectrum colour_of(const DataTable& table)
    {
        const double low = std::min(table.axes()[0].first, table.axes()[0].last);
        const double high = std::max(table.axes()[0].first, table.axes()[0].last);
        return spectral_colour([&](double nm) { return nm >= low && nm <= high ? table.at(&nm) : 0; });
    }
    /// A file over wavelength; or a function, a file whose last dimension is the wavelength, and the other coordinates.
    PlaceFunction::What spectral_data(bool with_coordinates)
    {
        const std::vector<std::string> function = words(with_coordinates ? 1 : 0, "the name of a function");
        const auto table = data(0);
        if (!with_coordinates) {
            if (table->dimensions() != 1)
                throw InputError{request_.place, "the data file has " + std::to_string(table->dimensions()) +
                                                     " dimensions, expected the wavelength alone"};
            const DataTable::Dimension& axis = table->axes().front();
            if (axis.coordinates.empty() && axis.first != axis.last && axis.count > 1)
                return PlaceFunction::Constant{colour_of_bands(axis.first, axis.last, table->values())};
            return PlaceFunction::Constant{colour_of(*table)};
        }
        const std::string context = function_file();
        Program coordinates = compile(words(table->dimensions() - 1, "a coordinate"), context);
        const DataTable::Dimension& axis = table->axes().back();
        return PlaceFunction::Spectral{std::move(coordinates), table,
                                       compile({call_of(function[0], value_channel)}, context),
                                       std::min(axis.first, axis.last), std::max(axis.first, axis.last)};
    }
    PlaceFunction::What spectral_formula()
    {
        const std::string function = word("the name of a function");
        const std::string context = function_file();
        const std::vector<double>& n = request_.numbers;
        if (n.size() < 2)
            throw InputError{request_.place, "no range of wavelengths", "the first two numbers are its ends in nm"};
        return PlaceFunction::Spectral{no_program(), nullptr, compile({call_of(function, wavelength_channel)}, context),
                                       std::min(n[0], n[1]), std::max(n[0], n[1])};
    }
    PlaceFunction::What table(const Form& form)
    {
        PlaceFunction::Table table = {no_program(), {}, nullptr, no_program()};
        std::vector<std::string> functions = words(form.values, "the name of a function");
        std::size_t dimensions = 2;
        if (form.source == Source::picture) {
            table.picture = picture(form.type == "texpict");
        } else {
            for (std::size_t i = 0; i < form.values; ++i)
                table.data.push_back(data(i));
            dimensions = table.data.front()->dimensions();
        }
        const std::string context = function_file();
        table.coordinates = compile(words(dimensions, "a coordinate"), context);
        // The one function of a picture of spectra is of each channel.
        if (form.type == "specpict")
            functions.resize(3, functions.front());
        table.values = of_table_values(functions, form.source == Source::picture ? 3 : form.values, context);
        return table;
    }
    /// @param stored  the numbers of the file mean no colours
    std::shared_ptr<const PictureTable> picture(bool stored)
    {
        if (const auto& given = request_.picture; given != nullptr) {
            word("a picture");
            if (given->file.empty())
                text_.made.emplace_back(next_ - 1, given->contents);
            else
                text_.files.emplace_back(next_ - 1, given->file);
            text_.contents += given->identity;
            return given->table;
        }
        const fs::path path = file("a picture");
        const MappedFile mapped(path);
        text_.contents += std::to_string(std::hash<std::string_view>{}(mapped.bytes())); // pictures change too
        return stored ? kept(reader_.stored_pictures_, path, [&] { return PictureTable::read_stored(path); })
                      : kept(reader_.pictures_, path, [&] { return PictureTable::read(path); });
    }
    std::shared_ptr<const DataTable> data(std::size_t which)
    {
        const fs::path path = file("a data file");
        const auto table =
            kept(reader_.tables_, path, [&] { return DataTable::parse(*contents(path), path.string()); });
        if (which > 0 && table->dimensions() != first_dimensions_)
            throw InputError{request_.place, path.string() + " has " + std::to_string(table->dimensions()) +
                                                 " dimensions, the file before it " +
                                                 std::to_string(first_dimensions_)};
        first_dimensions_ = table->dimensions();
        return table;
    }
    /// Functions of one value get their own table's; those of three get all.
    Program of_table_values(const std::vector<std::string>& functions, std::size_t tables, const std::string& context)
    {
        std::vector<std::string> calls;
        for (std::size_t i = 0; i < functions.size(); ++i) {
            const Definition* found = definitions_->find(functions[i], context.empty() ? "" : '`' + context);
            const bool of_all = found != nullptr && found->parameters.size() >= 3 && tables == 3;
            std::string call = functions[i];
            call.append("(").append(channel_word(value_channel + (of_all || tables == 1 ? 0 : i)));
            for (std::size_t further = 1; of_all && further < tables; ++further)
                call.append(",").append(channel_word(value_channel + further));
            calls.push_back(call.append(")"));
        }
        return compile(calls, context);
    }
    PlaceFunction::What letters(std::size_t values)
    {
        const auto font = this->font();
        const std::vector<std::string> lines = text_lines();
        const std::size_t colours = 2 * values, needed = 9 + colours;
        const std::vector<double>& n = request_.numbers;
        if (n.size() < needed || n.size() > needed + 1)
            throw InputError{request_.place,
                             std::to_string(n.size()) + " numbers, expected " + std::to_string(needed) + " or " +
                                 std::to_string(needed + 1),
                             "they are the upper left corner, the vector of one character to the right and that of one "
                             "line down, then the colours of letters and ground, and the spacing if there is one"};
        const auto vector = [&](std::size_t i) { return Vec3{n[i], n[i + 1], n[i + 2]}; };
        const Lettering::Layout layout{vector(0), vector(3), vector(6), n.size() > needed ? n[needed] : 0};
        const auto colour = [&](std::size_t which) {
            const std::size_t at = 9 + which * values;
            return values == 0   ? Spectrum::grey(which == 0 ? 1 : 0)
                   : values == 1 ? Spectrum::grey(n[at])
                                 : Spectrum{n[at], n[at + 1], n[at + 2]};
        };
        return PlaceFunction::Letters{Lettering(font, lines, layout, request_.place), colour(0), colour(1)};
    }
    std::shared_ptr<const PolygonFont> font()
    {
        const std::string name = word("a font");
        const auto path = request_.find_file(name);
        if (!path)
            return {std::shared_ptr<void>(), &PolygonFont::own()};
        note_file(next_ - 1, *path);
        return kept(reader_.fonts_, *path, [&] { return PolygonFont::parse(*contents(*path), path->string()); });
    }
    /// The words behind a `.`, or the lines of a file.
    std::vector<std::string> text_lines()
    {
        std::vector<std::string> lines;
        if (next_ < request_.words.size() && request_.words[next_] != no_file) {
            const auto text = contents(file("a text file"));
            for (std::size_t begin = 0; begin < text->size();) {
                const std::size_t end = std::min(text->find('\n', begin), text->size());
                lines.push_back(text->substr(begin, end - begin));
                begin = end + 1;
            }
            return lines;
        }
        word("a text file, or . and words");
        lines.emplace_back();
        for (; next_ < request_.words.size(); ++next_)
            lines[0] += (lines[0].empty() ? "" : " ") + request_.words[next_];
        return lines;
    }

    std::string word(const char* meaning)
    {
        if (next_ == request_.words.size())
            throw InputError{request_.place, std::string("the words end before ") + meaning,
                             "check the count of the words"};
        return request_.words[next_++];
    }
    std::vector<std::string> words(std::size_t count, const char* meaning)
    {
        std::vector<std::string> found;
        while (found.size() < count)
            found.push_back(word(meaning));
        return found;
    }
    void note_file(std::size_t at, const fs::path& path) { text_.files.emplace_back(at, path.string()); }
    fs::path file(const char* meaning)
    {
        const std::string name = word(meaning);
        const auto path = request_.find_file(name);
        if (!path)
            throw InputError{request_.place, std::string(meaning) + " \"" + name + "\" is not found",
                             "put it beside the scene, into the working folder or on RAYPATH"};
        note_file(next_ - 1, *path);
        return *path;
    }
    std::shared_ptr<const std::string> contents(const fs::path& path)
    {
        const auto text = kept(reader_.texts_, path, [&] { return std::string(MappedFile(path).bytes()); });
        text_.contents += *text;
        return text;
    }
    /// Reads the function file that the next word names.
    /// @return its context
    std::string function_file()
    {
        const std::string name = word("a function file");
        if (name == no_file) {
            definitions_ = definitions("", "", {});
            return {};
        }
        const std::string context = fs::path(name).stem().string();
        if (const auto path = request_.find_file(name)) {
            note_file(next_ - 1, *path);
            definitions_ = definitions(context, path->string(), *contents(*path));
        } else if (const std::string_view* text = standard_function_file(name)) {
            definitions_ = definitions(context, name, *text);
        } else {
            throw InputError{request_.place, "function file \"" + name + "\" is not found",
                             "put it beside the scene, into the working folder or on RAYPATH"};
        }
        return context;
    }
    std::shared_ptr<const Definitions> definitions(const std::string& context, const std::string& file,
                                                   std::string_view text)
    {
        std::shared_ptr<const Definitions>& entry =
            reader_.definitions_[std::string(of_material_ ? "material " : "").append(file)];
        if (entry == nullptr) {
            auto made = std::make_shared<Definitions>(standard_definitions(of_material_));
            if (!file.empty())
                made->add(text, file, context);
            entry = std::move(made);
        }
        return entry;
    }
    Program compile(const std::vector<std::string>& expressions, const std::string& context)
    {
        return Program::compile(*definitions_, expressions, context, request_.numbers, request_.place);
    }
    static Program no_program() { return Program::compile({}, {}, "", {}, ""); }

    PatternReader& reader_;
    const Request& request_;
    PatternText text_;
    std::size_t next_ = 0, first_dimensions_ = 0;
    bool of_material_ = false;
    std::shared_ptr<const Definitions> definitions_;
};

std::shared_ptr<const PlaceFunction> PatternReader::read(const Request& request)
{
    return Build(*this, request).pattern();
}

bool PatternReader::knows(std::string_view type) noexcept
{
    return form_of(type) != nullptr;
}

PatternReader::MaterialWords PatternReader::read_material(const Request& request)
{
    return Build(*this, request).material();
}

bool PatternReader::knows_material(std::string_view type) noexcept
{
    return material_form_of(type) != nullptr;
}

} // namespace lightwell
