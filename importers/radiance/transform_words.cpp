#include "importers/radiance/transform_words.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <cmath>
#include <fmt/format.h>

namespace lightwell::scene_text {
namespace {

/// More copies than this are a slip of the pen, not a building.
constexpr std::size_t most_placements = 10'000'000;

/// Steps that belong together: repeated `count` times (-i), or 0 to count - 1 times (-a).
struct Group {
    bool array = false;
    long long count = 1;
    Affine map;
};

/// Quarter turns are exact whatever their number of degrees is in radians.
Affine rotation_deg(int axis, double degrees)
{
    const double quarters = degrees / 90;
    if (quarters == std::nearbyint(quarters))
        return Affine::rotate(axis, std::fmod(quarters, 4) * (pi / 2));
    return Affine::rotate(axis, degrees * radians_per_degree);
}

class Steps {
public:
    Steps(const std::vector<std::string>& words, std::size_t& next, const std::string& place)
        : words_(words), next_(next), place_(place)
    {
    }

    std::vector<Group> read()
    {
        std::vector<Group> groups(1);
        while (next_ < words_.size()) {
            const std::string& word = words_[next_];
            if (word == "-a" || word == "-i") {
                ++next_;
                groups.push_back({word == "-a", count(word), {}});
            } else if (const auto map = step(word)) {
                groups.back().map = compose(*map, groups.back().map);
            } else {
                break;
            }
        }
        return groups;
    }

private:
    std::optional<Affine> step(const std::string& word)
    {
        if (word == "-t") {
            ++next_;
            const double x = number(word), y = number(word);
            return Affine::translate({x, y, number(word)});
        }
        if (word == "-s") {
            ++next_;
            const double factor = number(word);
            if (factor == 0)
                throw InputError{place_, "-s is 0, expected a scale that is not zero", "leave the object out instead"};
            return Affine::scale(factor);
        }
        if (word == "-affine") {
            ++next_;
            return rows(word);
        }
        if (word.size() != 3 || word[0] != '-' || word[2] < 'x' || word[2] > 'z')
            return std::nullopt;
        const int axis = word[2] - 'x';
        if (word[1] == 'r') {
            ++next_;
            return rotation_deg(axis, number(word));
        }
        if (word[1] != 'm')
            return std::nullopt;
        ++next_;
        Vec3 factors{1, 1, 1};
        factors[axis] = -1;
        return Affine::scale(factors);
    }

    /// Three rows of four numbers: what x, y and z of the image are made of.
    Affine rows(const std::string& word)
    {
        Affine map;
        for (int row = 0; row < 3; ++row)
            for (Vec3* column : {&map.x, &map.y, &map.z, &map.translation})
                (*column)[row] = number(word);
        return map;
    }

    double number(const std::string& after)
    {
        const auto value = next_ < words_.size() ? parse_double(words_[next_]) : std::nullopt;
        if (!value || !std::isfinite(*value))
            throw InputError{place_, fmt::format("{} is followed by \"{}\", expected a finite number", after,
                                                 next_ < words_.size() ? words_[next_] : "nothing")};
        ++next_;
        return *value;
    }

    long long count(const std::string& after)
    {
        const long long least = after == "-a" ? 1 : 0;
        const std::string& word = next_ < words_.size() ? words_[next_] : after;
        const long long value = parse_integer(word).value_or(-1);
        if (value < least)
            throw InputError{place_, fmt::format("{} is followed by \"{}\", expected a whole number, at least {}",
                                                 after, next_ < words_.size() ? word : "nothing", least)};
        ++next_;
        return value;
    }

