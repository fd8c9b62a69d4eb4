#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "materials/functions/program.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"
#include "plugins/commands/records.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <istream>
#include <ostream>

namespace lightwell::commands {
namespace {

/// Columns of a record, and channels behind them for what is known of it.
constexpr int most_columns = 256;
/// Those that `in(n)` can ask for: as many as `select` takes.
constexpr int most_asked = 63;
constexpr int count_channel = most_columns + 1, record_channel = most_columns + 2, output_channel = most_columns + 3;
constexpr int channels = output_channel;

struct Wish {
    char in = 'a', out = 'a';
    int in_count = 0;   ///< numbers in a binary record
    char separator = 0; ///< 0: blanks and tabs
    bool no_input = false, warnings = true, flush = false;
    long long most_in = -1, most_out = -1;
    std::string template_text; ///< of the output; empty: columns
    Definitions definitions;
    std::vector<std::string> files;
};

std::string file_text(const std::string& name)
{
    if (const auto found = find_in_library(name))
        return std::string(MappedFile(*found).bytes());
    if (const std::string_view* text = standard_function_file(name))
        return std::string(*text);
    throw Fatal(name + ": cannot open");
}

/// `-if6`, `-id`, `-of`, ...; false when the word is a format of another kind.
bool read_binary(const std::string& word, Wish& wish)
{
    if (word.size() < 3 || (word[2] != 'f' && word[2] != 'd'))
        return false;
    const std::string count = word.substr(3);
    if (word[1] == 'o') {
        wish.out = word[2];
        return count.empty();
    }
    const auto number = count.empty() ? std::optional<long long>(1) : parse_integer(count);
    if (!number || *number < 1 || *number > most_columns)
        throw Fatal("command line error at '" + word + "'");
    wish.in = word[2];
    wish.in_count = static_cast<int>(*number);
    return true;
}

/// What every definition may use.
void add_known(Definitions& definitions)
{
    std::string in = "in(n) = if(n - .5, select(n";
    for (int i = 1; i <= most_asked; ++i)
        in += fmt::format(", ${}", i);
    in += fmt::format("), ${});", count_channel);
    definitions.add(in + fmt::format(" recno = ${}; outno = ${};", record_channel, output_channel) +
                        " PI : 3.14159265358979323846;",
                    "rcalc");
}

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    add_known(wish.definitions);
    std::size_t i = 1;
    const auto value = [&](const std::string& option) -> const std::string& {
        if (++i >= words.size())
            throw Fatal("command line error at '" + option + "'");
        return words[i];
    };
    for (; i < words.size() && words[i].size() > 1 && words[i][0] == '-'; ++i) {
        const std::string word = words[i];
        if (word == "-e")
            wish.definitions.add(value(word), "-e");
        else if (word == "-f") {
            const std::string name = value(word);
            wish.definitions.add(file_text(name), name);
        } else if (word == "-n")
            wish.no_input = true;
        else if (word == "-w")
            wish.warnings = false;
        else if (word == "-u")
            wish.flush = true;
        else if (word == "-b" || word == "-l")
            continue; // about formats of the input, which are not read
        else if (word == "-in" || word == "-on")
            (word == "-in" ? wish.most_in : wish.most_out) = parse_integer(value(word)).value_or(0);
        else if (word.rfind("-t", 0) == 0 && word.size() == 3)
            wish.separator = word[2];
        else if (word == "-o") {
            const std::string name = value(word);
            wish.template_text = name.find('$') != std::string::npos ? name : file_text(name);
        } else if ((word.rfind("-i", 0) != 0 && word.rfind("-o", 0) != 0) || !read_binary(word, wish))
            throw Fatal("command line error at '" + word + "'");
    }
    wish.files.assign(words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
    return wish;
}

/// A value that a record asks for.
struct Value {
    std::optional<Program> program;
    double of(const std::vector<double>& in, bool& good) const
    {
        double value = 0;
        if (program)
            good = program->evaluate(in, {&value, 1}) && good;
        return value;
    }
};

/// Text with `${expression}` in it; each field is as wide as its place.
struct Template {
    struct Piece {
        std::string text;
        Value value;
        std::size_t width = 0;
    };
    std::vector<Piece> pieces;

    Template(const std::string& text, const Definitions& definitions)
    {
        std::string plain;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] != '$' || i + 1 == text.size() || (text[i + 1] != '{' && text[i + 1] != '$')) {
                plain += text[i];
                continue;
            }
            if (text[i + 1] == '$') {
                plain += text[i++];
                continue;
            }
            const std::size_t end = text.find('}', i);
            if (end == std::string::npos)
                throw Fatal("a field of the output format does not end");
            const std::string expression = text.substr(i + 2, end - i - 2);
            pieces.push_back({plain, {Program::compile(definitions, {expression}, "", {}, expression)}, end + 1 - i});
            plain.clear();
            i = end;
        }
        pieces.push_back({plain.ends_with('\n') ? plain : plain + '\n', {}, 0});
    }
};

