#include "importers/generators/curve_functions.h"

#include "engine/base/files.h"
#include "engine/base/text.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

constexpr const char* usage =
    "Usage: gensurf material name 'x(s,t)' 'y(s,t)' 'z(s,t)' m n [-e expr][-f file][-s][-i][-o]\n"
    "   or: gensurf material name 'x(s,t)' 'y(s,t)' dfile m n [-e expr][-f file][-s][-i][-o]\n"
    "   or: gensurf material name dfile dfile dfile m n [-s][-i][-o]\n";
constexpr int most_cells = 10'000;

struct Vertex {
    Point point;
    Vec3 normal;
    bool valid = true;
};

/// Words that say what surface is wanted.
struct Wish {
    std::string material, name;
    std::array<std::string, 3> expressions;
    int columns = 0, rows = 0; ///< m steps of s, n steps of t
    bool smooth = false, reversed = false, as_obj = false;
};

/// Points of the surface by their place in the grid; one row and column more on each side where functions reach on.
class Surface {
public:
    Surface(const Wish& wish, CurveFunctions& functions, const GeneratorInput& input)
        : columns_(wish.columns), rows_(wish.rows)
    {
        read_data(wish, input);
        std::vector<std::string> calls;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string name = std::string(1, "xyz"[axis]) + "`gen";
            if (from_function(axis)) {
                functions.add(name, "s,t", wish.expressions[static_cast<std::size_t>(axis)]);
                calls.push_back(name + "($1,$2)");
            }
        }
        if (functions.has("valid"))
            calls.push_back("valid($1,$2)");
        functions.compile(calls);
        has_valid_ = functions.has("valid");
        for (int j = -1; j <= rows_ + 1; ++j)
            for (int i = -1; i <= columns_ + 1; ++i)
                grid_.push_back(vertex(functions, i, j, wish.smooth));
    }
    const Vertex& at(int i, int j) const { return grid_[static_cast<std::size_t>((j + 1) * (columns_ + 3) + i + 1)]; }
    /// Central differences, one-sided where a neighbour is missing.
    Vec3 smooth_normal(int i, int j) const
    {
        const auto step = [&](int di, int dj) {
            const Vertex &before = at(i - di, j - dj), &after = at(i + di, j + dj), &here = at(i, j);
            return (after.valid ? after.point : here.point) - (before.valid ? before.point : here.point);
        };
        const Vec3 normal = cross(step(1, 0), step(0, 1));
        return length(normal) > 0 ? normalized(normal) : normal;
    }

private:
    bool from_function(int axis) const { return data_.empty() || (data_axes_ == 1 && axis < 2); }

    void read_data(const Wish& wish, const GeneratorInput& input)
    {
        const std::string& name = wish.expressions[2];
        std::string text;
        if (name == "-")
            text = input.standard_input ? input.standard_input() : "";
        else if (const auto file = input.find_file(name))
            text = std::string(MappedFile(*file).bytes());
        else
            return;
        data_axes_ = wish.expressions[0] == name && wish.expressions[1] == name ? 3 : 1;
        for (const std::string_view word : split(text, " \t\r\n,")) {
            const auto value = parse_double(word);
            if (!value || !std::isfinite(*value))
                throw BadWords(fmt::format("{}: \"{}\" is no finite number", name, word.substr(0, 40)));
            data_.push_back(*value);
        }
        const auto count = [&](int m, int n) { return static_cast<std::size_t>(m) * static_cast<std::size_t>(n); };
        const std::size_t points = data_.size() / static_cast<std::size_t>(data_axes_);
        at_corners_ = points == count(columns_ + 1, rows_ + 1);
        if ((!at_corners_ && points != count(columns_, rows_)) ||
            data_.size() % static_cast<std::size_t>(data_axes_) != 0)
            throw BadWords(fmt::format("{}: has {} values, expected {} or {} of each", name, data_.size(),
                                       count(columns_, rows_), count(columns_ + 1, rows_ + 1)));
    }

    /// Data continue straight beyond the outermost.
    double datum(int axis, double i, double j) const
    {
        const int m = at_corners_ ? columns_ + 1 : columns_, n = at_corners_ ? rows_ + 1 : rows_;
        const auto value = [&](int column, int row) {
            const std::size_t index =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(m) + static_cast<std::size_t>(column);
            return data_[index * static_cast<std::size_t>(data_axes_) +
                         static_cast<std::size_t>(data_axes_ == 3 ? axis : 0)];
        };
        const double x = at_corners_ ? i : i - 0.5, y = at_corners_ ? j : j - 0.5;
        const int column = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, m - 2));
        const int row = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, n - 2));
        const int next_column = std::min(column + 1, m - 1), next_row = std::min(row + 1, n - 1);
        const double u = x - column, v = y - row;
        return (1 - v) * ((1 - u) * value(column, row) + u * value(next_column, row)) +
               v * ((1 - u) * value(column, next_row) + u * value(next_column, next_row));
    }

    Vertex vertex(const CurveFunctions& functions, int i, int j, bool smooth) const
    {
        const bool outside = i < 0 || j < 0 || i > columns_ || j > rows_;
        Vertex vertex;
        if (outside && !smooth) {
            vertex.valid = false;
            return vertex;
        }
        const double s = static_cast<double>(i) / columns_, t = static_cast<double>(j) / rows_;
        std::vector<double> values;
        try {
            values = functions.values({s, t});
        } catch (const BadWords&) {
            if (!outside)
                throw;
            vertex.valid = false; // a function that is defined on the surface alone
            return vertex;
        }
        std::size_t next = 0;
        for (int axis = 0; axis < 3; ++axis)
            vertex.point[axis] = from_function(axis) ? values[next++] : datum(axis, i, j);
        if (has_valid_)
            vertex.valid = values[next] > 0;
        return vertex;
    }

    int columns_, rows_;
    std::vector<double> data_;
    int data_axes_ = 0; ///< values a point
    bool at_corners_ = true, has_valid_ = false;
    std::vector<Vertex> grid_;
};

