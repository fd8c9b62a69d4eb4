#include "engine/geometry/triangulate.h"

#include "engine/base/frame.h"

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

class EarClipper {
public:
    EarClipper(std::vector<Flat> corners) : flat_(std::move(corners))
    {
        for (std::uint32_t i = 0; i < flat_.size(); ++i)
            left_.push_back(i);
    }
    std::vector<std::array<std::uint32_t, 3>> run()
    {
        std::size_t at = 0, failures = 0;
        while (left_.size() >= 3) {
            at %= left_.size();
            const bool forced = failures >= left_.size(); // self-touching: take the least bad corner and go on
            if (is_ear(at) || forced) {
                take(at);
                failures = 0;
            } else {
                ++at;
                ++failures;
            }
        }
        return std::move(triangles_);
    }

private:
    std::uint32_t neighbour(std::size_t at, std::size_t step) const { return left_[(at + step) % left_.size()]; }
    bool is_ear(std::size_t at) const
    {
        const std::uint32_t i = neighbour(at, left_.size() - 1), j = left_[at], k = neighbour(at, 1);
        if (!(turn(flat_[i], flat_[j], flat_[k]) > 0))
            return false;
        for (const std::uint32_t other : left_)
            if (other != i && other != j && other != k && blocks(flat_[other], flat_[i], flat_[j], flat_[k]))
                return false;
        return true;
    }
    void take(std::size_t at)
    {
        const std::uint32_t i = neighbour(at, left_.size() - 1), j = left_[at], k = neighbour(at, 1);
        if (turn(flat_[i], flat_[j], flat_[k]) > 0)
            triangles_.push_back({i, j, k});
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    std::vector<Flat> flat_;
    std::vector<std::uint32_t> left_;
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
