// Rays, and how they leave surfaces.
#pragma once

#include "math/vec.h"

#include <bit>
#include <cstdint>

namespace nephroid {

struct Ray {
    Vec3 o{0, 0, 0};
    Vec3 d{0, 0, 1};
};

/// The float next to x, away from zero steps excluded: one step up or down the number line.
inline float next_float_up(float v) {
    if (std::isinf(v) && v > 0.0f) return v;
    if (v == -0.0f) v = 0.0f;
    auto bits = std::bit_cast<std::uint32_t>(v);
    bits += v >= 0.0f ? 1u : ~0u;
    return std::bit_cast<float>(bits);
}
inline float next_float_down(float v) { return -next_float_up(-v); }

/// Moves p off its surface, to the side that w points to, by just more than its error bound `p_error` (absolute, per
/// coordinate), so that a ray from there cannot hit the surface it leaves. Scales with the scene: no epsilon.
/// PBRT 4th ed., section 6.8.6 (OffsetRayOrigin).
inline Vec3 offset_ray_origin(Vec3 p, Vec3 p_error, Vec3 n, Vec3 w) {
    float const d = dot(abs(n), p_error);
    Vec3 offset = n * d;
    if (dot(w, n) < 0.0f) offset = -offset;
    Vec3 po = p + offset;
    for (int i = 0; i < 3; ++i) {
        if (offset[i] > 0.0f) {
            po[i] = next_float_up(po[i]);
        } else if (offset[i] < 0.0f) {
            po[i] = next_float_down(po[i]);
        }
    }
    return po;
}

}  // namespace nephroid
