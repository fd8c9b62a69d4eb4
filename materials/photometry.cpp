#include "materials/photometry.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Angles in files are rounded to hundredths of a degree.
constexpr double same_angle_deg = 0.01;

bool same(double a, double b)
{
    return std::fabs(a - b) < same_angle_deg;
}

/// Where an angle lies in an ascending list: the entry before it and the share of the next; nothing outside.
struct Place {
    std::size_t index = 0;
    double share = 0;
    bool inside = false;
};

Place place_in(const std::vector<double>& angles, double angle)
{
    if (angle < angles.front() - same_angle_deg || angle > angles.back() + same_angle_deg)
        return {};
    if (angles.size() == 1)
        return {0, 0, true};
    const auto next = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const std::size_t index = static_cast<std::size_t>(next - angles.begin()) - 1;
    const double share = (angle - angles[index]) / (angles[index + 1] - angles[index]);
    return {index, std::clamp(share, 0.0, 1.0), true};
}

/// Integral of a linear function times sine (type C) or cosine (types A, B) between two angles.
double weighted_integral(double from_rad, double to_rad, double at_from, double at_to, bool sine)
{
    const double slope = (at_to - at_from) / (to_rad - from_rad), start = at_from - slope * from_rad;
    const auto primitive = [&](double x) {
        return sine ? -start * std::cos(x) + slope * (std::sin(x) - x * std::cos(x))
                    : start * std::sin(x) + slope * (std::cos(x) + x * std::sin(x));
    };
    return primitive(to_rad) - primitive(from_rad);
}

/// The table with rows and columns exchanged, so that what is done to planes can be done to verticals.
void exchange(Photometry& photometry)
{
    const std::size_t rows = photometry.horizontal_deg.size(), columns = photometry.vertical_deg.size();
    std::vector<double> turned(photometry.candela.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            turned[column * rows + row] = photometry.candela[row * columns + column];
    photometry.candela = std::move(turned);
    std::swap(photometry.horizontal_deg, photometry.vertical_deg);
}

/// Adds the planes that mirror those present.
/// @param mirrored  the angle that a plane's angle is mirrored to
template <class Mirror>
void mirror_planes(Photometry& photometry, const Mirror& mirrored)
{
    const std::size_t verticals = photometry.vertical_deg.size(), count = photometry.horizontal_deg.size();
    for (std::size_t i = count; i-- > 0;) {
        const double angle = mirrored(photometry.horizontal_deg[i]);
        if (std::any_of(photometry.horizontal_deg.begin(), photometry.horizontal_deg.end(),
                        [&](double known) { return same(known, angle); }))
            continue;
        photometry.horizontal_deg.push_back(angle);
        const std::vector<double> plane(photometry.candela.begin() + static_cast<std::ptrdiff_t>(i * verticals),
                                        photometry.candela.begin() + static_cast<std::ptrdiff_t>((i + 1) * verticals));
        photometry.candela.insert(photometry.candela.end(), plane.begin(), plane.end());
    }
}

void sort_planes(Photometry& photometry)
{
    const std::size_t verticals = photometry.vertical_deg.size();
    std::vector<std::size_t> order(photometry.horizontal_deg.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return photometry.horizontal_deg[a] < photometry.horizontal_deg[b];
    });
    const std::vector<double> angles = photometry.horizontal_deg, candela = photometry.candela;
    for (std::size_t i = 0; i < order.size(); ++i) {
        photometry.horizontal_deg[i] = angles[order[i]];
        std::copy_n(candela.begin() + static_cast<std::ptrdiff_t>(order[i] * verticals), verticals,
                    photometry.candela.begin() + static_cast<std::ptrdiff_t>(i * verticals));
    }
}

void check_ascending(const std::vector<double>& angles, const char* which, const std::string& place)
{
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (!(angles[i] > angles[i - 1]))
            throw InputError{place, std::string(which) + " angle " + shortest(angles[i]) + " follows " +
                                        shortest(angles[i - 1]) + ", expected ascending angles"};
}

void check_range(const std::vector<double>& angles, const char* which, double low, double high,
                 const std::string& place)
{
    if (angles.size() < 2 || angles.front() < low - same_angle_deg || angles.back() > high + same_angle_deg)
        throw InputError{place, std::string(which) + " angles from " + shortest(angles.front()) + " to " +
                                    shortest(angles.back()) + ", expected at least two from " + shortest(low) + " to " +
                                    shortest(high)};
}

