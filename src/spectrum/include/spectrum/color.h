// Colour: from spectra to CIE XYZ and rgb. Everything here is linear.
#pragma once

#include "math/vec.h"
#include "spectrum/spd.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <array>

namespace nephroid {

/// An rgb space by the CIE xy of its primaries and of its white. The whites are those of D65 and of ACES' D60 as tabulated
/// ("stdillum-D65", "illum-acesD60"), as in pbrt-v4, and not rounded to four digits: light of that spectrum is (1,1,1).
struct RgbColorSpace {
    Vec2 r, g, b, w;
};
inline constexpr Vec2 kD65White{0.31272693f, 0.32902322f};
inline constexpr RgbColorSpace kSrgb{{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, kD65White};
inline constexpr RgbColorSpace kDciP3{{0.680f, 0.320f}, {0.265f, 0.690f}, {0.150f, 0.060f}, kD65White};
inline constexpr RgbColorSpace kRec2020{{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, kD65White};
inline constexpr RgbColorSpace kAces2065{
    {0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32167927f, 0.33767201f}};

using Matrix3 = std::array<std::array<double, 3>, 3>;
/// Takes rgb (1,1,1) to the space's white with Y = 1.
Matrix3 rgb_to_xyz(RgbColorSpace const& space);
Matrix3 xyz_to_rgb(RgbColorSpace const& space);
Vec3 operator*(Matrix3 const& m, Vec3 v);
Matrix3 operator*(Matrix3 const& a, Matrix3 const& b);

Vec3 xyz_to_srgb(Vec3 xyz);
Vec3 srgb_to_xyz(Vec3 rgb);
/// Between rgb spaces; whites that differ are adapted (Bradford).
Vec3 convert_rgb(Vec3 rgb, RgbColorSpace const& from, RgbColorSpace const& to);
/// Von Kries adaptation of XYZ in Bradford's cone space, from white xy to white xy.
Matrix3 white_balance(Vec2 from, Vec2 to);
/// CIE xy of daylight of that temperature (4000 to 25000 K; CIE 15:2018, eq. 8), of a black body below 4000 K. Nominal
/// temperatures: 6500 is D65, whose correlated temperature is 6504 K since c2 was revised.
Vec2 daylight_xy(float kelvin);

/// Relative luminance of linear sRGB.
inline float luminance(Vec3 srgb) { return 0.2126735f * srgb.x + 0.7151516f * srgb.y + 0.0721749f * srgb.z; }

/// What the film's sensor "cie1931" makes of a path's radiance: the mean over lanes of radiance / pdf * (x-bar, y-bar, z-bar),
/// an estimate of the integrals over wavelength. They are not divided by the integral of y-bar: lights are normalised instead
/// (photometric()), as in pbrt-v4. In rgb mode the lanes are the result.
Vec3 to_xyz(Spectrum radiance, Wavelengths const& lambda);
Vec3 spectral_to_linear_srgb(Spectrum radiance, Wavelengths const& lambda);
inline Vec3 to_linear_srgb(Spectrum radiance, Wavelengths const& lambda) {
    if (lambda.is_rgb()) return {radiance[0], radiance[1], radiance[2]};
    return spectral_to_linear_srgb(radiance, lambda);
}

/// Integral of y-bar(l) spd(l) dl; for an rgb illuminant that of its white alone (pbrt-v4's SpectrumToPhotometric): what an
/// emission is divided by so that scale counts in luminance.
double photometric(Spd const& spd);

}  // namespace nephroid
