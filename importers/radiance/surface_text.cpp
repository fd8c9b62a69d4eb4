#include "importers/radiance/surface_text.h"

#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace lightwell::scene_text {
namespace {

/// Relative to the squared size of a polygon: below this its area is rounding.
constexpr double no_area = 1e-14;
/// Thinner than this share of its length is a sliver, which is kept and noted.
constexpr double sliver = 1e-6;
/// Corners may leave the plane by this share of the size before it is noted.
constexpr double planar_enough = 1e-4;

void expect_numbers(const Primitive& primitive, const Words& words, std::size_t expected, const char* meaning)
{
    if (primitive.numbers.size() != expected)
        throw InputError{words.place(primitive),
                         fmt::format("{} numbers, expected {}", primitive.numbers.size(), expected),
                         fmt::format("they are {}", meaning)};
}

Vec3 vector_at(const Primitive& primitive, std::size_t i)
{
    return {primitive.numbers[i], primitive.numbers[i + 1], primitive.numbers[i + 2]};
}

void leave_out(const Primitive& primitive, const Words& words, Report& report, const char* why)
{
    report.add(Finding::ignored, words.place(primitive), why);
}

/// Notes what is odd about a polygon; false when it has no area.
bool check_polygon(const Point* corners, std::size_t count, const Primitive& primitive, const Words& words,
                   Report& report)
{
    const Vec3 area = polygon_area_vector(corners, count);
    double size_squared = 0;
    for (std::size_t i = 1; i < count; ++i)
        size_squared = std::fmax(size_squared, dot(corners[i] - corners[0], corners[i] - corners[0]));
    const double area_m2 = length(area);
    if (!(area_m2 > no_area * size_squared)) {
        leave_out(primitive, words, report, "polygon without area left out");
        return false;
    }
    if (area_m2 < sliver * size_squared)
        report.add(Finding::ignored, words.place(primitive),
                   "sliver, more than a million times longer than wide; kept as it is");
    if (count == 3)
        return true;
    const double bound = planar_enough * std::sqrt(size_squared) * area_m2;
    for (std::size_t i = 1; i < count; ++i)
        if (std::fabs(dot(corners[i] - corners[0], area)) > bound) {
            report.add(Finding::approximated, words.place(primitive),
                       "corners leave their plane by more than 1/10000 of the polygon's size; it is taken as flat");
            break;
        }
    return true;
}

void add_polygon(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    const std::size_t numbers = primitive.numbers.size();
    if (numbers % 3 != 0 || numbers < 9)
        throw InputError{words.place(primitive), fmt::format("{} numbers, expected three for each corner", numbers),
                         "a polygon has at least three corners"};
    const std::size_t first = part.points.size(), count = numbers / 3;
    if (first + count > std::numeric_limits<std::uint32_t>::max())
        throw InputError{words.place(primitive), "more than 4,294,967,295 corners in one part",
                         "divide the scene into files and refer to them by `instance`"};
    for (std::size_t i = 0; i < numbers; i += 3)
        part.points.push_back(vector_at(primitive, i));
    if (!check_polygon(&part.points[first], count, primitive, words, report)) {
        part.points.resize(first);
        return;
    }
    part.surfaces.push_back(
        {Shape::polygon, static_cast<std::uint32_t>(part.polygons.size()), modifier, decoded_name(primitive.name)});
    part.polygons.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
}

void add_sphere(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    expect_numbers(primitive, words, 4, "x y z of the centre, radius");
    const double radius = primitive.numbers[3];
    if (radius == 0)
        return leave_out(primitive, words, report, "sphere of radius 0 left out");
    // As in Radiance, a negative radius turns the surface inside out.
    const bool outwards = (primitive.type == "sphere") == (radius > 0);
    part.add_sphere({vector_at(primitive, 0), std::fabs(radius)}, outwards ? Shape::sphere : Shape::bubble, modifier,
                    decoded_name(primitive.name));
}

struct ConeKind {
    const char* type;
    Shape shape, inside_out;
    bool one_radius;
};
constexpr ConeKind cone_kinds[] = {{"cone", Shape::cone, Shape::cup, false},
                                   {"cup", Shape::cup, Shape::cone, false},
                                   {"cylinder", Shape::cylinder, Shape::tube, true},
                                   {"tube", Shape::tube, Shape::cylinder, true}};

void add_cone(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    const ConeKind* kind = cone_kinds;
    while (primitive.type != kind->type)
        ++kind;
    if (kind->one_radius)
        expect_numbers(primitive, words, 7, "x y z of both ends, radius");
    else
        expect_numbers(primitive, words, 8, "x y z of both ends, radius at each");
    Cone cone{{vector_at(primitive, 0), vector_at(primitive, 3)}, {primitive.numbers[6], primitive.numbers.back()}};
    const auto [r0, r1] = cone.radii;
    if (r0 * r1 < 0)
        throw InputError{words.place(primitive), fmt::format("radii {} and {} have opposite signs", r0, r1),
                         "give both the same sign"};
    if (!(length(cone.ends[1] - cone.ends[0]) > 0) || (r0 == 0 && r1 == 0))
        return leave_out(primitive, words, report, "cone or cylinder of length or radius 0 left out");
    const bool negative = r0 < 0 || r1 < 0;
    for (double& radius : cone.radii)
        radius = std::fabs(radius);
    part.add_cone(cone, negative ? kind->inside_out : kind->shape, modifier, decoded_name(primitive.name));
}

void add_ring(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    expect_numbers(primitive, words, 8, "x y z of the centre, x y z of the normal, both radii");
    const Vec3 normal = vector_at(primitive, 3);
    const double a = primitive.numbers[6], b = primitive.numbers[7];
    if (a < 0 || b < 0 || length(normal) == 0)
        throw InputError{words.place(primitive),
                         fmt::format("radii {} and {}, normal of length {}", a, b, length(normal)),
                         "radii are >= 0 m and the normal is not zero"};
    if (a == b)
        return leave_out(primitive, words, report, "ring of equal radii left out");
    part.add_ring({vector_at(primitive, 0), unit_vector(normal), std::fmin(a, b), std::fmax(a, b)}, modifier,
                  decoded_name(primitive.name));
}

void add_source(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    expect_numbers(primitive, words, 4, "x y z of the direction, full angle in degrees");
    const Vec3 direction = vector_at(primitive, 0);
    double angle = primitive.numbers[3];
    if (length(direction) == 0 || !(angle > 0))
        throw InputError{words.place(primitive),
                         fmt::format("angle {} degrees, direction of length {}", angle, length(direction)),
                         "the angle is in (0, 360] and the direction is not zero"};
    if (angle > 360) {
        report.add(Finding::repaired, words.place(primitive), "a source wider than 360 degrees is taken as 360");
        angle = 360;
    }
    part.add_source({unit_vector(direction), angle}, modifier, decoded_name(primitive.name));
}

/// Text of numbers without a temporary for each.
class NumberText {
public:
    explicit NumberText(std::string& text) : text_(text) {}
    NumberText& operator<<(double value)
    {
        char buffer[32];
        const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
        text_ += ' ';
        text_.append(buffer, result.ptr);
        return *this;
    }
    NumberText& operator<<(const Vec3& v) { return *this << v.x << v.y << v.z; }

private:
    std::string& text_;
};

void append_cone(std::string& text, const Cone& cone, bool one_radius)
{
    text += one_radius ? "7" : "8";
    NumberText numbers(text);
    numbers << cone.ends[0] << cone.ends[1] << cone.radii[0];
    if (!one_radius)
        numbers << cone.radii[1];
}

const char* type_of(Shape shape)
{
    constexpr const char* names[] = {"polygon", "sphere", "bubble", "cone", "cup",     "cylinder",
                                     "tube",    "ring",   "source", "mesh", "instance"};
    return names[static_cast<std::size_t>(shape)];
}

} // namespace

