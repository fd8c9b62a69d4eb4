#pragma once

#include "engine/base/vector.h"

#include <string>

namespace lightwell {

/// What a picture shows, in the words and angles of the scene language (`-vtv -vp -vd -vu -vh -vv`).
struct View {
    enum class Kind : char { perspective = 'v', parallel = 'l', hemispherical = 'h', angular = 'a' };
    std::string name = "view";
    Kind kind = Kind::perspective;
    Point position;
    Direction direction{0, 1, 0};
    Direction up{0, 0, 1};
    double horizontal = 45; ///< degrees; metres for a parallel view
    double vertical = 45;
    double shift = 0, lift = 0;   ///< of the picture's centre, in picture widths and heights
    double fore_m = 0, aft_m = 0; ///< clipping distances; 0: none
};

struct ViewRay {
    Point origin;
    Direction direction;
};

/// A view made ready to give rays.
class Camera {
public:
    /// @throws InputError when up is parallel to the direction, an angle is out of range, or a number is not finite
    explicit Camera(const View& view);
    /// @param x, y  picture coordinates in [0, 1], y upwards
    /// @return      false outside the picture circle of a fisheye view
    bool ray(double x, double y, ViewRay& ray) const noexcept;
    /// Picture width over height for square pixels.
    double aspect() const noexcept { return aspect_; }
    /// Solid angle of the picture element around (x, y) for one of width x height pixels, sr; 0 outside.
    double pixel_solid_angle_sr(double x, double y, int width, int height) const noexcept;

private:
    View view_;
    Vec3 right_, up_;
    double aspect_ = 1;
};

/// Reads `-vtv -vp x y z -vd x y z -vu x y z -vh a -vv a -vs s -vl l -vo d -va d`, with or without a leading VIEW= or
/// rvu.
/// @throws InputError that names the word
View parse_view(const std::string& text, const std::string& place);
/// The same words, shortest numbers.
std::string to_text(const View& view);

} // namespace lightwell