/// Types A and B say half of what is symmetric: angles from 0.
void complete_halves(Photometry& photometry, const std::string& place)
{
    check_range(photometry.vertical_deg, "vertical", -90, 90, place);
    check_range(photometry.horizontal_deg, "horizontal", -90, 90, place);
    for (int which = 0; which < 2; ++which) {
        if (same(photometry.horizontal_deg.front(), 0)) {
            mirror_planes(photometry, [](double angle) { return -angle; });
            sort_planes(photometry);
        }
        exchange(photometry);
    }
}

/// What rows and columns of the table are: planes about an axis, and the angles within a plane.
struct Planes {
    const std::vector<double>&about, &within;
    std::size_t about_step, within_step; ///< in the table
    bool from_pole;                      ///< angles within a plane begin at its axis; else at its middle
};

Planes planes_of(const Photometry& p)
{
    const std::size_t verticals = p.vertical_deg.size();
    if (p.type == Photometry::Type::B)
        return {p.vertical_deg, p.horizontal_deg, 1, verticals, false};
    return {p.horizontal_deg, p.vertical_deg, verticals, 1, p.type == Photometry::Type::C};
}

} // namespace

void complete_planes(Photometry& photometry, const std::string& place)
{
    check_ascending(photometry.vertical_deg, "vertical", place);
    check_ascending(photometry.horizontal_deg, "horizontal", place);
    if (photometry.type != Photometry::Type::C)
        return complete_halves(photometry, place);
    check_range(photometry.vertical_deg, "vertical", 0, 180, place);
    if (photometry.horizontal_deg.size() == 1)
        return;
    const double first = photometry.horizontal_deg.front(), last = photometry.horizontal_deg.back();
    const double step = last - photometry.horizontal_deg[photometry.horizontal_deg.size() - 2];
    if (same(first, 0) && same(last, 90))
        mirror_planes(photometry, [](double angle) { return 180 - angle; });
    if (same(first, 90) && same(last, 270)) // planes 90 to 270 hold the half with x < 0
        mirror_planes(photometry, [](double angle) { return angle < 180.5 ? 180 - angle : 540 - angle; });
    else if (same(first, 0) && (same(last, 90) || same(last, 180)))
        mirror_planes(photometry, [](double angle) { return 360 - angle; });
    else if (!(same(first, 0) && (same(last, 360) || same(last + step, 360))))
        throw InputError{place, std::string("planes from ") + shortest(first) + " to " + shortest(last) +
                                    " degrees, expected 0, 0 to 90, 0 to 180, 90 to 270 or 0 to 360"};
    mirror_planes(photometry, [](double angle) { return same(angle, 0) ? 360 : angle; }); // plane 360 is plane 0
    sort_planes(photometry);
}

double Photometry::candela_towards(const Direction& d) const
{
    double vertical = 0, horizontal = 0;
    if (type == Type::C) {
        vertical = std::atan2(std::hypot(d.x, d.y), -d.z) / radians_per_degree;
        horizontal = std::atan2(d.y, d.x) / radians_per_degree;
        horizontal += horizontal < 0 ? 360 : 0;
    } else if (type == Type::B) {
        vertical = std::atan2(d.x, -d.z) / radians_per_degree;
        horizontal = std::asin(std::clamp(-d.y, -1.0, 1.0)) / radians_per_degree;
    } else {
        vertical = std::asin(std::clamp(d.x, -1.0, 1.0)) / radians_per_degree;
        horizontal = std::atan2(-d.y, -d.z) / radians_per_degree;
    }
    const Place v = place_in(vertical_deg, vertical);
    const Place h = horizontal_deg.size() == 1 ? Place{0, 0, true} : place_in(horizontal_deg, horizontal);
    if (!v.inside || !h.inside)
        return 0;
    const auto in_plane = [&](std::size_t plane) {
        const double* row = &candela[plane * vertical_deg.size() + v.index];
        return v.share > 0 ? row[0] + (row[1] - row[0]) * v.share : row[0];
    };
    const double here = in_plane(h.index);
    return h.share > 0 ? here + (in_plane(h.index + 1) - here) * h.share : here;
}

