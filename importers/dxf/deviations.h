#pragma once

#include "importers/dxf/shapes.h"

namespace lightwell::dxf {

/// Adds up how far the surfaces of a drawing are from what was drawn, to be noted once.
class DeviationTotal {
public:
    explicit DeviationTotal(const Drawing& drawing) : drawing_(drawing) {}
    /// @param metres_per_unit  of the entity's largest copy in the model
    void add(const Entity& entity, const Deviations& found, double metres_per_unit);
    std::size_t chords() const { return chords_.count; }
    void report(Report& report) const;

private:
    struct Sum {
        std::size_t count = 0;
        double largest_m = 0;
        const Entity* first = nullptr;
        void add(const Entity& entity, std::size_t more, double distance_m);
    };
    const Drawing& drawing_;
    Sum chords_, split_faces_, limits_, patterns_;
};

} // namespace lightwell::dxf
