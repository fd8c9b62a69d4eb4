#include "engine/plan/needs.h"

#include "materials/bsdf.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Wider distant sources count as sky (engine/sources has the same border).
constexpr double widest_sun_deg = 12;
/// A surface of less than this share of the area does not decide how many bounces matter.
constexpr double notable_area_share = 0.01;
/// Beyond this nothing is gained by counting: roulette ends paths.
constexpr int most_bounces = 10000;

bool is_grey(Spectrum s) noexcept
{
    return s.r == s.g && s.g == s.b;
}

/// All colours that a material holds are grey.
bool is_grey(const Material& material) noexcept
{
    const Lobes lobes = Bsdf(material, true).lobes();
    bool grey = is_grey(emitted_radiance(material)) && is_grey(typical_reflectance(material)) &&
                is_grey(lobes.diffuse_reflectance) && is_grey(lobes.diffuse_transmittance);
    if (const auto* glass = std::get_if<Glass>(&material))
        grey = grey && is_grey(glass->transmissivity);
    if (const auto* body = std::get_if<Dielectric>(&material))
        grey = grey && is_grey(body->transmission_per_m);
    return grey;
}

/// Flux of one square metre at unit radiance on one side: pi, within a spotlight's cone its share.
double projected_cone_sr(const Material& material) noexcept
{
    const auto* spot = std::get_if<Spotlight>(&material);
    if (spot == nullptr || spot->full_angle_deg >= 180)
        return pi;
    const double s = std::sin(0.5 * spot->full_angle_deg * radians_per_degree);
    return pi * s * s;
}

class Finder {
public:
    explicit Finder(const Scene& scene) : scene_(scene) {}

    void add(ModifierId modifier, const Usage& usage)
    {
        needs.surfaces += usage.surfaces;
        needs.area_m2 += usage.area_m2;
        const ResolvedMaterial resolved = resolve(scene_, modifier);
        if (resolved.material == nullptr)
            return;
        const Material& material = *resolved.material;
        needs.patterned |= resolved.brightness != nullptr || resolved.varies;
        needs.grey = needs.grey && is_grey(material) && !resolved.varies; // a pattern may have colours
        if (is_emitter(material))
            add_lamp(material, usage);
        else
            add_scattering(material, usage);
    }

    void add_distant(const DistantSource& source, ModifierId modifier)
    {
        const ResolvedMaterial resolved = resolve(scene_, modifier);
        if (resolved.material == nullptr || emitted_radiance(*resolved.material).is_black())
            return;
        needs.patterned |= resolved.brightness != nullptr || resolved.varies;
        needs.grey = needs.grey && is_grey(*resolved.material) && !resolved.varies;
        (source.full_angle_deg > widest_sun_deg ? needs.wide_sources : needs.suns) += 1;
    }

    SceneNeeds finished()
    {
        for (Need* need : {&needs.diffuse_reflection, &needs.diffuse_transmission, &needs.glossy, &needs.smooth,
                           &needs.panes, &needs.bodies, &needs.planar_mirrors, &needs.curved_mirrors})
            if (need->usage.area_m2 > 0)
                need->reflectance /= need->usage.area_m2;
        if (reflecting_m2_ > 0)
            needs.mean_reflectance = reflected_m2_ / reflecting_m2_;
        for (const auto& [reflectance, area] : reflectances_)
            if (area >= notable_area_share * reflecting_m2_)
                needs.highest_reflectance = std::max(needs.highest_reflectance, reflectance);
        needs.prototypes = scene_.prototypes.size();
        return needs;
    }

    SceneNeeds needs;

private:
    /// The reflectance is kept as a sum over area until finished().
    static void add_need(Need& need, const Usage& usage, double reflectance)
    {
        need.usage += usage;
        need.reflectance += reflectance * usage.area_m2;
    }

    void add_lamp(const Material& material, const Usage& usage)
    {
        const double radiance = photopic(emitted_radiance(material));
        if (!(radiance > 0) || usage.area_m2 == 0) // distant ones are added apart
            return;
        needs.lamps += usage;
        needs.lamp_flux_lm += lumens_per_watt * radiance * usage.area_m2 * projected_cone_sr(material);
        if (std::holds_alternative<Spotlight>(material))
            needs.spotlights += usage;
        if (std::holds_alternative<Illum>(material))
            needs.illums += usage;
        if (std::holds_alternative<Glow>(material))
            needs.glows += usage;
    }

    void add_mirror(const Usage& usage, double reflectance)
    {
        const Usage flat{usage.surfaces - usage.curved_surfaces, usage.area_m2 - usage.curved_m2, 0, 0};
        const Usage curved{usage.curved_surfaces, usage.curved_m2, usage.curved_surfaces, usage.curved_m2};
        if (flat.surfaces > 0)
            add_need(needs.planar_mirrors, flat, reflectance);
        if (curved.surfaces > 0)
            add_need(needs.curved_mirrors, curved, reflectance);
    }

    void add_scattering(const Material& material, const Usage& usage)
    {
        const double reflectance = photopic(typical_reflectance(material));
        if (const auto* glass = std::get_if<Glass>(&material)) {
            add_need(needs.panes, usage, photopic(glass->transmissivity));
            return;
        }
        if (std::holds_alternative<Dielectric>(material) || std::holds_alternative<Interface>(material)) {
            add_need(needs.bodies, usage, reflectance);
            return;
        }
        if (std::holds_alternative<Mist>(material) || std::holds_alternative<Antimatter>(material) ||
            std::holds_alternative<Prism>(material)) {
            needs.passages += usage;
            return;
        }
        reflecting_m2_ += usage.area_m2;
        reflected_m2_ += usage.area_m2 * reflectance;
        reflectances_[reflectance] += usage.area_m2;
        if (std::holds_alternative<Mirror>(material)) {
            add_mirror(usage, reflectance);
            return;
        }
        const Lobes lobes = Bsdf(material, true).lobes();
        if (!lobes.diffuse_reflectance.is_black())
            add_need(needs.diffuse_reflection, usage, photopic(lobes.diffuse_reflectance));
        if (!lobes.diffuse_transmittance.is_black())
            add_need(needs.diffuse_transmission, usage, photopic(lobes.diffuse_transmittance));
        const double rest = std::max(0.0, reflectance - photopic(lobes.diffuse_reflectance));
        if (lobes.glossy)
            add_need(needs.glossy, usage, rest);
        if (lobes.delta)
            add_need(needs.smooth, usage, rest);
    }

    const Scene& scene_;
    double reflecting_m2_ = 0, reflected_m2_ = 0;
    std::map<double, double> reflectances_; ///< area by reflectance
};

} // namespace

SceneNeeds needs_of(const Scene& scene)
{
    Finder finder(scene);
    for (const auto& [modifier, usage] : usage_by_modifier(scene))
        finder.add(modifier, usage);
    for (const Surface& surface : scene.root.surfaces)
        if (surface.shape == Shape::source)
            finder.add_distant(scene.root.sources[surface.index], surface.modifier);
    return finder.finished();
}

int bounces_that_matter(double reflectance, double share) noexcept
{
    if (!(reflectance > 0) || !(share < 1))
        return 0;
    if (!(reflectance < 1) || !(share > 0))
        return most_bounces;
    return static_cast<int>(std::fmin(std::ceil(std::log(share) / std::log(reflectance)), most_bounces));
}

} // namespace lightwell
