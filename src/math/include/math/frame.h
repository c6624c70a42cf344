// An orthonormal frame: shading happens in it, normal = +z.
#pragma once

#include "math/vec.h"

namespace nephroid {

struct Frame {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    [[nodiscard]] Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    [[nodiscard]] Vec3 from_local(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// A frame about the unit vector n, without a branch that prefers an axis (Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited", listing 3).
inline Frame frame_from_z(Vec3 n) {
    float const sign = std::copysign(1.0f, n.z);
    float const a = -1.0f / (sign + n.z);
    float const b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// A frame about n whose x axis lies along dpdu as nearly as a right angle allows; dpdu parallel to n or 0 falls back.
inline Frame frame_from_zx(Vec3 n, Vec3 dpdu) {
    Vec3 const t = dpdu - n * dot(n, dpdu);
    float const len2 = length_squared(t);
    if (!(len2 > 0.0f) || !std::isfinite(len2)) return frame_from_z(n);
    Vec3 const x = t / std::sqrt(len2);
    return {x, cross(n, x), n};
}

// Spherical coordinates in the local frame.
inline float cos_theta(Vec3 w) { return w.z; }
inline float cos2_theta(Vec3 w) { return w.z * w.z; }
inline float abs_cos_theta(Vec3 w) { return std::abs(w.z); }
inline float sin2_theta(Vec3 w) { return max(0.0f, 1.0f - w.z * w.z); }
inline bool same_hemisphere(Vec3 a, Vec3 b) { return a.z * b.z > 0.0f; }
inline Vec3 spherical_direction(float sin_theta, float cos_t, float phi) {
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_t};
}

}  // namespace nephroid
