#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/scene/patterned.h"
#include "engine/scene/scene.h"
#include "materials/bright_colours.h"

#include <fmt/format.h>

namespace lightwell {
namespace {

[[noreturn]] void reject(const std::string& place, const std::string& what, const std::string& hint = {})
{
    throw InputError{place, what, hint};
}

std::string at(const Part& part, const Surface& surface)
{
    return fmt::format("{}: surface \"{}\"", part.name.empty() ? "scene" : part.name, surface.name);
}

/// Mixtures branch, so that their circles are looked for depth first.
class MixtureCircles {
public:
    explicit MixtureCircles(const Scene& scene) : scene_(scene), state_(scene.modifiers.size(), State::unknown) {}
    void check(ModifierId id, int depth = 0)
    {
        constexpr int deepest = 200;
        if (id == void_modifier)
            return;
        State& state = state_[static_cast<std::size_t>(id)];
        const Modifier& modifier = scene_.modifiers[static_cast<std::size_t>(id)];
        if (state == State::open || depth > deepest)
            reject(fmt::format("modifier \"{}\"", modifier.name), "mixtures mix each other in a circle, or too deep",
                   "let one of them name a material");
        if (state == State::done)
            return;
        state = State::open;
        for (ModifierId step = id; step != void_modifier;) {
            const Modifier& now = scene_.modifiers[static_cast<std::size_t>(step)];
            if (const auto* varying = std::get_if<Varying>(&now.what)) {
                check(varying->foreground, depth + 1);
                check(varying->background, depth + 1);
            }
            const auto* alias = std::get_if<Alias>(&now.what);
            step = alias && alias->target != void_modifier ? alias->target : now.parent;
        }
        state = State::done;
    }

private:
    enum class State : char { unknown, open, done };
    const Scene& scene_;
    std::vector<State> state_;
};

void check_varying(const Varying& varying, const std::string& place, ModifierId count)
{
    if (varying.function == nullptr)
        reject(place, "its function is missing");
    for (const ModifierId mixed : {varying.foreground, varying.background})
        if (mixed < void_modifier || mixed >= count)
            reject(place, "mixes a modifier that does not exist");
}

void check_modifiers(const Scene& scene)
{
    const auto count = static_cast<ModifierId>(scene.modifiers.size());
    for (ModifierId i = 0; i < count; ++i) {
        const Modifier& modifier = scene.modifiers[static_cast<std::size_t>(i)];
        const std::string place = fmt::format("modifier \"{}\"", modifier.name);
        if (const auto* material = std::get_if<Material>(&modifier.what))
            has_pattern(scene, modifier.parent) ? validate_patterned_material(*material, place)
                                                : validate_material(*material, place);
        if (const auto* varying = std::get_if<Varying>(&modifier.what))
            check_varying(*varying, place, count);
        ModifierId step = i;
        for (ModifierId walked = 0; step != void_modifier; ++walked) {
            if (step < void_modifier || step >= count)
                reject(place, "refers to a modifier that does not exist");
            if (walked > count)
                reject(place, "its aliases run in a circle", "let one of them name a material");
            const Modifier& now = scene.modifiers[static_cast<std::size_t>(step)];
            const auto* alias = std::get_if<Alias>(&now.what);
            step = alias && alias->target != void_modifier ? alias->target : now.parent;
        }
    }
    MixtureCircles circles(scene);
    for (ModifierId i = 0; i < count; ++i)
        if (std::holds_alternative<Varying>(scene.modifiers[static_cast<std::size_t>(i)].what))
            circles.check(i);
}

void check_points(const Part& part, const Surface& surface, const Point* points, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        if (!is_finite(points[i]))
            reject(at(part, surface), fmt::format("corner {} is ({}, {}, {}), expected finite numbers", i + 1,
                                                  points[i].x, points[i].y, points[i].z));
}

void check_mesh(const Part& part, const Surface& surface, const Mesh& mesh)
{
    check_points(part, surface, mesh.points.data(), mesh.points.size());
    if (mesh.triangles.size() % 3 != 0)
        reject(at(part, surface), "the number of triangle corners is no multiple of three");
    for (const std::uint32_t corner : mesh.triangles)
        if (corner >= mesh.points.size())
            reject(at(part, surface), fmt::format("triangle corner {} of {} points", corner, mesh.points.size()));
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.points.size())
        reject(at(part, surface), "the numbers of normals and points differ");
    for (const Direction& normal : mesh.normals)
        if (!is_finite(normal))
            reject(at(part, surface), "a normal is not finite");
}

void check_sector(const Part& part, const Surface& surface, const Direction& axis)
{
    const Sector& sector = sector_of(part, surface);
    if (!(sector.sweep_rad > 0))
        reject(at(part, surface), fmt::format("sweep is {}, expected > 0 rad", sector.sweep_rad));
    const double size = length(sector.start), along = dot(sector.start, axis);
    if (!sector.is_whole() && !(std::fabs(size - 1) < 1e-6 && std::fabs(along) < 1e-6))
        reject(at(part, surface),
               fmt::format("start of the sector has length {} and {} along the axis, expected 1 and 0", size, along));
}

/// Refuses a number of a surface that is not what it must be.
struct Expect {
    const Part& part;
    const Surface& surface;
    void operator()(bool good, const std::string& what, double value, const std::string& expected) const
    {
        if (!good)
            reject(at(part, surface), fmt::format("{} is {}, expected {}", what, value, expected));
    }
};

void check_round(const Part& part, const Surface& surface)
{
    const Expect expect{part, surface};
    switch (surface.shape) {
    case Shape::sphere:
    case Shape::bubble: {
        const Sphere& sphere = part.spheres.at(surface.index);
        check_points(part, surface, &sphere.centre, 1);
        expect(sphere.radius > 0 && std::isfinite(sphere.radius), "radius", sphere.radius, "> 0 m");
        break;
    }
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube: {
        const Cone& cone = part.cones.at(surface.index);
        check_points(part, surface, cone.ends, 2);
        for (const double radius : cone.radii)
            expect(radius >= 0 && std::isfinite(radius), "radius", radius, ">= 0 m");
        expect(cone.radii[0] + cone.radii[1] > 0, "sum of the radii", 0, "> 0 m");
        expect(length(cone.ends[1] - cone.ends[0]) > 0, "length", 0, "> 0 m");
        check_sector(part, surface, normalized(cone.ends[1] - cone.ends[0]));
        break;
    }
    case Shape::ring: {
        const Ring& ring = part.rings.at(surface.index);
        check_points(part, surface, &ring.centre, 1);
        expect(std::fabs(length(ring.normal) - 1) < 1e-6, "length of the normal", length(ring.normal), "1");
        expect(ring.inner_radius >= 0 && ring.outer_radius > ring.inner_radius && std::isfinite(ring.outer_radius),
               "outer radius", ring.outer_radius, fmt::format("> inner radius {} >= 0", ring.inner_radius));
        check_sector(part, surface, ring.normal);
        break;
    }
    default:
        break;
    }
}

void check_surface(const Scene& scene, const Part& part, const Surface& surface, std::size_t prototypes_before)
{
    const Expect expect{part, surface};
    if (surface.modifier < void_modifier || surface.modifier >= static_cast<ModifierId>(scene.modifiers.size()))
        reject(at(part, surface), "its modifier does not exist");
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = part.polygons.at(surface.index);
        expect(polygon.count >= 3, "number of corners", polygon.count, "at least 3");
        check_points(part, surface, &part.points.at(polygon.first), polygon.count);
        break;
    }
    case Shape::sphere:
    case Shape::bubble:
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube:
    case Shape::ring:
        check_round(part, surface);
        break;
    case Shape::source: {
        const DistantSource& source = part.sources.at(surface.index);
        expect(std::fabs(length(source.to_source) - 1) < 1e-6, "length of the direction", length(source.to_source),
               "1");
        expect(source.full_angle_deg > 0 && source.full_angle_deg <= 360, "angle", source.full_angle_deg,
               "in (0, 360] degrees");
        break;
    }
    case Shape::mesh:
        check_mesh(part, surface, *part.meshes.at(surface.index));
        break;
    case Shape::instance: {
        const Instance& instance = part.instances.at(surface.index);
        expect(instance.prototype < prototypes_before, "prototype", instance.prototype, "one that comes before");
        try {
            inverse(instance.to_parent);
        } catch (const InputError& error) {
            reject(at(part, surface), error.what());
        }
        break;
    }
    }
}

} // namespace

void validate(const Scene& scene)
{
    check_modifiers(scene);
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
        for (const Surface& surface : scene.prototypes[i].surfaces)
            check_surface(scene, scene.prototypes[i], surface, i);
    for (const Surface& surface : scene.root.surfaces)
        check_surface(scene, scene.root, surface, scene.prototypes.size());
}

} // namespace lightwell
