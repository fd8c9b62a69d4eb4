#include "importers/dxf/deviations.h"

#include <fmt/format.h>

namespace lightwell::dxf {

void DeviationTotal::Sum::add(const Entity& entity, std::size_t more, double distance_m)
{
    if (more > 0 && !first)
        first = &entity;
    count += more;
    largest_m = std::fmax(largest_m, distance_m);
}

void DeviationTotal::add(const Entity& entity, const Deviations& found, double metres_per_unit)
{
    chords_.add(entity, found.chords, found.chord_error * metres_per_unit);
    split_faces_.add(entity, found.split_faces, found.out_of_plane * metres_per_unit);
    limits_.add(entity, found.limit_triangles, found.limit_error * metres_per_unit);
    patterns_.add(entity, found.patterns, 0);
}

void DeviationTotal::report(Report& report) const
{
    constexpr double mm_per_m = 1000;
    if (chords_.count > 0)
        report.add(Finding::approximated, drawing_.place(*chords_.first),
                   fmt::format("curves became {} flat facets, at most {:.3g} mm from the curve", chords_.count,
                               chords_.largest_m * mm_per_m));
    if (split_faces_.count > 0)
        report.add(Finding::approximated, drawing_.place(*split_faces_.first),
                   fmt::format("corners out of plane by up to {:.3g} mm: cut into triangles, four corners into two "
                               "triangles each",
                               split_faces_.largest_m * mm_per_m),
                   split_faces_.count);
    if (limits_.count > 0)
        report.add(Finding::approximated, drawing_.place(*limits_.first),
                   fmt::format("subdivision meshes became {} triangles, at most {:.3g} mm from the smooth surface that "
                               "endless subdivision gives",
                               limits_.count, limits_.largest_m * mm_per_m));
    if (patterns_.count > 0)
        report.add(Finding::assumed, drawing_.place(*patterns_.first),
                   "a hatch of pattern lines is taken as a filled area; map its layer to void to leave it out",
                   patterns_.count);
}

} // namespace lightwell::dxf