    const std::vector<std::string>& words_;
    std::size_t& next_;
    const std::string& place_;
};

Affine power(Affine map, long long exponent)
{
    Affine result;
    for (; exponent > 0; exponent /= 2) {
        if (exponent % 2 == 1)
            result = compose(map, result);
        map = compose(map, map);
    }
    return result;
}

/// Every placement so far, followed by 0 to count - 1 repetitions of the group.
std::vector<Placement> repeated(const std::vector<Placement>& placements, const Group& group)
{
    std::vector<Placement> result;
    result.reserve(placements.size() * static_cast<std::size_t>(group.count));
    for (const Placement& placement : placements) {
        Affine map = placement.map;
        for (long long i = 0; i < group.count; ++i) {
            result.push_back(
                {map, placement.array_index + (placement.array_index.empty() ? "" : ".") + std::to_string(i)});
            map = compose(group.map, map);
        }
    }
    return result;
}

/// Between a map and the one that its words give, relative to the scale.
constexpr double agreement = 1e-12;

/// 30 rather than 30.000000000000004.
double plain_degrees(double angle_rad)
{
    const double degrees = angle_rad / radians_per_degree, rounded = std::nearbyint(degrees * 1e6) / 1e6;
    constexpr double last_digits = 1e-12; // 2e-14 rad, far below the agreement that is asked for
    return std::fabs(degrees - rounded) < last_digits ? rounded : degrees;
}

double largest_difference(const Affine& a, const Affine& b)
{
    return std::fmax(std::fmax(max_abs(a.x - b.x), max_abs(a.y - b.y)), max_abs(a.z - b.z));
}

} // namespace

std::vector<Placement> read_placements(const std::vector<std::string>& words, std::size_t& begin,
                                       const std::string& place)
{
    std::vector<Placement> placements(1);
    for (const Group& group : Steps(words, begin, place).read()) {
        if (!group.array) {
            const Affine map = power(group.map, group.count);
            for (Placement& placement : placements)
                placement.map = compose(map, placement.map);
            continue;
        }
        if (static_cast<unsigned long long>(group.count) > most_placements / placements.size())
            throw InputError{place, fmt::format("the arrays ask for more than {} copies", most_placements),
                             "use smaller counts after -a"};
        placements = repeated(placements, group);
    }
    for (const Placement& placement : placements)
        if (!is_finite(placement.map.translation) || !std::isfinite(placement.map.determinant()) ||
            placement.map.determinant() == 0)
            throw InputError{place, "the transform is singular or not finite", "use scales within reason"};
    return placements;
}

std::optional<std::vector<std::string>> words_of(const Affine& map)
{
    const double scale = similarity_scale(map, agreement);
    if (!(scale > 0))
        return std::nullopt;
    const bool mirrored = map.determinant() < 0;
    // The mirror comes first, so its column changes sign before the rest is taken for a rotation.
    const Vec3 x = (mirrored ? -map.x : map.x) / scale, y = map.y / scale;
    const double about_z = std::atan2(x.y, x.x), about_y = std::atan2(-x.z, std::hypot(x.x, x.y));
    // What the other two leave over, so that the product is right even where they are ill defined (x along z).
    const Affine others = compose(Affine::rotate(2, about_z), Affine::rotate(1, about_y));
    const double about_x = std::atan2(dot(others.z, y), dot(others.y, y));
    std::vector<std::string> words;
    if (mirrored)
        words.emplace_back("-mx");
    const auto add = [&](const char* word, double value) { words.insert(words.end(), {word, shortest(value)}); };
    if (scale != 1)
        add("-s", scale);
    const std::pair<const char*, double> turns[] = {{"-rx", about_x}, {"-ry", about_y}, {"-rz", about_z}};
    for (const auto& [word, angle] : turns)
        if (angle != 0)
            add(word, plain_degrees(angle));
    const Vec3& t = map.translation;
    if (!(t == Vec3{}))
        words.insert(words.end(), {"-t", shortest(t.x), shortest(t.y), shortest(t.z)});
    std::size_t begin = 0;
    const Affine again = read_placements(words, begin, "transform").front().map;
    if (!(largest_difference(again, map) <= agreement * scale) || !(again.translation == t))
        return std::nullopt;
    return words;
}

} // namespace lightwell::scene_text
