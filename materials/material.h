#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/vector.h"
#include "materials/patterns/pattern_place.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace lightwell {

class PlaceProgram;  // materials/patterns/place_program.h
class MeasuredTable; // materials/measured/measured_table.h

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
    std::string alternate = {}; ///< name of the modifier that is seen in its place by all but shadow rays;
                                ///< "void": nothing; empty: the mirror itself
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

/// A direction along a surface: of the grain of brushed metal, upwards on a measured sheet.
struct Grain {
    std::shared_ptr<const PlaceProgram> function; ///< three values, in the frame of the function
    Vec3 direction{}; ///< world, at the place that is looked at (materials/placed.h); 0: not known yet
};
/// Plastic, Metal and Trans with a highlight of two widths.
/// Source  Radiance reference manual, `plastic2`, `metal2`, `trans2`
struct Brushed {
    enum class Kind { plastic, metal, trans } kind = Kind::plastic;
    Spectrum colour;
    double specularity = 0;
    double roughness_u = 0, roughness_v = 0; ///< along the grain and across, [0, 1]
    double transmission = 0, transmitted_specular = 0;
    Grain grain;
};
/// Diffuse surface under a varnish, with a highlight of two widths whose strength rises towards grazing angles.
/// Source  Ashikhmin, Shirley 2000; Radiance reference manual, `ashik2`
struct Ashikhmin {
    Spectrum diffuse, specular;      ///< reflectances, each channel in [0, 1]
    double power_u = 0, power_v = 0; ///< exponents of the cosine lobe, >= 0; the higher, the narrower
    Grain grain;
};
/// Boundary between two solid transparent bodies; the surface normal points out of the inner one.
struct Interface {
    Spectrum inner_transmission_per_m;
    double inner_index = 1.5;
    Spectrum outer_transmission_per_m;
    double outer_index = 1;
};
/// Scattering by functions or data over the direction of the light.
/// Source  Radiance reference manual, `plasfunc` to `BRTDfunc`
struct Functional {
    enum class Kind { plasfunc, metfunc, transfunc, plasdata, metdata, transdata, BRTDfunc } kind = Kind::plasfunc;
    Spectrum colour;                                   ///< of all but BRTDfunc
    double specularity = 0;                            ///< factor of the function, [0, 1]
    double transmission = 0, transmitted_specular = 0; ///< of transfunc and transdata
    Spectrum front, back, through; ///< BRTDfunc: diffuse reflectance of either side, diffuse transmittance
    double scale = 1;              ///< <= 1: what keeps the function from giving back more than it gets
    std::shared_ptr<const PlaceProgram> function;
    PatternPlace place{};      ///< that is looked at, with the normal on the viewer's side
    Spectrum mirrored, passed; ///< BRTDfunc there: shares of the mirrored ray and of the one straight on
};
/// Scattering that was measured or calculated beforehand, in a file.
/// Source  Radiance reference manual, `BSDF`, `aBSDF`
struct Measured {
    bool passes_straight = false; ///< aBSDF: what passes straight is seen sharply
    /// Other than 0: stands for geometry that eyes and shadow rays see instead; the sign tells on which side of the
    /// surface that is (above 0: behind).
    double thickness_m = 0;
    bool is_placed = false;        ///< the functions have been worked out
    Spectrum front, back, through; ///< added diffuse reflectance and transmittance
    std::shared_ptr<const MeasuredTable> table;
    std::string file;
    Grain up; ///< four values with the thickness, three without
};
/// Ward's highlights and diffuse scattering of either side, each by functions of the place.
/// Source  Radiance reference manual, `WGMDfunc`
struct Wgmd {
    std::string tints[3]; ///< modifiers whose patterns colour the highlight, what passes, what passes diffusely
    Spectrum front, back, through;
    Spectrum colours[3] = {Spectrum::grey(1), Spectrum::grey(1), Spectrum::grey(1)}; ///< of `tints`, at the place
    double reflected = 0, reflected_u = 0, reflected_v = 0; ///< at the place: share and roughnesses of the highlight
    double passed = 0, passed_u = 0, passed_v = 0;          ///< of what passes
    Grain grain;                                            ///< nine values: those, then the direction
};
/// Turns each ray into one or two others; lamps have images behind it.
/// Source  Radiance reference manual, `prism1`, `prism2`
struct Prism {
    int rays = 1;                                 ///< 1 or 2
    std::shared_ptr<const PlaceProgram> function; ///< for each ray a share and a direction
    PatternPlace place{};                         ///< that is looked at
};
/// Inside a body of this, surfaces of the named modifiers are not there.
/// Source  Radiance reference manual, `antimatter`
struct Antimatter {
    std::vector<std::string> erased; ///< the first is also what the cut faces are made of; "void": they are not seen
};
/// Boundary of a volume of haze.
/// Source  Radiance reference manual, `mist`; Henyey, Greenstein 1941
struct Mist {
    Spectrum extinction_per_m;        ///< >= 0
    Spectrum albedo;                  ///< share of the extinction that is scattered, [0, 1]
    double eccentricity = 0;          ///< mean cosine of the scattering angle, (-1, 1)
    std::vector<std::string> sources; ///< those that other programs scatter; here all are
};

/// What a surface is made of or sends out: plain numbers, checked by validate_material().
using Material = std::variant<Plastic, Metal, Trans, Dielectric, Glass, Mirror, Light, Illum, Glow, Spotlight, Brushed,
                              Ashikhmin, Interface, Functional, Measured, Wgmd, Prism, Antimatter, Mist>;

/// @param place  file and line, or the material's name, for the message
/// @throws InputError for NaN, reflectance above 1, roughness or transmission outside [0, 1], index <= 0
void validate_material(const Material& material, const std::string& place);

/// Radiance type word: "plastic", "glass", ...
std::string type_name(const Material& material);
/// True for Light, Illum, Glow and Spotlight.
bool is_emitter(const Material& material) noexcept;
/// The modifiers that a material names: what eyes see instead, what is erased, what colours its parts.
std::vector<std::string> named_modifiers(const Material& material);
/// Radiance along the normal of the emitting side; black for what does not emit.
Spectrum emitted_radiance(const Material& material) noexcept;
/// The material under a pattern of this colour: what it reflects, transmits or emits is multiplied, and held within 0
/// and 1, of emitters at 0 or above. The highlight of plastic and trans keeps its own colour, dielectrics theirs.
Material tinted(const Material& material, const Spectrum& colour) noexcept;
/// Hemispherical reflectance under diffuse light, approximately: for tables and proposals, not for transport.
Spectrum typical_reflectance(const Material& material) noexcept;

} // namespace lightwell
