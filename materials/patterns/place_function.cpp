#include "materials/patterns/place_function.h"

#include "materials/patterns/channels.h"
#include "materials/patterns/spectral_colour.h"

#include <array>
#include <cmath>

namespace lightwell {
namespace {

/// A length that stands for the way to a distant source.
constexpr double far_away = 1e10;

void put(Channels& channels, std::size_t first, const Vec3& v)
{
    channels[first - 1] = v.x;
    channels[first] = v.y;
    channels[first + 1] = v.z;
}

} // namespace

Channels channels_of(const PatternPlace& place, const Affine& to_pattern) noexcept
{
    const double scale = std::cbrt(std::fabs(to_pattern.determinant()));
    const auto turned = [&](const Vec3& v) { return to_pattern.vector(v) / scale; };
    const double distance = (place.distant ? far_away : place.distance_m) * scale;
    Channels channels{};
    put(channels, 1, turned(place.direction));
    put(channels, 4, turned(place.normal));
    put(channels, 7, place.distant ? Vec3{} : to_pattern.point(place.position));
    channels[9] = distance;
    channels[10] = -dot(place.direction, place.normal);
    channels[11] = scale;
    put(channels, 13, to_pattern.translation);
    put(channels, 16, to_pattern.x / scale);
    put(channels, 19, to_pattern.y / scale);
    put(channels, 22, to_pattern.z / scale);
    channels[24] = distance;
    channels[25] = place.texture.u;
    channels[26] = place.texture.v;
    put(channels, 28, turned(place.normal));
    channels[30] = channels[10];
    channels[31] = channels[32] = channels[33] = 1;
    put(channels, light_channel, turned(place.to_light));
    put(channels, along_u_channel, to_pattern.vector(place.along_u));
    put(channels, along_v_channel, to_pattern.vector(place.along_v));
    return channels;
}

PlaceFunction::PlaceFunction(What what, const Affine& to_scene, PatternText text)
    : what_(std::make_shared<const What>(std::move(what))), text_(std::make_shared<const PatternText>(std::move(text))),
      to_scene_(to_scene), to_pattern_(inverse(to_scene))
{
}

PlaceFunction::PlaceFunction(const PlaceFunction& other, const Affine& map)
    : what_(other.what_), text_(other.text_), to_scene_(compose(map, other.to_scene_)), to_pattern_(inverse(to_scene_))
{
}

Spectrum PlaceFunction::at(const PatternPlace& place) const noexcept
{
    if (const auto* constant = std::get_if<Constant>(what_.get()))
        return constant->value;
    if (const auto* by_formula = std::get_if<Formula>(what_.get()))
        return formula(*by_formula, place);
    if (const auto* by_table = std::get_if<Table>(what_.get()))
        return table(*by_table, place);
    if (const auto* by_wavelength = std::get_if<Spectral>(what_.get()))
        return spectral(*by_wavelength, place);
    return letters(std::get<Letters>(*what_), place);
}

Affine PlaceFunction::to_pattern(const PatternPlace& place) const noexcept
{
    return place.to_part != nullptr ? compose(to_pattern_, *place.to_part) : to_pattern_;
}

Vec3 PlaceFunction::bend_at(const PatternPlace& place) const noexcept
{
    const Spectrum found = at(place);
    const Vec3 bend{found.r, found.g, found.b};
    const Affine map = to_pattern(place);
    // Of a similarity the transposed matrix turns back, up to its scale.
    const Vec3 turned{dot(map.x, bend), dot(map.y, bend), dot(map.z, bend)};
    return turned / std::cbrt(std::fabs(map.determinant()));
}

Spectrum PlaceFunction::checked(const double* values, std::size_t count, bool good) const noexcept
{
    double found[3];
    for (std::size_t i = 0; i < 3; ++i) {
        found[i] = values[i < count ? i : count - 1];
        if (!std::isfinite(found[i])) {
            found[i] = 0;
            good = false;
        }
    }
    if (!good)
        failures_.fetch_add(1, std::memory_order_relaxed);
    return {found[0], found[1], found[2]};
}

Spectrum PlaceFunction::formula(const Formula& formula, const PatternPlace& place) const noexcept
{
    double values[3];
    const bool good = formula.values.evaluate(channels_of(place, to_pattern(place)), {values, formula.values.size()});
    return checked(values, formula.values.size(), good);
}

Spectrum PlaceFunction::table(const Table& table, const PatternPlace& place) const noexcept
{
    Channels channels = channels_of(place, to_pattern(place));
    double coordinates[DataTable::most_dimensions];
    bool good = table.coordinates.evaluate(channels, {coordinates, table.coordinates.size()});
    double* found = channels.data() + (value_channel - 1);
    if (table.picture != nullptr) {
        const Spectrum colour = table.picture->at(coordinates[0], coordinates[1]);
        found[0] = colour.r;
        found[1] = colour.g;
        found[2] = colour.b;
    }
    for (std::size_t i = 0; i < table.data.size(); ++i)
        found[i] = table.data[i]->at(coordinates);
    double values[3];
    good = table.values.evaluate(channels, {values, table.values.size()}) && good;
    return checked(values, table.values.size(), good);
}

Spectrum PlaceFunction::spectral(const Spectral& spectral, const PatternPlace& place) const noexcept
{
    Channels channels = channels_of(place, to_pattern(place));
    double coordinates[DataTable::most_dimensions];
    bool good = spectral.coordinates.evaluate(channels, {coordinates, spectral.coordinates.size()});
    const Spectrum colour = spectral_colour([&](double nm) {
        if (!(nm >= spectral.least_nm && nm <= spectral.most_nm))
            return 0.0;
        double value = 0;
        channels[wavelength_channel - 1] = nm;
        if (spectral.data != nullptr) {
            coordinates[spectral.coordinates.size()] = nm;
            channels[value_channel - 1] = spectral.data->at(coordinates);
        }
        good = spectral.value.evaluate(channels, {&value, 1}) && good;
        return value;
    });
    const double values[] = {colour.r, colour.g, colour.b};
    return checked(values, 3, good);
}

Spectrum PlaceFunction::letters(const Letters& letters, const PatternPlace& place) const noexcept
{
    return letters.lettering.covers(to_pattern(place).point(place.position)) ? letters.inside : letters.outside;
}

} // namespace lightwell
