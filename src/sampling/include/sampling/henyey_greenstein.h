// How light turns where it meets particles: the phase function of Henyey & Greenstein 1941 (PBRT 4th ed., 11.3.1). Both directions
// point away from the point of scattering; g is the mean cosine of the turn: above 0 forwards, 0 is the same in all directions.
#pragma once

#include "math/frame.h"

namespace nephroid {

/// Density by solid angle of wi, given wo: the function is normalised, so that it is also its own density (eq. 11.8).
inline float henyey_greenstein(float g, Vec3 wo, Vec3 wi) {
    float const below = 1.0f + g * g + 2.0f * g * dot(wo, wi);
    return kInvFourPi * (1.0f - g * g) / (below * safe_sqrt(below));
}
/// Draws wi in proportion to it (eq. 11.9; near g = 0 its limit, which that cannot be computed from).
inline Vec3 sample_henyey_greenstein(float g, Vec3 wo, Vec2 u) {
    float cosine = 1.0f - 2.0f * u.x;
    if (std::abs(g) > 1e-3f)
        cosine = -(1.0f + g * g - sqr((1.0f - g * g) / (1.0f + g - 2.0f * g * u.x))) / (2.0f * g);
    return frame_from_z(wo).from_local(
        spherical_direction(safe_sqrt(1.0f - cosine * cosine), cosine, kTwoPi * u.y));
}

}  // namespace nephroid