Direction unit_vector(const Vec3& v) noexcept
{
    constexpr double rounding = 1e-15; // what normalized() itself leaves
    return std::fabs(length(v) - 1) <= rounding ? v : normalized(v);
}

void add_surface(Part& part, const Primitive& primitive, ModifierId modifier, const Words& words, Report& report)
{
    if (primitive.type == "polygon")
        add_polygon(part, primitive, modifier, words, report);
    else if (primitive.type == "sphere" || primitive.type == "bubble")
        add_sphere(part, primitive, modifier, words, report);
    else if (primitive.type == "ring")
        add_ring(part, primitive, modifier, words, report);
    else if (primitive.type == "source")
        add_source(part, primitive, modifier, words, report);
    else
        add_cone(part, primitive, modifier, words, report);
}

void append_surface(std::string& text, const Part& part, const Surface& surface, const std::string& modifier)
{
    text.append(modifier).append(" ").append(type_of(surface.shape)).append(" ");
    text.append(encoded_name(surface.name)).append("\n0\n0\n");
    NumberText numbers(text);
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons[surface.index];
        text += std::to_string(3 * static_cast<std::size_t>(polygon.count));
        for (std::uint32_t i = 0; i < polygon.count; ++i) {
            text += '\n';
            numbers << part.points[polygon.first + i];
        }
        break;
    }
    case Shape::sphere:
    case Shape::bubble:
        text += '4';
        numbers << part.spheres[surface.index].centre << part.spheres[surface.index].radius;
        break;
    case Shape::ring: {
        const Ring& ring = part.rings[surface.index];
        text += '8';
        numbers << ring.centre << ring.normal << ring.inner_radius << ring.outer_radius;
        break;
    }
    case Shape::source:
        text += '4';
        numbers << part.sources[surface.index].to_source << part.sources[surface.index].full_angle_deg;
        break;
    default:
        append_cone(text, part.cones[surface.index], surface.shape == Shape::cylinder || surface.shape == Shape::tube);
    }
    text += '\n';
}

} // namespace lightwell::scene_text
