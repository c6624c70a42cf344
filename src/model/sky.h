// Clear and hazy skies, and the sun through them: Preetham, Shirley & Smits 1999, "A Practical Analytic Model for Daylight".
// Directions are in a frame whose +z is the zenith. Luminances are in kcd/m^2, and a Spectrum of luminance Y is scaled so that
// its integral with y-bar is Y, as all emission is (spectrum/color.h, photometric()).
//
// The model was fitted for the sun above the horizon and turbidities (the thickness of haze over that of air) of 2 to 6; its
// formulas stay positive from 1.7 to 10, and the caller keeps to these. Below the horizon there is nothing.
#pragma once

#include "math/vec.h"
#include "spectrum/spd.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

#include <array>

namespace nephroid {

inline constexpr float kSkyTurbidityMin = 1.7f, kSkyTurbidityMax = 10;
/// Half of the sun's angle as it is seen, radians: what the tables of its radiance belong to.
inline constexpr float kSunRadius = 0.0046513f;  // 0.2665 degrees

/// A sky made ready: one turbidity, one sun.
struct Sky {
    /// Perez et al. 1993: F = (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma).
    struct Distribution {
        float a = 0, b = 0, c = 0, d = 0, e = 0;
        float zenith = 0;  // the zenith's value over F there
    };
    std::array<Distribution, 3> x_y_luminance;
    Vec3 sun{0, 0, 1};
    std::array<float, 3> basis_luminance{};  // integrals of the daylight basis with y-bar
};

/// `sun`: unit, at or above the horizon.
Sky make_sky(float turbidity, Vec3 sun);
/// CIE xy and luminance (kcd/m^2) of the sky in unit direction w, {x, y, Y}; luminance 0 at and below the horizon.
Vec3 sky_color(Sky const& sky, Vec3 w);
/// Its radiance.
Spectrum sky_radiance(Sky const& sky, Vec3 w, Wavelengths const& lambda);
/// The sun's disk through the atmosphere, W m^-2 sr^-1 nm^-1, from 380 to 750 nm. `cos_zenith`: of its angle from the zenith.
TabulatedSpd sun_spectrum(float turbidity, float cos_zenith);
/// Light of colour xy as a mixture of the three daylight components: weights of the second and third (CIE 15, eq. for M1, M2).
std::array<float, 2> daylight_weights(float x, float y);

}  // namespace nephroid
