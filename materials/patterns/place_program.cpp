#include "materials/patterns/place_program.h"

#include "materials/patterns/channels.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

PlaceProgram::PlaceProgram(What what, const Affine& to_scene, PatternText text)
    : what_(std::make_shared<const What>(std::move(what))), text_(std::make_shared<const PatternText>(std::move(text))),
      to_scene_(to_scene), to_program_(inverse(to_scene))
{
}

PlaceProgram::PlaceProgram(const PlaceProgram& other, const Affine& map)
    : what_(other.what_), text_(other.text_), to_scene_(compose(map, other.to_scene_)), to_program_(inverse(to_scene_))
{
}

Affine PlaceProgram::to_program(const PatternPlace& place) const noexcept
{
    return place.to_part != nullptr ? compose(to_program_, *place.to_part) : to_program_;
}

void PlaceProgram::at(const PatternPlace& place, std::span<double> values) const noexcept
{
    double all[most_values]{};
    what_->at_place.evaluate(channels_of(place, to_program(place)), {all, what_->at_place.size()});
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = i < what_->at_place.size() && std::isfinite(all[i]) ? all[i] : 0;
}

Vec3 PlaceProgram::direction(const PatternPlace& place, const Vec3& found) const noexcept
{
    const Affine map = to_program(place);
    // Of a similarity the transposed matrix turns back, up to a factor.
    return normalized(Vec3{dot(map.x, found), dot(map.y, found), dot(map.z, found)});
}

Spectrum PlaceProgram::towards(const PatternPlace& place) const noexcept
{
    const std::size_t count = what_->towards_light.size();
    if (count == 0)
        return {};
    Channels channels = channels_of(place, to_program(place));
    if (what_->data != nullptr) {
        double coordinates[DataTable::most_dimensions]{};
        what_->coordinates.evaluate(channels, {coordinates, what_->coordinates.size()});
        channels[value_channel - 1] = what_->data->at(coordinates);
    }
    double values[3]{};
    what_->towards_light.evaluate(channels, {values, count});
    const auto value = [&](std::size_t i) {
        const double found = values[std::min(i, count - 1)];
        return std::isfinite(found) ? std::max(0.0, found) : 0.0;
    };
    return {value(0), value(1), value(2)};
}

} // namespace lightwell