double Photometry::lumens() const
{
    const Planes planes = planes_of(*this);
    std::vector<double> sums;
    for (std::size_t plane = 0; plane < planes.about.size(); ++plane) {
        double sum = 0;
        for (std::size_t i = 1; i < planes.within.size(); ++i) {
            const double* value = &candela[plane * planes.about_step + i * planes.within_step];
            sum += weighted_integral(planes.within[i - 1] * radians_per_degree, planes.within[i] * radians_per_degree,
                                     *(value - planes.within_step), *value, planes.from_pole);
        }
        sums.push_back(sum);
    }
    if (sums.size() == 1)
        return sums[0] * 2 * pi;
    double total = 0;
    for (std::size_t i = 1; i < sums.size(); ++i)
        total += (sums[i - 1] + sums[i]) / 2 * (planes.about[i] - planes.about[i - 1]) * radians_per_degree;
    return total;
}

double Photometry::share_tilted(double angle_deg) const
{
    if (tilt_deg.empty())
        return 1;
    const Place place = place_in(tilt_deg, std::clamp(angle_deg, tilt_deg.front(), tilt_deg.back()));
    const double here = tilt_share[place.index];
    return place.share > 0 ? here + (tilt_share[place.index + 1] - here) * place.share : here;
}

double Photometry::greatest_candela() const
{
    return candela.empty() ? 0 : *std::max_element(candela.begin(), candela.end());
}

double Photometry::beam_angle_deg(double plane_deg) const
{
    constexpr double step_deg = 0.1;
    const double half = greatest_candela() / 2, turn = plane_deg * radians_per_degree;
    double total = 0;
    for (const double side : {1.0, -1.0}) {
        double angle = 0;
        const auto towards = [&](double a_deg) {
            const double a = a_deg * radians_per_degree, across = side * std::sin(a);
            return candela_towards({across * std::cos(turn), across * std::sin(turn), -std::cos(a)});
        };
        while (angle <= 180 && towards(angle) >= half)
            angle += step_deg;
        if (angle > 180)
            return 0;
        total += angle;
    }
    return total;
}

bool Photometry::sends_down() const
{
    if (type != Type::C)
        return greatest_candela() > 0;
    for (std::size_t i = 0; i < candela.size(); ++i)
        if (candela[i] > 0 && vertical_deg[i % vertical_deg.size()] < 90 - same_angle_deg)
            return true;
    return false;
}

bool Photometry::sends_up() const
{
    if (type != Type::C)
        return false;
    for (std::size_t i = 0; i < candela.size(); ++i)
        if (candela[i] > 0 && vertical_deg[i % vertical_deg.size()] > 90 + same_angle_deg)
            return true;
    return false;
}

const char* to_text(Photometry::Opening::Shape shape)
{
    constexpr const char* words[] = {"point",
                                     "rectangle",
                                     "ellipse",
                                     "box",
                                     "vertical cylinder",
                                     "sphere",
                                     "cylinder along plane 0",
                                     "cylinder along plane 90",
                                     "ellipsoid"};
    return words[static_cast<int>(shape)];
}

Photometry read_photometry(const std::filesystem::path& file, Report& report)
{
    constexpr std::size_t most_bytes = 16 << 20; // the finest measurements take some hundred kilobytes
    const MappedFile mapped{file};
    if (mapped.bytes().size() > most_bytes)
        throw InputError{file.string(), "is larger than 16 MB, expected a table of intensities"};
    const std::string name = file.filename().string();
    if (!looks_like_ies(mapped.bytes()))
        return parse_eulumdat(mapped.bytes(), name, report);
    Photometry photometry = parse_ies(mapped.bytes(), name, report);
    if (photometry.tilt_file.empty())
        return photometry;
    const std::filesystem::path tilt = file.parent_path() / photometry.tilt_file;
    if (std::filesystem::is_regular_file(tilt))
        parse_tilt(MappedFile{tilt}.bytes(), photometry.tilt_file, photometry);
    else
        report.add(Finding::ignored, name,
                   "the file of TILT factors is not found: the lamps are taken to give as much "
                   "light however the luminaire is tilted");
    return photometry;
}

} // namespace lightwell
