#pragma once

#include "engine/scene/scene.h"
#include "engine/sky/general_sky.h"

namespace lightwell {

/// Adds the sky as the scene language has it: sun (`solar`, `sun`), brightness function `skyfunc`, and two distant
/// glows of 180 degrees, `sky` upwards and `ground` downwards.
void add_sky(Scene& scene, const SkyModel& sky);
/// The same for a general sky: its brightness is that of perezlum.cal, as gendaylit's is.
void add_general_sky(Scene& scene, const GeneralSky& sky);

} // namespace lightwell