class Calculator {
public:
    Calculator(const Wish& wish, const Streams& streams) : wish_(wish), streams_(streams), channels_(channels)
    {
        constexpr int most_outputs = most_columns;
        for (int i = 1; i <= most_outputs; ++i) {
            const std::string name = '$' + std::to_string(i);
            outputs_.emplace_back();
            if (wish.definitions.find(name, "") != nullptr) {
                outputs_.back().program = Program::compile_definition(wish.definitions, name, name);
                last_output_ = i;
            }
        }
        outputs_.resize(static_cast<std::size_t>(last_output_));
        if (wish.definitions.find("cond", "") != nullptr)
            condition_.program = Program::compile_definition(wish.definitions, "cond", "cond");
        if (!wish.template_text.empty())
            template_.emplace(wish.template_text, wish.definitions);
    }

    /// False when no more records are wanted.
    bool record(const std::vector<double>& columns)
    {
        std::copy(columns.begin(), columns.end(), channels_.begin());
        std::fill(channels_.begin() + static_cast<std::ptrdiff_t>(columns.size()), channels_.begin() + most_columns, 0);
        channels_[count_channel - 1] = static_cast<double>(columns.size());
        channels_[record_channel - 1] = static_cast<double>(++read_);
        channels_[output_channel - 1] = static_cast<double>(written_ + 1);
        bool good = true;
        if (!condition_.program || condition_.of(channels_, good) > 0) {
            ++written_;
            template_ ? write_template(good) : write_columns(good);
            if (wish_.flush)
                streams_.out.flush();
        }
        if (!good && wish_.warnings && !warned_) {
            streams_.err << "rcalc: warning - an expression has no value at record " << read_ << "; 0 is used\n";
            warned_ = true;
        }
        return read_ != wish_.most_in && written_ != wish_.most_out;
    }

private:
    void write_columns(bool& good)
    {
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            const double value = outputs_[i].of(channels_, good);
            if (wish_.out == 'f')
                binary(static_cast<float>(value));
            else if (wish_.out == 'd')
                binary(value);
            else
                streams_.out << (i > 0 ? "\t" : "") << (outputs_[i].program ? fmt::format("{:.9g}", value) : "");
        }
        if (wish_.out == 'a')
            streams_.out << '\n';
    }
    void write_template(bool& good)
    {
        for (const Template::Piece& piece : template_->pieces) {
            streams_.out << piece.text;
            if (piece.value.program)
                streams_.out << fmt::format("{:>{}}", fmt::format("{:.9g}", piece.value.of(channels_, good)),
                                            piece.width);
        }
    }
    template <class T>
    void binary(T value)
    {
        streams_.out.write(reinterpret_cast<const char*>(&value), sizeof value);
    }

    const Wish& wish_;
    const Streams& streams_;
    std::vector<Value> outputs_;
    int last_output_ = 0;
    Value condition_;
    std::optional<Template> template_;
    std::vector<double> channels_;
    long long read_ = 0, written_ = 0;
    bool warned_ = false;
};

std::vector<double> columns_of(const std::string& line, char separator)
{
    std::vector<double> columns;
    const auto add = [&](std::string_view word) {
        if (columns.size() < most_columns)
            columns.push_back(parse_double(trimmed(word)).value_or(0));
    };
    if (separator == 0) {
        for (const std::string_view word : split(line, " \t\r"))
            add(word);
        return columns;
    }
    std::size_t begin = 0;
    for (std::size_t at = line.find(separator); at != std::string::npos; at = line.find(separator, begin)) {
        add(std::string_view(line).substr(begin, at - begin));
        begin = at + 1;
    }
    add(std::string_view(line).substr(begin));
    return columns;
}

bool read_stream(std::istream& in, const Wish& wish, Calculator& calculator)
{
    if (wish.in != 'a') {
        NumberInput numbers(in, static_cast<NumberFormat>(wish.in));
        for (;;) {
            std::vector<double> columns;
            while (static_cast<int>(columns.size()) < wish.in_count)
                if (const auto value = numbers.next())
                    columns.push_back(*value);
                else
                    return true;
            if (!calculator.record(columns))
                return false;
        }
    }
    for (std::string line; std::getline(in, line);)
        if (const auto columns = columns_of(line, wish.separator); !columns.empty() && !calculator.record(columns))
            return false;
    return true;
}

} // namespace

/// rcalc: records of numbers in, expressions of them out.
int rcalc(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    Calculator calculator(wish, streams);
    if (wish.no_input) {
        calculator.record({});
        return 0;
    }
    if (wish.files.empty())
        read_stream(streams.in, wish, calculator);
    for (const std::string& name : wish.files) {
        std::ifstream file(name, std::ios::binary);
        if (!file)
            throw Fatal(name + ": cannot open");
        if (!read_stream(file, wish, calculator))
            break;
    }
    return 0;
}

} // namespace lightwell::commands
