#pragma once

#include "engine/base/spectrum.h"
#include "engine/simulate/rays.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace lightwell::commands {

/// What Radiance's options say of a calculation, in its own words and with its defaults. Nothing here is a knob of the
/// engine: what each option comes to is said once, in native_accuracy() and README.md.
struct RadianceSettings {
    int ambient_bounces = 0;      ///< -ab; 0: direct light and -av alone
    double ambient_accuracy = .1; ///< -aa; 0: plain path tracing
    int ambient_divisions = 1024; ///< -ad
    Spectrum ambient_value;       ///< -av, W/(m^2 sr)
    std::string ambient_file;     ///< -af
    bool irradiance = false;      ///< -i
    bool backs_seen = true;       ///< -bv
    bool warnings = true;         ///< -w
    int processes = 0;            ///< -n
    /// Options that were given and change nothing here, since the engine reaches their purpose by itself.
    std::vector<std::string> without_effect = {};
};

/// Words of a command line, one after the other.
class OptionReader {
public:
    explicit OptionReader(const std::vector<std::string>& words) : words_(words) {}
    bool more() const { return next_ < words_.size(); }
    const std::string& peek() const { return words_[next_]; }
    const std::string& take();
    /// The value of an option.
    /// @throws Fatal `command line error at 'OPTION'`
    const std::string& value(const std::string& option);
    double number(const std::string& option);
    int integer(const std::string& option);

private:
    const std::vector<std::string>& words_;
    std::size_t next_ = 1;
};

/// `-w`, `-w+`, `-w-`, `-w1`, `-w0`; `on` is turned when there is no sign.
/// @return nothing when the word is not this switch
std::optional<bool> switch_of(const std::string& word, const std::string& name, bool before);

/// Reads one option of the calculation.
/// @return false for an option of another kind; nothing is taken then
bool read_setting(OptionReader& words, RadianceSettings& settings);

/// The relative standard error that these settings ask for: Radiance's own, about 0.7 / sqrt(ambient divisions).
double native_accuracy(const RadianceSettings& settings) noexcept;
/// With `-ab 0`, or by plain path tracing (`-aa 0`), diffuse light is followed as often as `-ab` says, and `-av` stands
/// for the rest; else the engine follows it to the end.
Preparation preparation_for(const RadianceSettings& settings);
RaySettings ray_settings(const RadianceSettings& settings);

} // namespace lightwell::commands
