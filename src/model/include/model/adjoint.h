// Radiance and importance obey the same scattering equation but for two factors (Veach 1997, chapter 5), and they are here alone:
// the square of the index of refraction, and what shading normals do to the cosine.
#pragma once

#include "math/frame.h"
#include "math/vec.h"

#include <cmath>
#include <cstdint>

namespace nephroid {

/// What is carried along the path that is being built from wo to wi.
enum class Mode : std::uint8_t {
    Radiance,   // the path comes from the camera
    Importance  // the path comes from a light: power is carried, and importance is what would arrive there
};

/// Refraction squeezes radiance into the smaller solid angle of the denser medium by (n_i / n_t)^2 (Veach 1997, eq. 5.2), and
/// leaves importance alone. eta = n_t / n_i, t being the side of wi.
inline float refraction_scale(Mode mode, float eta) {
    return mode == Mode::Radiance ? 1.0f / (eta * eta) : 1.0f;
}

/// Where the shading normal ns is not the geometric one ng, f is symmetric but the measure is not: the flux through a surface
/// element goes by ng. The factor that belongs to f(wo, wi) |wi.ns| (Veach 1997, eq. 5.17 and 5.19):
/// 1 for radiance; |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|) for importance.
inline float shading_normal_scale(Mode mode, Vec3 wo, Vec3 wi, Vec3 ns, Vec3 ng) {
    if (mode == Mode::Radiance) return 1.0f;
    float const below = abs_dot(wo, ng) * abs_dot(wi, ns);
    return below > 0.0f ? abs_dot(wo, ns) * abs_dot(wi, ng) / below : 0.0f;
}

}  // namespace nephroid
