#include "plugins/validation/box_radiosity.h"

#include "plugins/validation/lamp_formulas.h"
#include "plugins/validation/quadrature.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Ends of cells along an edge of length 1: the parts between the breaks, each finer towards its ends.
std::vector<double> grid_lines(std::vector<double> breaks, int cells)
{
    breaks.insert(breaks.end(), {0.0, 1.0});
    std::sort(breaks.begin(), breaks.end());
    std::vector<double> lines{0};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double low = breaks[i], size = breaks[i + 1] - low;
        const int count = std::max(cells / 4, static_cast<int>(std::lround(cells * size)));
        for (int k = 1; k <= count; ++k)
            lines.push_back(low + size * 0.5 * (1 - std::cos(pi * k / count)));
    }
    return lines;
}

} // namespace

AxisRectangle BoxRadiosity::Patch::rectangle() const
{
    AxisRectangle r{corners[0], corners[0], normal.x != 0 ? 0 : normal.y != 0 ? 1 : 2};
    for (int axis = 0; axis < 3; ++axis) {
        r.low[axis] = std::fmin(corners[0][axis], corners[2][axis]);
        r.high[axis] = std::fmax(corners[0][axis], corners[2][axis]);
    }
    return r;
}

Point BoxRadiosity::Patch::at(double u, double v) const
{
    return corners[0] + (corners[1] - corners[0]) * u + (corners[3] - corners[0]) * v;
}

BoxRadiosity::Patch BoxRadiosity::Patch::part(int i, int k, int parts) const
{
    const double step = 1.0 / parts, u = i * step, v = k * step;
    Patch piece = *this;
    piece.corners = {at(u, v), at(u + step, v), at(u + step, v + step), at(u, v + step)};
    piece.middle = at(u + 0.5 * step, v + 0.5 * step);
    piece.area = area * step * step;
    return piece;
}

BoxRadiosity::BoxRadiosity(const RadiosityRoom& room, int cells) : room_(room)
{
    add_faces();
    for (std::size_t i = 0; i < faces_.size(); ++i)
        add_patches(i, cells);
    solve();
}

void BoxRadiosity::add_faces()
{
    const std::vector<RoomFace> box = room_faces(room_.size);
    for (std::size_t i = 0; i < box.size(); ++i)
        faces_.push_back({box[i], room_.reflectance[i], {}, {}});
    // floor: u is x, v is y; ceiling: u is y, v is x; x0: u is y, v is z; x1: u is z, v is y.
    if (room_.panel) {
        faces_[1].u_breaks = {room_.panel->y0 / room_.size.y, room_.panel->y1 / room_.size.y};
        faces_[1].v_breaks = {room_.panel->x0 / room_.size.x, room_.panel->x1 / room_.size.x};
    }
    if (!room_.partition)
        return;
    const RadiosityRoom::Partition& sheet = *room_.partition;
    const double y = sheet.y / room_.size.y, z = sheet.height / room_.size.z;
    faces_[0].v_breaks.push_back(y);
    faces_[1].u_breaks.push_back(y);
    faces_[2].u_breaks.push_back(y);
    faces_[2].v_breaks.push_back(z);
    faces_[3].v_breaks.push_back(y);
    faces_[3].u_breaks.push_back(z);
    const Vec3 across{room_.size.x, 0, 0}, up{0, 0, sheet.height};
    faces_.push_back({{"part_y0side", {0, sheet.y, 0}, across, up, {0, -1, 0}}, sheet.reflectance_y0, {}, {}});
    faces_.push_back({{"part_y1side", {0, sheet.y, 0}, up, across, {0, 1, 0}}, sheet.reflectance_y1, {}, {}});
}

void BoxRadiosity::add_patches(std::size_t face, int cells)
{
    const Face& f = faces_[face];
    const RoomFace& frame = f.frame;
    const std::vector<double> us = grid_lines(f.u_breaks, cells), vs = grid_lines(f.v_breaks, cells);
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
        for (std::size_t k = 0; k + 1 < vs.size(); ++k) {
            const Point corner = frame.corner + frame.u * us[i] + frame.v * vs[k];
            const Vec3 u = frame.u * (us[i + 1] - us[i]), v = frame.v * (vs[k + 1] - vs[k]);
            Patch patch{face,
                        {corner, corner + u, corner + u + v, corner + v},
                        corner + (u + v) * 0.5,
                        frame.normal,
                        length(u) * length(v),
                        f.reflectance,
                        0};
            const auto& panel = room_.panel;
            const bool in_panel = face == 1 && panel && patch.middle.x > panel->x0 && patch.middle.x < panel->x1 &&
                                  patch.middle.y > panel->y0 && patch.middle.y < panel->y1;
            if (in_panel) {
                patch.reflectance = 0;
                patch.own = panel->exitance;
            }
            patches_.push_back(patch);
        }
}

double BoxRadiosity::direct(const Point& place, const Direction& normal) const
{
    if (!room_.lamp)
        return 0;
    const Vec3 to = room_.lamp->position - place;
    const double distance = length(to);
    return room_.lamp->flux_lm / (4 * pi) * std::fmax(0, dot(to, normal)) / std::pow(distance, 3);
}

double BoxRadiosity::mean_direct(const Patch& patch) const
{
    constexpr int nodes = 3;
    double sum = 0;
    for (const QuadratureNode& u : gauss_legendre(nodes, 0, 1))
        for (const QuadratureNode& v : gauss_legendre(nodes, 0, 1))
            sum += u.weight * v.weight * direct(patch.at(u.x, v.x), patch.normal);
    return sum;
}

