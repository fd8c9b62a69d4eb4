#include "engine/base/spectrum.h"

#include "engine/base/vector.h"

namespace lightwell {
namespace {

/// Columns are the XYZ of the primaries, scaled so that their sum is the white; Y of white is 1.
struct Matrix {
    Vec3 columns[3];
};

Vec3 multiply(const Matrix& m, const Vec3& v)
{
    return m.columns[0] * v.x + m.columns[1] * v.y + m.columns[2] * v.z;
}

Matrix inverted(const Matrix& m)
{
    const Vec3 &a = m.columns[0], &b = m.columns[1], &c = m.columns[2];
    const double d = dot(a, cross(b, c));
    const Vec3 r0 = cross(b, c) / d, r1 = cross(c, a) / d, r2 = cross(a, b) / d;
    return {{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}}};
}

Matrix times(const Matrix& a, const Matrix& b)
{
    return {{multiply(a, b.columns[0]), multiply(a, b.columns[1]), multiply(a, b.columns[2])}};
}

Vec3 xyz_of_chromaticity(double x, double y)
{
    return {x / y, 1, (1 - x - y) / y};
}

Matrix rgb_to_xyz(const double (&xy)[6], const Vec3& white)
{
    const Matrix raw{
        {xyz_of_chromaticity(xy[0], xy[1]), xyz_of_chromaticity(xy[2], xy[3]), xyz_of_chromaticity(xy[4], xy[5])}};
    const Vec3 scale = multiply(inverted(raw), white);
    return {{raw.columns[0] * scale.x, raw.columns[1] * scale.y, raw.columns[2] * scale.z}};
}

/// Rec.709 to the engine: to XYZ, von Kries adaptation in the Bradford space from D65 to equal energy, to RGB.
Matrix rec709_to_engine()
{
    const Vec3 d65 = xyz_of_chromaticity(0.3127, 0.3290), equal_energy{1, 1, 1};
    const Matrix bradford{{{0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}}};
    const Vec3 from = multiply(bradford, d65), to = multiply(bradford, equal_energy);
    const Matrix gain{{{to.x / from.x, 0, 0}, {0, to.y / from.y, 0}, {0, 0, to.z / from.z}}};
    const Matrix adapt = times(inverted(bradford), times(gain, bradford));
    const Matrix source = rgb_to_xyz({0.64, 0.33, 0.30, 0.60, 0.15, 0.06}, d65);
    const Matrix engine = rgb_to_xyz({0.64, 0.33, 0.29, 0.60, 0.15, 0.06}, equal_energy);
    return times(inverted(engine), times(adapt, source));
}

Spectrum apply(const Matrix& m, Spectrum s)
{
    if (s.r == s.g && s.g == s.b)
        return s; // grey stays exactly grey
    const Vec3 v = multiply(m, {s.r, s.g, s.b});
    return {v.x, v.y, v.z};
}

} // namespace

Spectrum from_rec709(Spectrum linear_rec709) noexcept
{
    static const Matrix matrix = rec709_to_engine();
    // The gamuts differ by a hair: a saturated green would come out slightly negative, and no surface reflects that.
    const Spectrum s = apply(matrix, linear_rec709);
    return {std::max(0.0, s.r), std::max(0.0, s.g), std::max(0.0, s.b)};
}

Spectrum to_rec709(Spectrum engine) noexcept
{
    static const Matrix matrix = inverted(rec709_to_engine());
    return apply(matrix, engine);
}

double srgb_to_linear(double encoded) noexcept
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double linear) noexcept
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace lightwell
