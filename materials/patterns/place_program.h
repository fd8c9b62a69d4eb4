#pragma once

#include "materials/functions/program.h"
#include "materials/patterns/data_table.h"
#include "materials/patterns/place_function.h"

#include <memory>
#include <span>

namespace lightwell {

/// The functions that a material of the scene language names: some of the place alone, some of the direction of the
/// light too.
class PlaceProgram {
public:
    struct What {
        Program at_place;
        Program towards_light; ///< one value or three
        /// Data between the direction and the value; then `towards_light` is of what they give.
        std::shared_ptr<const DataTable> data = nullptr;
        Program coordinates;
    };
    /// @param to_scene  the transform behind the words; a similarity
    PlaceProgram(What what, const Affine& to_scene, PatternText text);
    /// The same functions, moved along with what they are on.
    PlaceProgram(const PlaceProgram& other, const Affine& map);

    /// The values of the place alone; what has no value is 0.
    /// @param values  as many as there are functions, or fewer
    void at(const PatternPlace& place, std::span<double> values) const noexcept;
    /// Three of those values as a direction, in the frame of the scene.
    Vec3 direction(const PatternPlace& place, const Vec3& found) const noexcept;
    /// The values towards `place.to_light`, never negative; one value stands for all three.
    Spectrum towards(const PatternPlace& place) const noexcept;
    std::size_t values_at_place() const noexcept { return what_->at_place.size(); }
    std::size_t values_towards_light() const noexcept { return what_->towards_light.size(); }

    const Affine& to_scene() const noexcept { return to_scene_; }
    const PatternText& text() const noexcept { return *text_; }

    /// More than any material has.
    static constexpr std::size_t most_values = 12;

private:
    Affine to_program(const PatternPlace& place) const noexcept;

    std::shared_ptr<const What> what_;
    std::shared_ptr<const PatternText> text_;
    Affine to_scene_, to_program_;
};

} // namespace lightwell
