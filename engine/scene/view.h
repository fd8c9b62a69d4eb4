#pragma once

#include "engine/base/vector.h"

#include <string>

namespace lightwell {

/// What a picture shows, in the words and angles of the scene language (`-vtv -vp -vd -vu -vh -vv`).
struct View {
    /// The letter after `-vt`. hemispherical: parallel projection of the sphere of directions; angular: equal angles
    /// from the centre; planisphere: stereographic; cylindrical: equal angles across, perspective upwards.
    enum class Kind : char {
        perspective = 'v',
        parallel = 'l',
        cylindrical = 'c',
        hemispherical = 'h',
        angular = 'a',
        planisphere = 's'
    };
    std::string name = "view";
    Kind kind = Kind::perspective;
    Point position;
    Direction direction{0, 1, 0}; ///< of any length; the length matters only to focus_m
    Direction up{0, 0, 1};
    double horizontal = 45; ///< degrees; metres for a parallel view
    double vertical = 45;
    double shift = 0, lift = 0; ///< of the picture's centre, in picture widths and heights
    /// Clipping distances; aft 0: none. Of planes across the view direction (perspective, parallel), of cylinders about
    /// the up axis (cylindrical), of spheres (fisheyes).
    double fore_m = 0, aft_m = 0;
    double lens_m = 0;  ///< diameter of the lens; 0: everything is sharp
    double focus_m = 0; ///< distance of what is sharp, measured as the clipping distances; 0: the length of `direction`
};

struct ViewRay {
    Point origin; ///< on the fore clipping surface
    Direction direction;
    double reach_m = infinity; ///< to the aft clipping surface
};

/// A view made ready to give rays.
/// Source  definitions of the projections: Radiance's rpict(1), "view types"; rays agree with its vwrays
class Camera {
public:
    /// @throws InputError when up is parallel to the direction, an angle is out of range, or a number is not finite
    explicit Camera(const View& view);
    /// The ray through the middle of the lens.
    /// @param x, y  picture coordinates in [0, 1], y upwards
    /// @return      false outside the picture circle of a fisheye view
    bool ray(double x, double y, ViewRay& ray) const noexcept { return this->ray(x, y, middle_of_lens, ray); }
    /// The ray through a point of the lens. All points of the lens give rays that meet where the picture is sharp.
    /// The lens is a disc across the view direction (perspective, parallel), else across the ray of its middle, and
    /// clipping is then by the plane that touches the surface at that ray.
    /// @param lens  uniform random numbers: the mean over them is the picture with its depth of field
    bool ray(double x, double y, UnitSquare lens, ViewRay& ray) const noexcept;
    /// Whether rays depend on the point of the lens.
    bool has_lens() const noexcept { return view_.lens_m > 0; }
    /// Picture width over height for square pixels.
    double aspect() const noexcept { return half_width_ / half_height_; }
    /// Solid angle of the picture element around (x, y) for one of width x height pixels, sr; 0 outside, and for
    /// parallel views.
    double pixel_solid_angle_sr(double x, double y, int width, int height) const noexcept;

private:
    /// Where a picture element looks to from the middle of the lens.
    struct Sight {
        Point origin;
        Direction way;     ///< unit
        Direction outward; ///< across the clipping surfaces
    };
    static constexpr UnitSquare middle_of_lens{0.5, 0.5};
    bool sight(double across, double upwards, Sight& sight) const noexcept;
    void move_into_lens(UnitSquare lens, Sight& sight) const noexcept;

    View view_;
    Direction right_, up_;
    double half_width_ = 1, half_height_ = 1; ///< in the picture plane of the projection
    double focus_m_ = 1;
};

/// The part of a view between the picture coordinates (x0, y0) and (x1, y1), y upwards: a view of its own.
View cropped(const View& view, double x0, double y0, double x1, double y1);

/// Reads `-vtv -vp x y z -vd x y z -vu x y z -vh a -vv a -vs s -vl l -vo d -va d -pd lens -pf focus`, with or without a
/// leading VIEW= or rvu.
/// @throws InputError that names the word
View parse_view(const std::string& text, const std::string& place);
/// The same words, shortest numbers; the lens only when there is one.
std::string to_text(const View& view);

} // namespace lightwell
