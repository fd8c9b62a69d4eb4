#pragma once

#include <stdexcept>
#include <string>

namespace lightwell {

/// Input that cannot be used: says where, what was found and expected, and the way out, in one line:
/// `room.dxf:214: layer "A-GLAZ": thickness is -6 mm, expected > 0; draw it upwards or drop the layer`.
class InputError : public std::runtime_error {
public:
    /// @param place  file, line and entity: `room.dxf:214` or `scene.rad:12: polygon "w1"`
    /// @param what   the value found and what was expected
    /// @param hint   the way out; may be empty
    InputError(const std::string& place, const std::string& what, const std::string& hint = {})
        : std::runtime_error(place + ": " + what + (hint.empty() ? "" : "; " + hint))
    {
    }
};

/// The user asked to stop (Ctrl-C, a host's button). Work done so far has been kept.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled") {}
};

} // namespace lightwell
