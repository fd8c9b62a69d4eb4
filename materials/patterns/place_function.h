#pragma once

#include "engine/base/spectrum.h"
#include "engine/base/transform.h"
#include "materials/functions/program.h"
#include "materials/patterns/data_table.h"
#include "materials/patterns/lettering.h"
#include "materials/patterns/pattern_place.h"
#include "materials/patterns/picture_table.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lightwell {

/// How a pattern stands in scene text, its transform left out.
struct PatternText {
    std::string type; ///< `colorfunc`, ...
    std::vector<std::string> words;
    std::vector<double> numbers;
    std::vector<std::pair<std::size_t, std::string>> files; ///< words that name files, and where those were found
    std::string contents;                                   ///< of all its files, or a number that stands for them
    std::vector<std::pair<std::size_t, std::string>> made;  ///< words that name files which are nowhere yet: their text
};

/// A colour, a brightness, a displacement or a share that varies from place to place.
class PlaceFunction {
public:
    struct Constant {
        Spectrum value;
    };
    struct Formula {
        Program values;
    };
    /// Coordinates by function, then values from data or a picture, then each by a function again.
    struct Table {
        Program coordinates;
        std::vector<std::shared_ptr<const DataTable>> data; ///< one for each value
        std::shared_ptr<const PictureTable> picture;        ///< in place of data
        Program values;                                     ///< of channels: one for each table
    };
    struct Letters {
        Lettering lettering;
        Spectrum inside, outside;
    };
    /// A function of the wavelength, or of the value that data have there; reduced to a colour at each place.
    struct Spectral {
        Program coordinates;                   ///< of the data, the wavelength left out; none without data
        std::shared_ptr<const DataTable> data; ///< null: `value` is of the place and the wavelength alone
        Program value;
        double least_nm, most_nm; ///< outside of which it is 0
    };
    using What = std::variant<Constant, Formula, Table, Letters, Spectral>;

    /// @param to_scene  the transform behind the words: where the pattern lies; a similarity
    PlaceFunction(What what, const Affine& to_scene, PatternText text);
    /// The same pattern, moved along with what it is on.
    PlaceFunction(const PlaceFunction& other, const Affine& map);

    /// @return three values; of a function of one value all are that one. What has no value is 0 and counted.
    Spectrum at(const PatternPlace& place) const noexcept;
    /// The three values of a texture as a vector in the world: a pattern's frame turns along, its scale does not count.
    Vec3 bend_at(const PatternPlace& place) const noexcept;
    /// Whether it is the same everywhere.
    bool is_constant() const noexcept { return std::holds_alternative<Constant>(*what_); }
    /// Evaluations that came to no number.
    std::uint64_t failures() const noexcept { return failures_.load(std::memory_order_relaxed); }

    const Affine& to_scene() const noexcept { return to_scene_; }
    const PatternText& text() const noexcept { return *text_; }

private:
    Spectrum formula(const Formula& formula, const PatternPlace& place) const noexcept;
    Spectrum table(const Table& table, const PatternPlace& place) const noexcept;
    Spectrum spectral(const Spectral& spectral, const PatternPlace& place) const noexcept;
    Spectrum letters(const Letters& letters, const PatternPlace& place) const noexcept;
    Affine to_pattern(const PatternPlace& place) const noexcept;
    Spectrum checked(const double* values, std::size_t count, bool good) const noexcept;

    std::shared_ptr<const What> what_;
    std::shared_ptr<const PatternText> text_;
    Affine to_scene_, to_pattern_;
    mutable std::atomic<std::uint64_t> failures_{0};
};

} // namespace lightwell
