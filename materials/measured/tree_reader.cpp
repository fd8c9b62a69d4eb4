#include "materials/measured/tree_reader.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Finer than the eye, and than anything that was measured: 4096 cells along a coordinate.
constexpr int deepest = 12;

class TreeReader {
public:
    TreeReader(std::string_view text, int coordinates, const std::string& place) : rest_(text), place_(place)
    {
        tree_.coordinates = coordinates;
        tree_.nodes.emplace_back();
        node(0, 0);
        skip();
        if (!rest_.empty())
            fail("text behind the tree: \"" + std::string(rest_.substr(0, 20)) + "\"");
    }
    ValueTree finished() { return std::move(tree_); }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError{place_, "in the tree of values: " + what, "the file is damaged; get it again from its source"};
    }
    void skip()
    {
        while (!rest_.empty() && (static_cast<unsigned char>(rest_.front()) <= ' ' || rest_.front() == ','))
            rest_.remove_prefix(1);
    }
    char next()
    {
        skip();
        if (rest_.empty())
            fail("it ends before its last }");
        return rest_.front();
    }
    void node(std::uint32_t index, int depth)
    {
        if (depth > deepest)
            fail("more than " + std::to_string(deepest) + " levels");
        if (next() != '{')
            fail(std::string("found '") + rest_.front() + "', expected {");
        rest_.remove_prefix(1);
        if (next() == '{')
            branches(index, depth);
        else
            grid(index, depth);
        if (next() != '}')
            fail("a level has more branches than " + std::to_string(1 << tree_.coordinates));
        rest_.remove_prefix(1);
    }
    void branches(std::uint32_t index, int depth)
    {
        const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
        const std::uint32_t count = 1u << tree_.coordinates;
        tree_.nodes[index].first = first;
        tree_.nodes.resize(tree_.nodes.size() + count);
        for (std::uint32_t i = 0; i < count; ++i)
            node(first + i, depth + 1);
    }
    void grid(std::uint32_t index, int depth)
    {
        const std::size_t first = tree_.values.size();
        while (next() != '}')
            tree_.values.push_back(number());
        const std::size_t count = tree_.values.size() - first;
        int bits = 0;
        while (bits + depth < deepest && std::size_t{1} << (bits * tree_.coordinates) < count)
            ++bits;
        if (std::size_t{1} << (bits * tree_.coordinates) != count)
            fail(std::to_string(count) + " values make no grid of " + std::to_string(tree_.coordinates) +
                 " coordinates");
        tree_.nodes[index] = {bits, static_cast<std::uint32_t>(first)};
        tree_.depth = std::max(tree_.depth, depth + bits);
    }
    double number()
    {
        std::size_t end = 0;
        while (end < rest_.size() && static_cast<unsigned char>(rest_[end]) > ' ' && rest_[end] != '}' &&
               rest_[end] != '{' && rest_[end] != ',')
            ++end;
        const std::string_view word = rest_.substr(0, end);
        const auto value = parse_double(word);
        if (!value || !std::isfinite(*value))
            fail(std::string("\"").append(word.substr(0, 20)).append("\" is no finite number"));
        rest_.remove_prefix(end);
        return std::max(0.0, *value); // differences of measurements come out slightly negative
    }

    std::string_view rest_;
    const std::string& place_;
    ValueTree tree_;
};

} // namespace

ValueTree parse_tree(std::string_view text, int coordinates, const std::string& place)
{
    return TreeReader(text, coordinates, place).finished();
}

} // namespace lightwell
