#include "engine/accel/volumes.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

Volumes::Volumes(const Scene& scene) : volumes_(scene.modifiers.size(), -1), erased_by_(scene.modifiers.size(), 0)
{
    for (std::size_t i = 0; i < scene.modifiers.size(); ++i) {
        const Material* material = resolve(scene, static_cast<ModifierId>(i)).material;
        if (material == nullptr ||
            !(std::holds_alternative<Antimatter>(*material) || std::holds_alternative<Mist>(*material)))
            continue;
        const auto known = std::find(materials_.begin(), materials_.end(), material);
        volumes_[i] = static_cast<int>(known - materials_.begin());
        if (known != materials_.end())
            continue;
        if (materials_.size() == most)
            throw InputError{"modifier \"" + scene.modifiers[i].name + '"', "more than 32 kinds of mist and antimatter",
                             "let volumes share their materials"};
        const auto* antimatter = std::get_if<Antimatter>(material);
        const bool shown = antimatter != nullptr && antimatter->erased.front() != "void";
        cut_faces_.push_back(shown ? scene.find_modifier(antimatter->erased.front()) : void_modifier);
        if (antimatter != nullptr)
            for (std::size_t k = 0; k < scene.modifiers.size(); ++k)
                if (std::find(antimatter->erased.begin(), antimatter->erased.end(), scene.modifiers[k].name) !=
                    antimatter->erased.end())
                    erased_by_[k] |= 1u << materials_.size();
        materials_.push_back(material);
    }
}

InVolumes Volumes::behind(InVolumes in, ModifierId id, bool entering) const noexcept
{
    if (bounds(id)) {
        const std::uint32_t bit = 1u << volume_of(id);
        in.inside = entering ? in.inside | bit : in.inside & ~bit;
    } else if (erased(in, id)) {
        in.bodies += entering ? 1 : -1;
    }
    return in;
}

ModifierId Volumes::cut_face(const InVolumes& in, ModifierId boundary, bool entering) const noexcept
{
    return !entering && in.bodies > 0 && bounds(boundary) ? cut_faces_[static_cast<std::size_t>(volume_of(boundary))]
                                                          : void_modifier;
}

Volumes::Haze Volumes::haze(const InVolumes& in) const noexcept
{
    Haze sum;
    double weight = 0;
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const auto* mist = (in.inside >> i & 1u) != 0 ? std::get_if<Mist>(materials_[i]) : nullptr;
        if (mist == nullptr)
            continue;
        const Spectrum scattered = mist->extinction_per_m * mist->albedo;
        sum.extinction_per_m += mist->extinction_per_m;
        sum.scattering_per_m += scattered;
        sum.eccentricity += photopic(scattered) * mist->eccentricity;
        weight += photopic(scattered);
    }
    sum.eccentricity = weight > 0 ? sum.eccentricity / weight : 0;
    return sum;
}

Spectrum left_by_haze(const Spectrum& extinction_per_m, double length_m) noexcept
{
    const auto left = [&](double extinction) { return extinction > 0 ? std::exp(-extinction * length_m) : 1; };
    return {left(extinction_per_m.r), left(extinction_per_m.g), left(extinction_per_m.b)};
}

} // namespace lightwell
