#include "plugins/commands/view_options.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "plugins/commands/command.h"
#include "plugins/commands/library_path.h"

#include <algorithm>
#include <cmath>

namespace lightwell::commands {
namespace {

/// The last view of a file: lines that begin with VIEW=, or a program's name and view words.
std::string view_words_of_file(const std::string& name)
{
    const auto file = find_in_library(name);
    if (!file)
        throw Fatal("cannot open view file \"" + name + "\"");
    const MappedFile mapped(*file);
    std::string words;
    for (const std::string_view line : split(mapped.bytes(), "\r\n")) {
        const std::size_t option = line.find(" -v");
        if (option != std::string_view::npos || line.starts_with("-v"))
            words = line.substr(option == std::string_view::npos ? 0 : option);
    }
    if (words.empty())
        throw Fatal("bad view file \"" + name + "\"");
    return words;
}

int values_of(const std::string& word)
{
    if (word.size() == 4 && word[2] == 't')
        return 0;
    if (word == "-vp" || word == "-vd" || word == "-vu")
        return 3;
    static constexpr std::string_view single = "hvoasl";
    return word.size() == 3 && single.find(word[2]) != std::string_view::npos ? 1 : -1;
}

} // namespace

bool ViewOptions::read(OptionReader& reader)
{
    const std::string word = reader.peek();
    if (word == "-x" || word == "-y") {
        reader.take();
        int& size = word == "-x" ? columns : rows;
        size = reader.integer(word);
        constexpr int most = 1 << 15;
        if (size < 1 || size > most)
            throw Fatal("command line error at '" + word + "'");
        return true;
    }
    if (word == "-pa") {
        reader.take();
        pixel_aspect = reader.number(word);
        return true;
    }
    if (word == "-pd") {
        reader.take();
        words += " -pd " + reader.value(word);
        return true;
    }
    if (word == "-vf") {
        reader.take();
        words += ' ' + view_words_of_file(reader.value(word));
        return true;
    }
    const int values = word.rfind("-v", 0) == 0 ? values_of(word) : -1;
    if (values < 0)
        return false;
    words += ' ' + reader.take();
    for (int i = 0; i < values; ++i)
        words += ' ' + shortest(reader.number(word));
    return true;
}

View ViewOptions::view() const
{
    View view = words.empty() ? View{} : parse_view(words, "view");
    constexpr double parallel = 1e-9;
    if (!(length(view.direction) > 0) || !(length(view.up) > 0))
        throw Fatal("zero view direction or view up");
    if (!(length(cross(normalized(view.direction), normalized(view.up))) > parallel))
        throw Fatal("view up parallel to view direction");
    return view;
}

void ViewOptions::fit(const View& view)
{
    if (!(pixel_aspect > 0))
        return;
    const double height_over_width = 1 / Camera(view).aspect();
    if (height_over_width * columns > pixel_aspect * rows)
        columns = std::max(1, static_cast<int>(rows / height_over_width * pixel_aspect + 0.5));
    else
        rows = std::max(1, static_cast<int>(height_over_width * columns / pixel_aspect + 0.5));
}

} // namespace lightwell::commands
