#pragma once

#include "engine/base/vector.h"
#include "importers/generators/generator.h"

#include <stdexcept>

/// \file What the generators share.
namespace lightwell::generators {

/// Words that a command does not understand: its message and status 1.
class BadWords : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Runs `make`; words that it does not understand become `NAME: MESSAGE` and the usage.
GeneratorAnswer answered(const std::vector<std::string>& words, const std::string& usage,
                         const std::function<void(GeneratorAnswer&)>& make);

/// The words of a command, one after the other.
class WordReader {
public:
    explicit WordReader(const std::vector<std::string>& words) : words_(words) {}
    bool more() const { return next_ < words_.size(); }
    std::size_t left() const { return words_.size() - next_; }
    /// @throws BadWords when there is none left
    const std::string& word(const char* what);
    double number(const char* what);
    int count(const char* what, int least, int most);
    const std::string& peek() const { return words_[next_]; }

private:
    const std::vector<std::string>& words_;
    std::size_t next_ = 1;
};

/// `# WORD WORD ...`
std::string comment_of(const std::vector<std::string>& words);
/// `MODIFIER TYPE NAME` and the empty lists of words and integers, after an empty line.
void begin_primitive(std::string& text, const std::string& modifier, const std::string& type, const std::string& name);
/// A number in a column.
std::string column(double value);
void append_point(std::string& text, const Point& point);
void append_polygon(std::string& text, const std::string& modifier, const std::string& name,
                    const std::vector<Point>& corners);
void append_round(std::string& text, const std::string& modifier, const std::string& type, const std::string& name,
                  const std::vector<Point>& points, const std::vector<double>& radii);

} // namespace lightwell::generators
