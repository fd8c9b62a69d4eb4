#include "materials/material.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "materials/bright_colours.h"
#include "materials/dielectric.h"
#include "materials/thin_glass.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// A highlight of this power is narrower than 0.01 degrees.
constexpr double largest_power = 1e9;

/// The checks of one material, each with the name it is called by in messages.
class Checks {
public:
    Checks(const std::string& place, bool patterned) : place_(place), patterned_(patterned) {}

    void fraction(const char* name, double value) const
    {
        if (!(value >= 0 && value <= 1))
            fail(name, value, "in [0, 1]", "a surface cannot give back more light than it gets");
    }
    void fractions(const char* name, const Spectrum& s) const
    {
        for (int channel = 0; channel < 3; ++channel)
            if (!(s[channel] >= 0 && s[channel] <= 1))
                fail(channel_of(name, channel), s[channel], "in [0, 1]",
                     "a surface cannot give back more light than it gets");
    }
    /// What a pattern multiplies.
    void colour(const char* name, const Spectrum& s) const
    {
        if (!patterned_)
            return fractions(name, s);
        for (int channel = 0; channel < 3; ++channel)
            if (!(s[channel] >= 0 && std::isfinite(s[channel])))
                fail(channel_of(name, channel), s[channel], ">= 0 and finite", "the pattern multiplies it");
    }
    void index(double value) const
    {
        if (!(value > 0 && std::isfinite(value)))
            fail("refractive index", value, "> 0", "glass has 1.52, water 1.33");
    }
    void radiance(const Spectrum& s) const
    {
        for (int channel = 0; channel < 3; ++channel)
            if (!(s[channel] >= 0 && std::isfinite(s[channel])))
                fail(channel_of("radiance", channel), s[channel], ">= 0 and finite", "give it in W/(m^2 sr)");
    }
    void finite(const char* name, double value) const
    {
        if (!std::isfinite(value))
            fail(name, value, "finite", "");
    }
    [[noreturn]] void fail(const std::string& name, double value, const std::string& expected,
                           const std::string& hint) const
    {
        const std::string shown = std::isnan(value) ? "not a number" : shortest(value);
        throw InputError(place_, name + " is " + shown + ", expected " + expected, hint);
    }

private:
    static std::string channel_of(const char* name, int channel)
    {
        return (channel == 0 ? "red " : channel == 1 ? "green " : "blue ") + std::string(name);
    }
    const std::string& place_;
    bool patterned_;
};

void check(const Checks& checks, const Plastic& m)
{
    checks.colour("reflectance", m.colour);
    checks.fraction("specularity", m.specularity);
    checks.fraction("roughness", m.roughness);
}

void check(const Checks& checks, const Metal& m)
{
    checks.colour("reflectance", m.colour);
    checks.fraction("specularity", m.specularity);
    checks.fraction("roughness", m.roughness);
}

void check(const Checks& checks, const Trans& m)
{
    checks.colour("colour", m.colour);
    checks.fraction("specularity", m.specularity);
    checks.fraction("roughness", m.roughness);
    checks.fraction("transmission", m.transmission);
    checks.fraction("transmitted specular share", m.transmitted_specular);
}

void check(const Checks& checks, const Dielectric& m)
{
    checks.fractions("transmission per metre", m.transmission_per_m);
    checks.index(m.index);
    checks.finite("Hartmann's constant", m.hartmann);
    constexpr double mean_wavelength_nm = 500;
    checks.index(m.index + m.hartmann / mean_wavelength_nm);
}

void check(const Checks& checks, const Glass& m)
{
    checks.colour("transmissivity", m.transmissivity);
    checks.index(m.index);
}

void check(const Checks& checks, const Mirror& m)
{
    checks.colour("reflectance", m.reflectance);
}

void check(const Checks& checks, const Light& m)
{
    checks.radiance(m.radiance);
}

void check(const Checks& checks, const Illum& m)
{
    checks.radiance(m.radiance);
}

void check(const Checks& checks, const Glow& m)
{
    checks.radiance(m.radiance);
    if (std::isnan(m.max_radius_m))
        checks.fail("maximum radius", m.max_radius_m, "a length in metres", "0 has no shadow rays");
}

void check(const Checks& checks, const Spotlight& m)
{
    checks.radiance(m.radiance);
    if (!(m.full_angle_deg > 0 && m.full_angle_deg <= 360))
        checks.fail("full angle", m.full_angle_deg, "in (0, 360] degrees", "give the whole cone, not its half");
    for (int axis = 0; axis < 3; ++axis)
        checks.finite("component of the aim", m.aim[axis]);
    if (m.aim == Vec3{})
        checks.fail("length of the aim", 0, "> 0", "give the direction of the beam");
}

