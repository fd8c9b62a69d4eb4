#include "materials/measured/measured_table.h"

#include "engine/base/xyz_colour.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightwell {

double DirectionTable::around(const DiscPoint& in, double radius) const noexcept
{
    constexpr int count = 16;
    double sum = 0;
    int found = 0;
    for (int i = 0; i < count; ++i) {
        const double turn = 2 * pi * i / count;
        const DiscPoint out{in.x + radius * std::cos(turn), in.y + radius * std::sin(turn)};
        if (out.x * out.x + out.y * out.y < 1) {
            sum += value_per_sr(in, out);
            ++found;
        }
    }
    return found > 0 ? sum / found : 0;
}

namespace {

/// What both sides of a sheet do with light from one direction.
struct Sent {
    double luminous = 0;
    Spectrum colour;
};

void add_hemispherical(const DirectionTable* table, const ColourTables& beside, const DiscPoint& in, Sent& sent)
{
    if (table == nullptr)
        return;
    const double y = table->hemispherical(in);
    sent.luminous += y;
    sent.colour += beside.x == nullptr ? Spectrum::grey(y)
                                       : colour_of_xyz({beside.x->hemispherical(in), y, beside.z->hemispherical(in)});
}

} // namespace

MeasuredTable::MeasuredTable(Parts parts, About about) : parts_(std::move(parts)), about_(std::move(about))
{
    // One way through tells the other by reciprocity.
    const auto exchange = [](const ColourTables& other) {
        return other.x == nullptr ? ColourTables{} : ColourTables{other.x->reversed(), other.z->reversed()};
    };
    if (parts_.from_front == nullptr && parts_.from_back != nullptr) {
        parts_.from_front = parts_.from_back->reversed();
        parts_.beside_from_front = exchange(parts_.beside_from_back);
    }
    if (parts_.from_back == nullptr && parts_.from_front != nullptr) {
        parts_.from_back = parts_.from_front->reversed();
        parts_.beside_from_back = exchange(parts_.beside_from_front);
    }
    hold_energy();
}

void MeasuredTable::hold_energy()
{
    // Reflection and transmission are largest at different angles: both together are asked along a few.
    constexpr int steps = 64;
    std::vector<Sent> along;
    for (const bool front : {true, false})
        for (int i = 0; i < steps * steps; ++i) {
            const double radius = (i / steps + 0.5) / steps, azimuth = 2 * pi * (i % steps) / steps;
            const DiscPoint in{radius * std::cos(azimuth), radius * std::sin(azimuth)};
            Sent& sent = along.emplace_back();
            add_hemispherical(reflection(front), reflection_beside(front), in, sent);
            add_hemispherical(transmission(front), transmission_beside(front), in, sent);
            scale_ = std::fmin(scale_, sent.luminous > 1 ? 1 / sent.luminous : 1);
        }
    const auto most = [](const DirectionTable* table) { return table != nullptr ? table->most_hemispherical() : 0; };
    for (const bool front : {true, false})
        for (const double single : {most(reflection(front)), most(transmission(front))})
            scale_ = std::fmin(scale_, single > 1 ? 1 / single : 1);
    // A single primary above 1 is brought down by paling the colours: their luminance is what files are measured for.
    for (const Sent& sent : along) {
        const double luminous = scale_ * sent.luminous, largest = scale_ * sent.colour.max();
        if (largest > 1)
            saturation_ = std::fmin(saturation_, (1 - luminous) / (largest - luminous));
    }
}

double MeasuredTable::value_per_sr(const Direction& incident, const Direction& out) const noexcept
{
    const bool front = incident.z > 0;
    const DirectionTable* table = front == (out.z > 0) ? reflection(front) : transmission(front);
    return table != nullptr ? scale_ * table->value_per_sr({-incident.x, -incident.y}, {out.x, out.y}) : 0;
}

} // namespace lightwell
