#include "engine/scene/add_sky.h"

#include "materials/patterns/pattern_reader.h"

namespace lightwell {
namespace {

void add_sun(Scene& scene, double radiance, const Direction& to_sun)
{
    const ModifierId solar = scene.add_material("solar", Light{Spectrum::grey(radiance)});
    scene.root.add_source({to_sun, sun_full_angle_deg}, solar, "sun");
}

void add_halves(Scene& scene, Modifier skyfunc)
{
    const ModifierId pattern = scene.add_modifier(std::move(skyfunc));
    const ModifierId glow = scene.add_material("sky_glow", Glow{Spectrum::grey(1), 0}, pattern);
    scene.root.add_source({{0, 0, 1}, 180}, glow, "sky");
    scene.root.add_source({{0, 0, -1}, 180}, glow, "ground");
}

} // namespace

void add_sky(Scene& scene, const SkyModel& sky)
{
    if (sky.with_sun)
        add_sun(scene, sky.sun_radiance, sky.to_sun);
    SkyBrightness brightness{
        SkyBrightness::Kind::overcast, sky.zenith, sky.ground, sky.normalization, sky.to_sun, true};
    switch (sky.kind) {
    case CieSky::clear:
        brightness.kind = SkyBrightness::Kind::clear;
        break;
    case CieSky::intermediate:
        brightness.kind = SkyBrightness::Kind::intermediate;
        break;
    case CieSky::overcast:
        brightness.kind = SkyBrightness::Kind::overcast;
        break;
    case CieSky::uniform:
        brightness.kind = SkyBrightness::Kind::uniform;
        break;
    }
    add_halves(scene, {"skyfunc", brightness, void_modifier});
}

void add_general_sky(Scene& scene, const GeneralSky& sky)
{
    if (sky.sun_radiance > 0)
        add_sun(scene, sky.sun_radiance, sky.to_sun);
    const SkyShape& s = sky.shape;
    const Direction& d = sky.to_sun;
    const auto in_library = [](const std::string&) -> std::optional<std::filesystem::path> { return std::nullopt; };
    const auto untransformed = [](const std::vector<std::string>&, std::size_t) { return Affine{}; };
    auto brightness = PatternReader().read({"brightfunc",
                                            {"skybright", "perezlum.cal"},
                                            {sky.normalization, sky.ground, s.a, s.b, s.c, s.d, s.e, d.x, d.y, d.z},
                                            "sky",
                                            in_library,
                                            untransformed});
    add_halves(scene, {"skyfunc", Varying{Varying::Kind::pattern, std::move(brightness)}, void_modifier});
}

} // namespace lightwell