void check(const Checks& checks, const Brushed& m)
{
    checks.colour("colour", m.colour);
    checks.fraction("specularity", m.specularity);
    checks.fraction("roughness along the grain", m.roughness_u);
    checks.fraction("roughness across the grain", m.roughness_v);
    checks.fraction("transmission", m.transmission);
    checks.fraction("transmitted specular share", m.transmitted_specular);
}

void check(const Checks& checks, const Ashikhmin& m)
{
    checks.colour("diffuse reflectance", m.diffuse);
    checks.fractions("specular reflectance", m.specular);
    for (const double power : {m.power_u, m.power_v})
        if (!(power >= 0 && power <= largest_power))
            checks.fail("power of the highlight", power, "in [0, 1e9]", "the higher, the narrower");
}

void check(const Checks& checks, const Interface& m)
{
    checks.fractions("transmission per metre inside", m.inner_transmission_per_m);
    checks.fractions("transmission per metre outside", m.outer_transmission_per_m);
    checks.index(m.inner_index);
    checks.index(m.outer_index);
}

/// Diffuse parts of the two sides, which share the light with what passes.
void check_sides(const Checks& checks, const Spectrum& front, const Spectrum& back, const Spectrum& through)
{
    checks.fractions("diffuse reflectance of the front", front);
    checks.fractions("diffuse reflectance of the back", back);
    checks.fractions("diffuse transmittance", through);
    checks.fractions("diffuse reflectance of the front and transmittance together", front + through);
    checks.fractions("diffuse reflectance of the back and transmittance together", back + through);
}

void check(const Checks& checks, const Functional& m)
{
    checks.colour("colour", m.colour);
    checks.fraction("specularity", m.specularity);
    checks.fraction("transmission", m.transmission);
    checks.fraction("transmitted specular share", m.transmitted_specular);
    check_sides(checks, m.front, m.back, m.through);
}

void check(const Checks& checks, const Measured& m)
{
    check_sides(checks, m.front, m.back, m.through);
}

void check(const Checks& checks, const Wgmd& m)
{
    check_sides(checks, m.front, m.back, m.through);
}

void check(const Checks&, const Prism&) {}

void check(const Checks& checks, const Antimatter& m)
{
    if (m.erased.empty())
        checks.fail("number of modifiers", 0, "at least 1", "the first is what cut faces are made of, or void");
}

void check(const Checks& checks, const Mist& m)
{
    checks.fractions("albedo", m.albedo);
    for (int channel = 0; channel < 3; ++channel)
        if (!(m.extinction_per_m[channel] >= 0 && std::isfinite(m.extinction_per_m[channel])))
            checks.fail("extinction per metre", m.extinction_per_m[channel], ">= 0 and finite", "");
    if (!(m.eccentricity > -1 && m.eccentricity < 1))
        checks.fail("eccentricity", m.eccentricity, "in (-1, 1)", "0 scatters evenly, 0.9 mostly forwards");
}

/// Mean over diffuse light, 2 times the integral of f(cos) cos, by the midpoint rule: good to a few parts in 1000.
template <class Reflectance>
Spectrum under_diffuse_light(Reflectance at_cosine)
{
    constexpr int steps = 64;
    Spectrum sum;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        sum += at_cosine(cosine) * (2 * cosine / steps);
    }
    return sum;
}

Spectrum typical(const Plastic& m)
{
    return m.colour * (1 - m.specularity) + Spectrum::grey(m.specularity);
}

Spectrum typical(const Metal& m)
{
    return m.colour;
}

Spectrum typical(const Trans& m)
{
    return m.colour * ((1 - m.specularity) * (1 - m.transmission)) + Spectrum::grey(m.specularity);
}

Spectrum typical(const Dielectric& m)
{
    const DielectricBoundary boundary(m.index, true);
    return under_diffuse_light([&](double cosine) { return Spectrum::grey(boundary.reflectance(cosine)); });
}

Spectrum typical(const Glass& m)
{
    const ThinGlass glass(m.transmissivity, m.index);
    return under_diffuse_light([&](double cosine) { return glass.reflectance(cosine); });
}

Spectrum typical(const Mirror& m)
{
    return m.reflectance;
}

Spectrum typical(const Brushed& m)
{
    const Spectrum highlight = m.kind == Brushed::Kind::metal ? m.colour : Spectrum::grey(1);
    return m.colour * ((1 - m.specularity) * (1 - m.transmission)) + highlight * m.specularity;
}

Spectrum typical(const Ashikhmin& m)
{
    return m.specular + m.diffuse * (Spectrum::grey(1) - m.specular);
}

Spectrum typical(const Interface& m)
{
    const DielectricBoundary boundary(m.inner_index / m.outer_index, true);
    return under_diffuse_light([&](double cosine) { return Spectrum::grey(boundary.reflectance(cosine)); });
}

Spectrum typical(const Functional& m)
{
    return m.kind == Functional::Kind::BRTDfunc ? m.front : m.colour * (1 - m.transmission * (1 - m.specularity));
}