struct Corner {
    Point point;
    Vec3 normal;
    int number = 0; ///< of the vertex, for OBJ
};

/// Coefficients by which surf.cal bends the flat normal into those of the corners.
std::string bend_of(const std::vector<Corner>& corners, const Vec3& flat)
{
    int axis = 0;
    for (int other : {1, 2})
        if (std::fabs(flat[other]) > std::fabs(flat[axis]))
            axis = other;
    const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
    // Gauss-Jordan over the products u v, u, v, 1; of a triangle without u v.
    const std::size_t unknowns = corners.size();
    double a[4][7] = {};
    for (std::size_t k = 0; k < unknowns; ++k) {
        const double u = corners[k].point[u_axis], v = corners[k].point[v_axis];
        const double terms[4] = {u * v, u, v, 1};
        for (std::size_t c = 0; c < unknowns; ++c)
            a[k][c] = terms[4 - unknowns + c];
        for (int c = 0; c < 3; ++c)
            a[k][unknowns + static_cast<std::size_t>(c)] = corners[k].normal[c] - flat[c];
    }
    for (std::size_t p = 0; p < unknowns; ++p) {
        std::size_t best = p;
        for (std::size_t k = p; k < unknowns; ++k)
            if (std::fabs(a[k][p]) > std::fabs(a[best][p]))
                best = k;
        std::swap(a[p], a[best]);
        constexpr double singular = 1e-300;
        if (std::fabs(a[p][p]) < singular)
            return {};
        for (std::size_t k = 0; k < unknowns; ++k) {
            const double factor = k == p ? 0 : a[k][p] / a[p][p];
            for (std::size_t c = p; c < unknowns + 3; ++c)
                a[k][c] -= factor * a[p][c];
        }
    }
    std::string text = "13 " + std::to_string(axis) + '\n';
    for (std::size_t term = 0; term < 4; ++term) {
        for (std::size_t c = 0; c < 3; ++c) {
            const bool none = term < 4 - unknowns;
            const std::size_t row = none ? 0 : term - (4 - unknowns);
            text += column(none ? 0 : a[row][unknowns + c] / a[row][row]);
        }
        text += '\n';
    }
    return text;
}

class SurfaceText {
public:
    SurfaceText(const Wish& wish, const Surface& surface, std::string& text)
        : wish_(wish), surface_(surface), text_(text)
    {
    }

    void append()
    {
        if (wish_.as_obj)
            append_vertices();
        for (int j = 0; j < wish_.rows; ++j)
            for (int i = 0; i < wish_.columns; ++i)
                append_cell(i, j);
    }

private:
    void append_vertices()
    {
        text_ += "usemtl " + wish_.material + "\ng " + wish_.name + '\n';
        for (int j = 0; j <= wish_.rows; ++j)
            for (int i = 0; i <= wish_.columns; ++i) {
                const Point& p = surface_.at(i, j).point;
                text_ += fmt::format("v {:.12g} {:.12g} {:.12g}\nvt {:.9g} {:.9g}\n", p.x, p.y, p.z,
                                     static_cast<double>(i) / wish_.columns, static_cast<double>(j) / wish_.rows);
                if (!wish_.smooth)
                    continue;
                const Vec3 n = surface_.smooth_normal(i, j) * (wish_.reversed ? -1.0 : 1.0);
                text_ += fmt::format("vn {:.9g} {:.9g} {:.9g}\n", n.x, n.y, n.z);
            }
    }

