#include "materials/thin_glass.h"

#include "materials/dielectric.h"

#include <cmath>

namespace lightwell {
namespace {

/// One polarization of a slab: r at each surface, t along one passage between them.
double slab_transmittance(double r, double t)
{
    return r < 1 ? (1 - r) * (1 - r) * t / ((1 - r * t) * (1 + r * t)) : 0;
}

double slab_reflectance(double r, double t)
{
    return r < 1 ? r * (1 + (1 - 2 * r) * t * t) / ((1 - r * t) * (1 + r * t)) : 1;
}

template <class OnePolarization>
Spectrum mean_of(const Fresnel& f, Spectrum t, OnePolarization one)
{
    const auto channel = [&](double passage) { return 0.5 * (one(f.senkrecht, passage) + one(f.parallel, passage)); };
    return {channel(t.r), channel(t.g), channel(t.b)};
}

} // namespace

Spectrum ThinGlass::passage(double cos_refracted) const noexcept
{
    if (!(cos_refracted > 0))
        return {};
    const double longer = 1 / cos_refracted; // the oblique path against the normal one
    return {std::pow(transmissivity_.r, longer), std::pow(transmissivity_.g, longer),
            std::pow(transmissivity_.b, longer)};
}

Spectrum ThinGlass::transmittance(double cos_viewer) const noexcept
{
    const Fresnel f = fresnel(cos_viewer, index_);
    return f.total ? Spectrum{} : mean_of(f, passage(f.cos_refracted), slab_transmittance);
}

Spectrum ThinGlass::reflectance(double cos_viewer) const noexcept
{
    const Fresnel f = fresnel(cos_viewer, index_);
    return f.total ? Spectrum::grey(1) : mean_of(f, passage(f.cos_refracted), slab_reflectance);
}

} // namespace lightwell
