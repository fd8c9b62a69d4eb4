#pragma once

#include "engine/ambient/deep_field.h"
#include "engine/ambient/hemisphere.h"

#include <functional>

/// \file Surroundings with closed forms, in the place of a scene.
namespace lightwell {

/// A sphere of radius 1 about the origin, seen from inside. Its wall gets direct light and reflects it.
/// Every point sees all others equally, so that the ambient irradiance is the same everywhere, whatever the direct
/// light: reflectance * mean(direct) / (1 - reflectance).
class SphereRays : public HemisphereRays {
public:
    using DirectLight = std::function<double(const Point&)>;
    SphereRays(const DeepField* deep, double reflectance, DirectLight direct)
        : deep_(deep), reflectance_(reflectance), direct_(std::move(direct))
    {
    }
    static SurfacePlace place_at(const Direction& out) { return {out, -out, 1e-15}; }

    Arrival arrive(const SurfacePlace& from, const Direction& direction, PathRandom& random,
                   std::vector<Dependence>& dependences) const override
    {
        Arrival arrival;
        arrival.met = meet(from, direction);
        Point at = normalized(from.position + direction * arrival.met.distance_m);
        double throughput = 1, reflected = 0;
        for (;;) {
            throughput *= reflectance_;
            reflected += throughput * direct_(at);
            DeepField::Weight found[DeepField::most_weights];
            const std::size_t count = deep_ != nullptr ? deep_->weights(at, -at, found) : 0;
            for (std::size_t i = 0; i < count; ++i)
                dependences.push_back({found[i].site, Spectrum::grey(throughput * found[i].weight)});
            if (count > 0 || throughput < 1e-12)
                break;
            const SurfacePlace here = place_at(at); // nothing is known there: the path goes on
            const Direction on = hemisphere_direction(frame_about(here.normal), random.pair());
            at = normalized(at + on * meet(here, on).distance_m);
        }
        arrival.irradiance = Spectrum::grey(reflected);
        arrival.radiance = arrival.irradiance / pi;
        return arrival;
    }
    bool beside(const SurfacePlace& place, const Vec3& offset, double lift_m, SurfacePlace& found) const override
    {
        const Point flat = place.position + offset;
        found = place_at(normalized(flat));
        return length(found.position - flat) < lift_m;
    }
    Met meet(const SurfacePlace& from, const Direction& direction) const override
    {
        const double distance = std::max(1e-9, -2 * dot(from.position, direction));
        return {distance, -normalized(from.position + direction * distance)};
    }
    DirectIrradiance direct(const SurfacePlace& place, PathRandom&) const override
    {
        return {Spectrum::grey(direct_(place.position)), {}, 0};
    }

private:
    const DeepField* deep_;
    double reflectance_;
    DirectLight direct_;
};

/// A black floor, z = 0, under a ceiling of given radiance. Optionally a black wall, x = 0, that leaves a gap above the
/// floor. Floor and ceiling are endless.
class CeilingRays : public HemisphereRays {
public:
    double height_m = 2;
    std::function<double(const Point&)> radiance; ///< of the ceiling
    double wall_gap_m = infinity;                 ///< infinity: no wall

    static SurfacePlace place_at(double x, double y) { return {{x, y, 0}, {0, 0, 1}, 1e-15}; }

    Arrival arrive(const SurfacePlace& from, const Direction& direction, PathRandom&,
                   std::vector<Dependence>&) const override
    {
        Arrival arrival;
        arrival.met = meet(from, direction);
        const Point at = from.position + direction * arrival.met.distance_m;
        if (at.z > height_m * (1 - 1e-12))
            arrival.radiance = Spectrum::grey(radiance(at));
        arrival.irradiance = arrival.radiance * pi;
        return arrival;
    }
    bool beside(const SurfacePlace& place, const Vec3& offset, double lift_m, SurfacePlace& found) const override
    {
        const double x = place.position.x + offset.x;
        found = place_at(x, place.position.y + offset.y);
        return x * place.position.x > 0 || lift_m < wall_gap_m;
    }
    Met meet(const SurfacePlace& from, const Direction& direction) const override
    {
        const double up = (height_m - from.position.z) / direction.z;
        const double aside = -from.position.x / direction.x;
        const bool meets_wall = aside > 0 && aside < up && from.position.z + aside * direction.z > wall_gap_m;
        return meets_wall ? Met{aside, {direction.x > 0 ? -1.0 : 1.0, 0, 0}} : Met{up, {0, 0, -1}};
    }
    DirectIrradiance direct(const SurfacePlace&, PathRandom&) const override { return {}; }
};

} // namespace lightwell
