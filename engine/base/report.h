#pragma once

#include <cstddef>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace lightwell {

/// What a note is about; stable names, so that a program can look for them.
enum class Finding {
    assumed,      ///< the file does not say; a value was chosen and is named
    repaired,     ///< input was inconsistent and was made usable
    approximated, ///< geometry or a material differs from the original by a stated amount
    ignored,      ///< read, understood, has no meaning for light (a text style, a linetype)
    unsupported,  ///< read, has meaning, not modelled yet
    unmapped,     ///< no rule of the layer map matched; the default was used
    unused,       ///< a rule, material or option had no effect
    converted,    ///< a unit, axis, colour or lamp power was converted; how is named
    question      ///< what the file says is understood, and hard to believe; nothing was changed
};

std::string to_string(Finding finding);

/// One survivable oddity: numbered finding, place, what was done, how many times.
struct Note {
    Finding finding;
    std::string place; ///< file, line and entity of the first occurrence
    std::string text;  ///< what was found and what was done
    std::size_t count = 1;
};

/// Notes in order of appearance; notes with the same finding and text are counted together.
class Report {
public:
    void add(Finding finding, const std::string& place, const std::string& text, std::size_t count = 1);
    void add(const Report& other);
    bool has(Finding finding) const;
    const std::vector<Note>& notes() const { return notes_; }

private:
    std::vector<Note> notes_;
    std::map<std::pair<Finding, std::string>, std::size_t> index_;
};

/// One line a note: `room.dxf:214: assumed: unit is millimetre (12 times)`.
std::ostream& operator<<(std::ostream& out, const Report& report);

/// The balance of an import: entities read = made into surfaces + skipped for a named reason. Repaired ones are among
/// those made.
class Ledger {
public:
    struct Made {
        std::string type, layer;
        std::size_t count = 0;
    };
    struct Skipped {
        std::string type, layer, reason;
        std::size_t count = 0;
    };
    struct Repaired {
        std::string type, layer, what;
        std::size_t count = 0;
    };
    /// Of no stated type and layer: counted, but in no row of the report.
    void made(std::size_t count = 1) { made({}, {}, count); }
    void made(const std::string& type, const std::string& layer, std::size_t count = 1);
    void skipped(const std::string& type, const std::string& layer, const std::string& reason, std::size_t count = 1);
    void repaired(const std::string& type, const std::string& layer, const std::string& what, std::size_t count = 1);
    /// Moves entities that were made, but whose surfaces all were dropped later, to the skipped side.
    /// @param made_on  the layer that made() was told; empty: `layer`
    void unmake(const std::string& type, const std::string& layer, const std::string& reason, std::size_t count = 1,
                const std::string& made_on = {});
    std::size_t read_count() const;
    std::size_t made_count() const { return made_count_; }
    std::vector<Made> made_list() const;
    std::vector<Skipped> skipped_list() const;
    std::vector<Repaired> repaired_list() const;
    void add(const Ledger& other);

private:
    struct Key {
        std::string type, layer, reason;
        auto operator<=>(const Key&) const = default;
    };
    std::size_t made_count_ = 0;
    std::map<Key, std::size_t> made_; ///< without a reason
    std::map<Key, std::size_t> skipped_, repaired_;
};

} // namespace lightwell
