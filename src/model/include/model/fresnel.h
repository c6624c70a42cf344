// Reflection at smooth boundaries, unpolarised (PBRT 4th ed., 9.3; Born & Wolf 1.5). eta = n_transmitted / n_incident.
#pragma once

#include "math/frame.h"
#include "spectrum/spectrum.h"

#include <cmath>

namespace nephroid {

/// A refracted direction, on the other side of the boundary than `wi`; false at total reflection.
/// eta is n_inside/n_outside with "inside" below the normal +z; on return it is n_transmitted / n_incident.
/// PBRT 4th ed., 9.3.3. The computation of cos_t avoids cancellation at grazing angles.
inline bool refract(Vec3 wi, float& eta, Vec3& wt) {
    float cos_i = wi.z;
    float side = 1.0f;
    if (cos_i < 0.0f) {
        eta = 1.0f / eta;
        cos_i = -cos_i;
        side = -1.0f;
    }
    float const sin2_i = wi.x * wi.x + wi.y * wi.y;
    float const sin2_t = sin2_i / sqr(eta);
    if (sin2_t >= 1.0f) return false;
    float const cos_t = std::sqrt(1.0f - sin2_t);
    wt = Vec3{-wi.x / eta, -wi.y / eta, -side * cos_t};
    return true;
}

/// Reflectance of a dielectric at cos_i = |cos| of the incident angle; cos_i < 0 means from inside.
inline float fresnel_dielectric(float cos_i, float eta) {
    cos_i = clamp(cos_i, -1.0f, 1.0f);
    if (cos_i < 0.0f) {
        eta = 1.0f / eta;
        cos_i = -cos_i;
    }
    float const sin2_t = (1.0f - sqr(cos_i)) / sqr(eta);
    if (sin2_t >= 1.0f) return 1.0f;  // total reflection
    float const cos_t = safe_sqrt(1.0f - sin2_t);
    float const parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float const perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

/// Reflectance of a conductor of index eta + i k, relative to the medium of the incident ray: the complex formulas with the
/// real and imaginary parts worked out (Born & Wolf, 14.2; with a + ib = sqrt((eta + ik)^2 - sin^2)).
inline float fresnel_conductor(float cos_i, float eta, float k) {
    if (eta == 0.0f && k == 0.0f) return 1.0f;  // the limit of a vanishing index
    cos_i = clamp(cos_i, 0.0f, 1.0f);
    float const cos2 = cos_i * cos_i;
    float const sin2 = 1.0f - cos2;
    float const t = eta * eta - k * k - sin2;
    float const a2_b2 = std::sqrt(t * t + 4.0f * eta * eta * k * k);
    float const a = safe_sqrt(0.5f * (a2_b2 + t));
    float const sum = a2_b2 + cos2;
    float const cross = 2.0f * a * cos_i;
    float const perpendicular = (sum - cross) / (sum + cross);
    float const sum_p = cos2 * a2_b2 + sin2 * sin2;
    float const cross_p = cross * sin2;
    float const ratio = sum_p + cross_p > 0.0f ? (sum_p - cross_p) / (sum_p + cross_p) : 1.0f;
    return 0.5f * perpendicular * (1.0f + ratio);
}

inline Spectrum fresnel_conductor(float cos_i, Spectrum eta, Spectrum k) {
    Spectrum r;
    for (int i = 0; i < 4; ++i) r.set(i, fresnel_conductor(cos_i, eta[i], k[i]));
    return r;
}
inline Spectrum fresnel_dielectric(float cos_i, Spectrum eta) {
    Spectrum r;
    for (int i = 0; i < 4; ++i) r.set(i, fresnel_dielectric(cos_i, eta[i]));
    return r;
}

}  // namespace nephroid
