#include "engine/geometry/triangulate.h"

#include "engine/base/frame.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

struct Flat {
    double x, y;
};

double turn(const Flat& a, const Flat& b, const Flat& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Strictly inside or on the border, but not at a corner: seams repeat corners, and those must not block an ear.
bool blocks(const Flat& p, const Flat& a, const Flat& b, const Flat& c)
{
    const auto same = [](const Flat& u, const Flat& v) { return u.x == v.x && u.y == v.y; };
    if (same(p, a) || same(p, b) || same(p, c))
        return false;
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// The corners that are left, by squares of the plane: an ear asks only those near it.
class CornerGrid {
public:
    explicit CornerGrid(const std::vector<Flat>& corners) : corners_(corners)
    {
        Flat high = low_ = corners[0];
        for (const Flat& p : corners) {
            low_ = {std::fmin(low_.x, p.x), std::fmin(low_.y, p.y)};
            high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y)};
        }
        side_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(corners.size()))) + 1;
        const auto wide = static_cast<double>(side_);
        cells_per_x_ = high.x > low_.x ? wide / (high.x - low_.x) : 0;
        cells_per_y_ = high.y > low_.y ? wide / (high.y - low_.y) : 0;
        cells_.resize(side_ * side_);
        for (std::uint32_t i = 0; i < corners.size(); ++i)
            cells_[column(corners[i].x) + side_ * row(corners[i].y)].push_back(i);
    }
    void remove(std::uint32_t corner)
    {
        const Flat& p = corners_[corner];
        std::erase(cells_[column(p.x) + side_ * row(p.y)], corner);
    }
    /// Whether a corner but i, j, k blocks their triangle.
    bool any_blocks(std::uint32_t i, std::uint32_t j, std::uint32_t k) const
    {
        const Flat &a = corners_[i], &b = corners_[j], &c = corners_[k];
        const std::size_t x0 = column(std::fmin(a.x, std::fmin(b.x, c.x))),
                          x1 = column(std::fmax(a.x, std::fmax(b.x, c.x))),
                          y0 = row(std::fmin(a.y, std::fmin(b.y, c.y))), y1 = row(std::fmax(a.y, std::fmax(b.y, c.y)));
        for (std::size_t y = y0; y <= y1; ++y)
            for (std::size_t x = x0; x <= x1; ++x)
                for (const std::uint32_t other : cells_[x + side_ * y])
                    if (other != i && other != j && other != k && blocks(corners_[other], a, b, c))
                        return true;
        return false;
    }

private:
    std::size_t cell(double cells) const { return std::min(side_ - 1, static_cast<std::size_t>(std::fmax(0, cells))); }
    std::size_t column(double x) const { return cell((x - low_.x) * cells_per_x_); }
    std::size_t row(double y) const { return cell((y - low_.y) * cells_per_y_); }
    const std::vector<Flat>& corners_;
    Flat low_{};
    std::size_t side_ = 1;
    double cells_per_x_ = 0, cells_per_y_ = 0;
    std::vector<std::vector<std::uint32_t>> cells_;
};

class EarClipper {
public:
    explicit EarClipper(std::vector<Flat> corners)
        : flat_(std::move(corners)), near_(flat_), before_(flat_.size()), after_(flat_.size()), left_(flat_.size())
    {
        const auto count = static_cast<std::uint32_t>(flat_.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            before_[i] = (i + count - 1) % count;
            after_[i] = (i + 1) % count;
        }
    }
    std::vector<std::array<std::uint32_t, 3>> run()
    {
        std::uint32_t at = 0;
        std::size_t failures = 0;
        while (left_ >= 3) {
            const bool forced = failures >= patience(); // self-touching: take the least bad corner and go on
            tangled_ = tangled_ || forced;
            failures = is_ear(at) || forced ? 0 : failures + 1;
            if (failures == 0)
                take(at);
            at = after_[at];
        }
        return std::move(triangles_);
    }

private:
    /// Corners that are tried before one is taken that is no ear: all of them, until the outline has turned out to
    /// cross itself; of many then a part only, or each step would try all again.
    std::size_t patience() const
    {
        constexpr std::size_t always = 1024, share = 64;
        return tangled_ ? std::min(left_, std::max(always, left_ / share)) : left_;
    }
    bool convex(std::uint32_t at) const { return turn(flat_[before_[at]], flat_[at], flat_[after_[at]]) > 0; }
    bool is_ear(std::uint32_t at) const { return convex(at) && !near_.any_blocks(before_[at], at, after_[at]); }
    void take(std::uint32_t at)
    {
        if (convex(at))
            triangles_.push_back({before_[at], at, after_[at]});
        after_[before_[at]] = after_[at];
        before_[after_[at]] = before_[at];
        near_.remove(at);
        --left_;
    }
    std::vector<Flat> flat_;
    CornerGrid near_;
    std::vector<std::uint32_t> before_, after_;
    std::size_t left_;
    bool tangled_ = false;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

} // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const Point* corners, std::size_t count)
{
    if (count == 3)
        return {{0, 1, 2}};
    Vec3 area;
    for (std::size_t i = 1; i + 1 < count; ++i)
        area += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    const Frame frame = frame_about(normalized(area));
    std::vector<Flat> flat;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = corners[i] - corners[0];
        flat.push_back({dot(p, frame.x), dot(p, frame.y)});
    }
    return EarClipper(std::move(flat)).run();
}

} // namespace lightwell