/// The part of a patch that the partition hides: within the pyramid from the place through its outline.
double BoxRadiosity::hidden_factor(const Point& place, const Direction& normal, const Patch& patch) const
{
    const RadiosityRoom::Partition& sheet = *room_.partition;
    const Point outline[] = {
        {0, sheet.y, 0}, {room_.size.x, sheet.y, 0}, {room_.size.x, sheet.y, sheet.height}, {0, sheet.y, sheet.height}};
    const Vec3 middle = Point{0.5 * room_.size.x, sheet.y, 0.5 * sheet.height} - place;
    std::vector<Vec3> part;
    for (const Point& corner : patch.corners)
        part.push_back(corner - place);
    for (std::size_t i = 0; i < 4 && !part.empty(); ++i) {
        const Vec3 side = cross(outline[i] - place, outline[(i + 1) % 4] - place);
        part = front_part(part, dot(side, middle) > 0 ? side : -side);
    }
    return part.size() < 3 ? 0 : std::fabs(polygon_illuminance(part, 1 / pi, {}, normal));
}

double BoxRadiosity::factor(const Point& place, const Direction& normal, const Patch& patch) const
{
    if (dot(patch.normal, place - patch.middle) <= 0)
        return 0;
    const double whole = polygon_illuminance(patch.corners, 1 / pi, place, normal);
    if (!room_.partition || whole <= 0)
        return whole;
    const double y = room_.partition->y, at = place.y - y, of = patch.middle.y - y;
    if (std::fabs(at) < 1e-9) // in the partition: the horizon parts the sides
        return (of > 0) == (normal.y > 0) || of == 0 ? whole : 0;
    return at * of < 0 ? std::fmax(0, whole - hidden_factor(place, normal, patch)) : whole;
}

double BoxRadiosity::mean_hidden(const Patch& patch, const Patch& other) const
{
    constexpr int nodes = 3;
    double sum = 0;
    for (const QuadratureNode& u : gauss_legendre(nodes, 0, 1))
        for (const QuadratureNode& v : gauss_legendre(nodes, 0, 1))
            sum += u.weight * v.weight * hidden_factor(patch.at(u.x, v.x), patch.normal, other);
    return sum;
}

/// Flux from patch to patch per radiosity, [i * n + k].
std::vector<double> BoxRadiosity::exchange() const
{
    const std::size_t n = patches_.size();
    std::vector<double> flux(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 1; k < n; ++k) {
            const Patch &one = patches_[i], &other = patches_[k];
            const bool see = dot(one.normal, other.middle - one.middle) > 1e-9 &&
                             dot(other.normal, one.middle - other.middle) > 1e-9;
            if (!see)
                continue;
            double between = exchange_area(one.rectangle(), other.rectangle());
            if (room_.partition && (one.middle.y - room_.partition->y) * (other.middle.y - room_.partition->y) < 0)
                between -= 0.5 * (one.area * mean_hidden(one, other) + other.area * mean_hidden(other, one));
            flux[i * n + k] = flux[k * n + i] = std::fmax(0, between);
        }
    if (room_.partition)
        close(flux);
    return flux;
}

/// What is hidden is known to about a thousandth: scaling rows and columns alike makes that no patch loses light.
void BoxRadiosity::close(std::vector<double>& flux) const
{
    const std::size_t n = patches_.size();
    std::vector<double> scale(n, 1);
    constexpr int rounds = 50;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k)
                sum += flux[i * n + k] * scale[k];
            scale[i] = std::sqrt(scale[i] * patches_[i].area / sum); // half way: the other half falls to the partners
        }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            flux[i * n + k] *= scale[i] * scale[k];
}

void BoxRadiosity::solve()
{
    const std::size_t n = patches_.size();
    const std::vector<double> flux = exchange();
    std::vector<double> own(n);
    for (std::size_t i = 0; i < n; ++i) {
        own[i] = mean_direct(patches_[i]);
        patches_[i].radiosity = patches_[i].own;
    }
    constexpr int most_sweeps = 1000;
    constexpr double settled = 1e-9;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double change = 0, size = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k)
                sum += flux[i * n + k] * patches_[k].radiosity;
            sum = own[i] + sum / patches_[i].area;
            change = std::max(change, std::fabs(sum - patches_[i].illuminance));
            size = std::max(size, sum);
            patches_[i].illuminance = sum;
            patches_[i].radiosity = patches_[i].own + patches_[i].reflectance * sum;
        }
        if (change <= settled * size)
            return;
    }
}

double BoxRadiosity::gathered(const Point& place, const Direction& normal) const
{
    double sum = direct(place, normal);
    for (const Patch& patch : patches_)
        sum += patch.radiosity * factor(place, normal, patch);
    return sum;
}

double BoxRadiosity::at(const Point& place, const Direction& normal) const
{
    // Patches that are large beside their distance are looked at in parts, each with what it gathers itself.
    constexpr double near = 0.5;
    constexpr int parts = 6;
    double sum = direct(place, normal);
    for (const Patch& patch : patches_) {
        const double whole = factor(place, normal, patch);
        if (whole <= 0)
            continue;
        if (patch.reflectance <= 0 || std::sqrt(patch.area) < near * length(patch.middle - place)) {
            sum += patch.radiosity * whole;
            continue;
        }
        for (int i = 0; i < parts; ++i)
            for (int k = 0; k < parts; ++k) {
                const Patch part = patch.part(i, k, parts);
                const double seen = factor(place, normal, part);
                if (seen > 0)
                    sum += seen * (patch.own + patch.reflectance * gathered(part.middle, part.normal));
            }
    }
    return sum;
}

double BoxRadiosity::mean(const std::string& face) const
{
    double sum = 0, area = 0;
    for (const Patch& patch : patches_)
        if (faces_[patch.face].frame.name == face) {
            sum += patch.area * patch.illuminance;
            area += patch.area;
        }
    return sum / area;
}

} // namespace lightwell
