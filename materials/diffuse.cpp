#include "materials/diffuse.h"

#include "engine/sampling/warps.h"

namespace lightwell {

Direction Diffuse::sample(UnitSquare u) noexcept
{
    return cosine_hemisphere(u);
}

} // namespace lightwell