Spectrum typical(const Measured& m)
{
    return m.front;
}

Spectrum typical(const Wgmd& m)
{
    return m.front;
}

/// Emitters, and what is no surface.
template <class Other>
Spectrum typical(const Other&)
{
    return {};
}

Spectrum within(const Spectrum& s, double most)
{
    return {std::clamp(s.r, 0.0, most), std::clamp(s.g, 0.0, most), std::clamp(s.b, 0.0, most)};
}

/// Wherever the material keeps its colour.
template <class M>
void multiply(M& material, const Spectrum& colour)
{
    if constexpr (requires { material.through; }) {
        material.front = within(material.front * colour, 1);
        material.back = within(material.back * colour, 1);
        material.through = within(material.through * colour, 1);
    }
    if constexpr (requires { material.diffuse; })
        material.diffuse = within(material.diffuse * colour, 1);
    if constexpr (requires { material.colour; })
        material.colour = within(material.colour * colour, 1);
    else if constexpr (requires { material.transmissivity; })
        material.transmissivity = within(material.transmissivity * colour, 1);
    else if constexpr (requires { material.reflectance; })
        material.reflectance = within(material.reflectance * colour, 1);
    else if constexpr (requires { material.radiance; })
        material.radiance = within(material.radiance * colour, infinity);
}

} // namespace

void validate_material(const Material& material, const std::string& place)
{
    const Checks checks(place, false);
    std::visit([&](const auto& m) { check(checks, m); }, material);
}

void validate_patterned_material(const Material& material, const std::string& place)
{
    const Checks checks(place, true);
    std::visit([&](const auto& m) { check(checks, m); }, material);
}

double hold_saturated_colour(Material& material) noexcept
{
    double most = 0;
    const auto hold = [&](Spectrum& colour) {
        if (!(colour.max() > 1 && colour.is_finite() && photopic(colour) <= 1))
            return;
        most = colour.max();
        colour = {std::min(colour.r, 1.0), std::min(colour.g, 1.0), std::min(colour.b, 1.0)};
    };
    std::visit(
        [&](auto& m) {
            if constexpr (requires { m.colour; })
                hold(m.colour);
            else if constexpr (requires { m.reflectance; })
                hold(m.reflectance);
        },
        material);
    return most;
}

std::string type_name(const Material& material)
{
    // In the order of the alternatives of Material; some have more than one word.
    static constexpr const char* names[] = {
        "plastic", "metal",  "trans",     "dielectric", "glass", "mirror",   "light", "illum",      "glow", "spotlight",
        "",        "ashik2", "interface", "",           "",      "WGMDfunc", "",      "antimatter", "mist"};
    static_assert(std::size(names) == std::variant_size_v<Material>);
    if (const auto* brushed = std::get_if<Brushed>(&material)) {
        static constexpr const char* kinds[] = {"plastic2", "metal2", "trans2"};
        return kinds[static_cast<int>(brushed->kind)];
    }
    if (const auto* functional = std::get_if<Functional>(&material)) {
        static constexpr const char* kinds[] = {"plasfunc", "metfunc",   "transfunc", "plasdata",
                                                "metdata",  "transdata", "BRTDfunc"};
        return kinds[static_cast<int>(functional->kind)];
    }
    if (const auto* measured = std::get_if<Measured>(&material))
        return measured->passes_straight ? "aBSDF" : "BSDF";
    if (const auto* prism = std::get_if<Prism>(&material))
        return prism->rays == 2 ? "prism2" : "prism1";
    return names[material.index()];
}

bool is_emitter(const Material& material) noexcept
{
    return std::visit(
        [](const auto& m) {
            return requires
            {
                m.radiance;
            };
        },
        material);
}

std::vector<std::string> named_modifiers(const Material& material)
{
    std::vector<std::string> names = std::visit(
        [](const auto& m) -> std::vector<std::string> {
            if constexpr (requires { m.alternate; })
                return {m.alternate};
            else if constexpr (requires { m.tints; })
                return {std::begin(m.tints), std::end(m.tints)};
            else if constexpr (requires { m.erased; })
                return m.erased;
            else
                return {};
        },
        material);
    std::erase_if(names, [](const std::string& name) { return name.empty() || name == "void"; });
    return names;
}

Spectrum emitted_radiance(const Material& material) noexcept
{
    return std::visit(
        [](const auto& m) -> Spectrum {
            if constexpr (requires { m.radiance; })
                return m.radiance;
            else
                return {};
        },
        material);
}

Material tinted(const Material& material, const Spectrum& colour) noexcept
{
    Material made = material;
    std::visit([&](auto& m) { multiply(m, colour); }, made);
    return made;
}

Spectrum typical_reflectance(const Material& material) noexcept
{
    return std::visit([](const auto& m) { return typical(m); }, material);
}

} // namespace lightwell
