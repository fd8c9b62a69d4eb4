#include "materials/placed.h"

#include "materials/patterns/place_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightwell {
namespace {

/// What the functions of one kind of material give, put where its scattering looks for it.
struct Putter {
    const PatternPlace& place;

    /// The place from the side of the viewer, as functions that scatter see it.
    PatternPlace facing() const
    {
        PatternPlace seen = place;
        if (dot(seen.direction, seen.normal) > 0)
            seen.normal = -seen.normal;
        return seen;
    }
    static Vec3 vector(const double* values) { return {values[0], values[1], values[2]}; }
    void turn(Grain& grain, std::size_t first = 0) const
    {
        double values[PlaceProgram::most_values]{};
        grain.function->at(place, {values, first + 3});
        grain.direction = grain.function->direction(place, vector(values + first));
    }
    void operator()(Brushed& m) const { turn(m.grain); }
    void operator()(Ashikhmin& m) const { turn(m.grain); }
    void operator()(Measured& m) const
    {
        m.is_placed = true;
        if (m.passes_straight)
            return turn(m.up);
        double thickness = 0;
        m.up.function->at(place, {&thickness, 1});
        m.thickness_m = thickness;
        turn(m.up, 1);
    }
    void operator()(Functional& m) const
    {
        m.place = facing();
        if (m.kind != Functional::Kind::BRTDfunc)
            return;
        double values[6]{};
        m.function->at(m.place, values);
        const auto share = [&](std::size_t i) { return std::clamp(values[i], 0.0, 1.0); };
        m.mirrored = {share(0), share(1), share(2)};
        m.passed = {share(3), share(4), share(5)};
    }
    void operator()(Wgmd& m) const
    {
        double values[9]{};
        m.grain.function->at(facing(), values);
        const auto fraction = [&](std::size_t i) { return std::clamp(values[i], 0.0, 1.0); };
        m.reflected = fraction(0);
        m.reflected_u = fraction(1);
        m.reflected_v = fraction(2);
        m.passed = fraction(3);
        m.passed_u = fraction(4);
        m.passed_v = fraction(5);
        m.grain.direction = m.grain.function->direction(place, vector(values + 6));
    }
    void operator()(Prism& m) const { m.place = place; }
    template <class Other>
    void operator()(Other&) const
    {
    }
};

/// Below this a sheet has no thickness.
constexpr double thinnest_m = 1e-7;

Frame along(const Direction& z, const Vec3& x)
{
    const Vec3 across = cross(z, x);
    const double length_across = length(across);
    if (!(length_across > 0)) // no direction along the surface is told: any will do
        return frame_about(z);
    const Direction y = across / length_across;
    return {cross(y, z), y, z};
}

} // namespace

bool stands_for_geometry(const Material& material) noexcept
{
    const auto* measured = std::get_if<Measured>(&material);
    return measured != nullptr && !measured->passes_straight &&
           (!measured->is_placed || std::fabs(measured->thickness_m) > thinnest_m);
}

const std::shared_ptr<const PlaceProgram>* functions_of(const Material& material) noexcept
{
    return std::visit(
        [](const auto& m) -> const std::shared_ptr<const PlaceProgram>* {
            if constexpr (requires { m.grain; })
                return &m.grain.function;
            else if constexpr (requires { m.up; })
                return &m.up.function;
            else if constexpr (requires { m.function; })
                return &m.function;
            else
                return nullptr;
        },
        material);
}

std::shared_ptr<const PlaceProgram>* functions_of(Material& material) noexcept
{
    return const_cast<std::shared_ptr<const PlaceProgram>*>(functions_of(std::as_const(material)));
}

bool depends_on_place(const Material& material) noexcept
{
    const auto* functions = functions_of(material);
    return functions != nullptr && *functions != nullptr;
}

void put_in_place(Material& material, const PatternPlace& place) noexcept
{
    if (depends_on_place(material))
        std::visit(Putter{place}, material);
}

Frame frame_of(const Material& material, const Direction& z) noexcept
{
    return std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.grain; })
                return along(z, m.grain.direction);
            else if constexpr (requires { m.up; })
                return along(z, cross(m.up.direction, z));
            else
                return frame_about(z);
        },
        material);
}

} // namespace lightwell
