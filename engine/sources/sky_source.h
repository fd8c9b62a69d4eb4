#pragma once

#include "engine/scene/scene.h"
#include "engine/sources/local_source.h"

#include <vector>

namespace lightwell {

/// Radiance of one distant source in a direction; black outside its cone.
Spectrum distant_radiance(const Scene& scene, const VariedMaterials& varied, const DistantSource& source,
                          ModifierId modifier, const Direction& direction) noexcept;

/// Wide distant sources together (sky and ground): sampled from a table of their luminance over all directions.
class SkySource {
public:
    SkySource() = default;
    SkySource(const Scene& scene, const VariedMaterials& varied, std::vector<const Surface*> wide);
    bool empty() const noexcept { return wide_.empty(); }
    Spectrum radiance(const Direction& direction) const noexcept;
    SourceSample sample(UnitSquare u) const noexcept;
    double density_per_sr(const Direction& direction) const noexcept;

private:
    std::size_t cell(const Direction& direction) const noexcept;

    const Scene* scene_ = nullptr;
    const VariedMaterials* varied_ = nullptr;
    std::vector<const Surface*> wide_;
    std::vector<double> summed_; ///< photopic radiance of the cells, all of equal solid angle, up to and including each
};

} // namespace lightwell
