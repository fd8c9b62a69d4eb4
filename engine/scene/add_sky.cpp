#include "engine/scene/add_sky.h"

namespace lightwell {

void add_sky(Scene& scene, const SkyModel& sky)
{
    if (sky.with_sun) {
        const ModifierId solar = scene.add_material("solar", Light{Spectrum::grey(sky.sun_radiance)});
        scene.root.add_source({sky.to_sun, sun_full_angle_deg}, solar, "sun");
    }
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
    const ModifierId skyfunc = scene.add_modifier({"skyfunc", brightness, void_modifier});
    const ModifierId glow = scene.add_material("sky_glow", Glow{Spectrum::grey(1), 0}, skyfunc);
    scene.root.add_source({{0, 0, 1}, 180}, glow, "sky");
    scene.root.add_source({{0, 0, -1}, 180}, glow, "ground");
}

} // namespace lightwell
