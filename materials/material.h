#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/vector.h"

#include <string>
#include <variant>

namespace lightwell {

/// Opaque dielectric-coated diffuse surface: colour of the diffuse part, uncoloured Ward highlight.
/// Diffuse reflectance is colour * (1 - specularity).  Source  Ward 1994, Table; Radiance reference manual, `plastic`
struct Plastic {
    Spectrum colour;        ///< each channel in [0, 1]
    double specularity = 0; ///< fraction reflected specularly, [0, 1]
    double roughness = 0;   ///< rms slope of the facets, [0, 1]; 0 is a mirror-like highlight
};
/// As Plastic, but the highlight takes the colour of the metal.
struct Metal {
    Spectrum colour;
    double specularity = 0;
    double roughness = 0;
};
/// Translucent sheet: of the light that is not specularly reflected, `transmission` passes, and of that
/// `transmitted_specular` without being scattered.  Source  Radiance reference manual, `trans`
struct Trans {
    Spectrum colour;
    double specularity = 0;
    double roughness = 0;
    double transmission = 0;         ///< [0, 1]
    double transmitted_specular = 0; ///< [0, 1]
};
/// Boundary of a solid transparent body; the surface normal points out of the body.
struct Dielectric {
    Spectrum transmission_per_m; ///< fraction left after one metre inside, each channel in [0, 1]
    double index = 1.5;          ///< refractive index against the surroundings, > 0
    double hartmann = 0;         ///< Hartmann's constant, nm: index + hartmann / 500 is used; colours are not spread
};
/// A thin pane, both surfaces and all internal reflections at once; light passes without bending.
struct Glass {
    Spectrum transmissivity; ///< fraction left after one passage at normal incidence inside the pane, [0, 1]
    double index = 1.52;
};
/// Perfect planar reflector; seen by light sources too.
struct Mirror {
    Spectrum reflectance;
};
/// Emitter that is searched for by shadow rays. Front side only (the side the normal points to).
struct Light {
    Spectrum radiance; ///< W/(m^2 sr)
};
/// As Light in what it sends, but meant for secondary sources: eyes see `alternate` instead, when there is one.
struct Illum {
    Spectrum radiance;
    std::string alternate; ///< name of the modifier that eyes see; empty: invisible to eyes
};
/// Emitter for large, dim surfaces: seen and gathered by scattered rays; a shadow ray target within max_radius_m.
struct Glow {
    Spectrum radiance;
    double max_radius_m = 0; ///< 0: never tested by shadow rays in Radiance; here sampled whenever that lowers noise
};
/// Light limited to a cone.
struct Spotlight {
    Spectrum radiance;
    double full_angle_deg = 180; ///< (0, 360]
    Vec3 aim{0, 0, -1};          ///< direction of the beam; its length is the distance to the focal point behind
};

/// What a surface is made of or sends out: plain numbers, checked by validate_material().
using Material = std::variant<Plastic, Metal, Trans, Dielectric, Glass, Mirror, Light, Illum, Glow, Spotlight>;

/// @param place  file and line, or the material's name, for the message
/// @throws InputError for NaN, reflectance above 1, roughness or transmission outside [0, 1], index <= 0
void validate_material(const Material& material, const std::string& place);

/// Radiance type word: "plastic", "glass", ...
std::string type_name(const Material& material);
/// True for Light, Illum, Glow and Spotlight.
bool is_emitter(const Material& material) noexcept;
/// Radiance along the normal of the emitting side; black for what does not emit.
Spectrum emitted_radiance(const Material& material) noexcept;
/// The material under a pattern of this colour: what it reflects, transmits or emits is multiplied, and held within 0
/// and 1, of emitters at 0 or above. The highlight of plastic and trans keeps its own colour, dielectrics theirs.
Material tinted(const Material& material, const Spectrum& colour) noexcept;
/// Hemispherical reflectance under diffuse light, approximately: for tables and proposals, not for transport.
Spectrum typical_reflectance(const Material& material) noexcept;

} // namespace lightwell
