#include "importers/mapped_area.h"

#include "engine/base/frame.h"

#include <algorithm>
#include <array>

namespace lightwell {
namespace {

/// How a map changes area vectors: the matrix of cofactors, M a x M b = cofactors (a x b).
struct AreaMap {
    Vec3 x, y, z;
    explicit AreaMap(const Affine& map) : x(cross(map.y, map.z)), y(cross(map.z, map.x)), z(cross(map.x, map.y)) {}
    double image_size(const Vec3& area) const { return length(x * area.x + y * area.y + z * area.z); }
};

/// Eigenvalues of the symmetric matrix of the scalar products of three vectors, none below 0.
/// Source  the trigonometric solution for symmetric 3 x 3 matrices, Smith 1961
std::array<double, 3> gram_eigenvalues(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), ab = dot(a, b), ac = dot(a, c), bc = dot(b, c);
    const double mean = (aa + bb + cc) / 3, da = aa - mean, db = bb - mean, dc = cc - mean;
    const double spread = std::sqrt((da * da + db * db + dc * dc + 2 * (ab * ab + ac * ac + bc * bc)) / 6);
    if (!(spread > 0))
        return {mean, mean, mean};
    const double determinant = da * (db * dc - bc * bc) - ab * (ab * dc - bc * ac) + ac * (ab * bc - db * ac);
    const double cosine = std::clamp(determinant / (2 * spread * spread * spread), -1.0, 1.0);
    const double angle = std::acos(cosine) / 3, largest = mean + 2 * spread * std::cos(angle);
    const double smallest = mean + 2 * spread * std::cos(angle + 2 * pi / 3);
    return {largest, std::fmax(0, 3 * mean - largest - smallest), std::fmax(0, smallest)};
}

/// Carlson's symmetric elliptic integrals of the first and second kind by duplication; relative error below 1e-12.
/// Source  Carlson 1979, Computing elliptic integrals by duplication
struct Elliptic {
    double first, second;
};

Elliptic carlson(double x, double y, double z)
{
    constexpr double enough = 1e-3; // the series below leaves an error of its sixth power
    double sum = 0, factor = 1, mean = 0;
    for (int step = 0; step < 200; ++step) {
        const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z), lambda = rx * (ry + rz) + ry * rz;
        sum += factor / (rz * (z + lambda));
        factor /= 4;
        x = (x + lambda) / 4;
        y = (y + lambda) / 4;
        z = (z + lambda) / 4;
        mean = (x + y + z) / 3;
        if (std::max({std::fabs(x - mean), std::fabs(y - mean), std::fabs(z - mean)}) < enough * mean)
            break;
    }
    const double dx = (mean - x) / mean, dy = (mean - y) / mean, dz = -dx - dy;
    const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
    const double first = (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
    const double weighted = (x + y + 3 * z) / 5;
    const double ux = (weighted - x) / weighted, uy = (weighted - y) / weighted, uz = (weighted - z) / weighted;
    const double ea = ux * uy, eb = uz * uz, ec = ea - eb, ed = ea - 6 * eb, ef = ed + ec + ec;
    const double series = 1 + ed * (-3.0 / 14 + 9.0 / 88 * ed - 4.5 / 26 * uz * ef) +
                          uz * (ef / 6 + uz * (-9.0 / 22 * ec + uz * 3.0 / 26 * ea));
    return {first, 3 * sum + factor * series / (weighted * std::sqrt(weighted))};
}

/// Mean over all directions n of the length of the image of n under a linear map with these squared singular values.
double mean_stretch(std::array<double, 3> squares)
{
    std::sort(squares.begin(), squares.end());
    const auto [low, middle, high] = squares;
    if (!(high > 0))
        return 0;
    // The image is a line: the formula would divide by zero, its limit is half the length of the line's half axis.
    if (!(middle > 1e-24 * high))
        return std::sqrt(high) / 2;
    // With the middle value in the special place all terms are positive: no digits are lost.
    const auto [first, second] = carlson(low, high, middle);
    return (middle * first - (low - middle) * (high - middle) * second / 3 + std::sqrt(low * high / middle)) / 2;
}

double cone_area_m2(const Cone& cone, const AreaMap& areas)
{
    const Vec3 axis = cone.ends[1] - cone.ends[0];
    const double height = length(axis), widening = cone.radii[1] - cone.radii[0];
    const Frame frame = sector_frame(cone.sector, axis / height);
    // The area vector of a strip between two generators is (mean radius) (height e - widening w) d(angle), with e the
    // outward direction: its image has the same length for all strips of one angle, so one integral over it suffices.
    // Simpson's weights: over a whole turn they converge as fast as equal ones do.
    constexpr int strips = 2048;
    const double sweep = cone.sector.is_whole() ? 2 * pi : cone.sector.sweep_rad;
    const auto weight = [&](int i) { return i == 0 || i == strips ? 1.0 / 3 : i % 2 == 1 ? 4.0 / 3 : 2.0 / 3; };
    double sum = 0;
    for (int i = 0; i <= strips; ++i) {
        const double angle = sweep * i / strips;
        sum += weight(i) *
               areas.image_size((frame.x * std::cos(angle) + frame.y * std::sin(angle)) * height - frame.z * widening);
    }
    return (cone.radii[0] + cone.radii[1]) / 2 * sum * sweep / strips;
}

} // namespace

double mapped_area_m2(const Part& part, const Surface& surface, const Affine& map)
{
    if (const double scale = similarity_scale(map); scale > 0)
        return scale * scale * surface_area_m2(part, surface);
    const AreaMap areas{map};
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[surface.index];
        return areas.image_size(polygon_area_vector(&part.points[polygon.first], polygon.count));
    }
    case Shape::sphere:
    case Shape::bubble: {
        const double r = part.spheres[surface.index].radius;
        return 4 * pi * r * r * mean_stretch(gram_eigenvalues(areas.x, areas.y, areas.z));
    }
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube:
        return cone_area_m2(part.cones[surface.index], areas);
    case Shape::ring: {
        const Ring& ring = part.rings[surface.index];
        return areas.image_size(ring.normal) * surface_area_m2(part, surface);
    }
    case Shape::mesh: {
        const Mesh& mesh = *part.meshes[surface.index];
        double area = 0;
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const Point& a = mesh.points[mesh.triangles[i]];
            area += 0.5 * areas.image_size(
                              cross(mesh.points[mesh.triangles[i + 1]] - a, mesh.points[mesh.triangles[i + 2]] - a));
        }
        return area;
    }
    case Shape::source:
    case Shape::instance:
        break;
    }
    return 0;
}

} // namespace lightwell
