#include "engine/sky/general_sky.h"

#include "engine/sky/measured_sky.h"

namespace lightwell {
namespace {

constexpr int last_hidden_sun = 6, last_intermediate = 10;

} // namespace

GeneralSky make_general_sky(int number, const SkyOptions& options, const Direction& to_sun)
{
    GeneralSky sky;
    sky.shape = general_sky(number);
    SkyOptions like = options;
    like.kind = number <= last_hidden_sun     ? CieSky::overcast
                : number <= last_intermediate ? CieSky::intermediate
                                              : CieSky::clear;
    like.with_sun = options.with_sun && number > last_hidden_sun;
    const SkyModel model = make_sky(like, to_sun);
    sky.to_sun = model.to_sun;
    sky.ground = model.ground;
    sky.sun_radiance = model.with_sun ? model.sun_radiance : 0;
    const double irradiance = pi * make_measured_sky(like, {}, to_sun).mean;
    sky.normalization = irradiance / sky.shape.integral(sky.to_sun);
    return sky;
}

} // namespace lightwell