    void append_cell(int i, int j)
    {
        std::vector<Corner> corners;
        const std::array<std::pair<int, int>, 4> places{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
        for (const auto& [column_index, row_index] : places) {
            const Vertex& vertex = surface_.at(column_index, row_index);
            const bool doubled = !corners.empty() && corners.back().point == vertex.point;
            if (vertex.valid && !doubled)
                corners.push_back({vertex.point, surface_.smooth_normal(column_index, row_index),
                                   row_index * (wish_.columns + 1) + column_index + 1});
        }
        if (corners.size() > 3 && corners.front().point == corners.back().point)
            corners.pop_back();
        const std::string name = fmt::format("{}.{}.{}", wish_.name, i + 1, j + 1);
        if (corners.size() == 4 && !is_flat(corners)) {
            append_face({corners[0], corners[1], corners[2]}, name + 'a');
            append_face({corners[0], corners[2], corners[3]}, name + 'b');
        } else if (corners.size() >= 3) {
            append_face(corners, name);
        }
    }

    static bool is_flat(const std::vector<Corner>& c)
    {
        const Vec3 a = cross(c[1].point - c[0].point, c[2].point - c[0].point);
        const Vec3 b = cross(c[2].point - c[0].point, c[3].point - c[0].point);
        constexpr double flat = 1e-6; // sine squared
        return dot(a, b) > 0 && dot(cross(a, b), cross(a, b)) <= flat * flat * dot(a, a) * dot(b, b);
    }

    void append_face(std::vector<Corner> corners, const std::string& name)
    {
        Vec3 flat = cross(corners[1].point - corners[0].point, corners[2].point - corners[0].point);
        if (!(length(flat) > 0))
            return;
        flat = normalized(flat);
        if (wish_.reversed) {
            std::reverse(corners.begin(), corners.end());
            flat = -flat;
            for (Corner& corner : corners)
                corner.normal = -corner.normal;
        }
        if (wish_.as_obj) {
            text_ += "f";
            for (const Corner& c : corners)
                text_ += wish_.smooth ? fmt::format(" {0}/{0}/{0}", c.number) : fmt::format(" {0}/{0}", c.number);
            text_ += '\n';
            return;
        }
        std::vector<Point> points;
        for (const Corner& corner : corners)
            points.push_back(corner.point);
        append_polygon(text_, modifier_for(corners, flat), name, points);
    }

    std::string modifier_for(const std::vector<Corner>& corners, const Vec3& flat)
    {
        const std::string bend = wish_.smooth ? bend_of(corners, flat) : "";
        if (bend.empty())
            return wish_.material;
        text_ += fmt::format("\nvoid texfunc {}.tex\n4 surf_dx surf_dy surf_dz surf.cal\n0\n{}", wish_.name, bend);
        text_ += fmt::format("\n{0}.tex alias {0}.mat {1}\n", wish_.name, wish_.material);
        return wish_.name + ".mat";
    }

    const Wish& wish_;
    const Surface& surface_;
    std::string& text_;
};

} // namespace

GeneratorAnswer gensurf(const std::vector<std::string>& words, const GeneratorInput& input)
{
    return answered(words, usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        CurveFunctions functions(input);
        Wish wish;
        wish.material = reader.word("material");
        wish.name = reader.word("name");
        for (std::string& expression : wish.expressions)
            expression = reader.word("x(s,t) y(s,t) z(s,t)");
        wish.columns = reader.count("m", 1, most_cells);
        wish.rows = reader.count("n", 1, most_cells);
        while (reader.more()) {
            const std::string option = reader.word("option");
            if (option == "-s")
                wish.smooth = true;
            else if (option == "-i")
                wish.reversed = true;
            else if (option == "-o")
                wish.as_obj = true;
            else if (!functions.option(option, reader))
                throw BadWords("Use error - unknown option: " + option);
        }
        answer.text = comment_of(words);
        const Surface surface(wish, functions, input);
        SurfaceText(wish, surface, answer.text).append();
    });
}

} // namespace lightwell
