// Rays, and how they leave surfaces.
#pragma once

#include "math/float4.h"

#include <bit>
#include <cstdint>
#include <limits>

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

/// Lane by lane the float next to x, towards the sign of `up`; x itself where that is 0. For finite x these are the steps of
/// next_float_up and next_float_down, without their branches, which nobody could predict here.
inline Float4 next_float(Float4 x, Float4 up) {
    Int4 const sign = std::bit_cast<Int4>(up) & std::numeric_limits<std::int32_t>::min();
    // From 0 on, the way leads away from it.
    Int4 const from = x == 0.0f ? sign : std::bit_cast<Int4>(x);
    Int4 const away_from_zero = ((from ^ sign) >> 31) | 1;  // 1 or -1
    return up != 0.0f ? std::bit_cast<Float4>(from + away_from_zero) : x;
}

/// Moves p off its surface, to the side that w points to, by just more than its error bound `p_error` (absolute, per
/// coordinate), so that a ray from there cannot hit the surface it leaves. Scales with the scene: no epsilon.
/// PBRT 4th ed., section 6.8.6 (OffsetRayOrigin).
inline Vec3 offset_ray_origin(Vec3 const& p, Vec3 const& p_error, Vec3 const& n, Vec3 const& w) {
    Float4 const normal = to_lanes(n);
    float const d = dot(abs(normal), to_lanes(p_error));
    Float4 const offset = normal * (dot(to_lanes(w), normal) < 0.0f ? -d : d);
    return to_vec3(next_float(to_lanes(p) + offset, offset));
}

// The same once more, by coordinates: in a loop over eight rays the compiler makes one instruction of eight, to the same bits.
/// The float next to x, up where `way` is above 0, down where it is below, x itself where it is 0. For finite x, without a branch.
inline float next_float_towards(float x, float way) {
    auto const bits = std::bit_cast<std::int32_t>(x);
    std::int32_t const up = static_cast<std::int32_t>(way > 0.0f) - static_cast<std::int32_t>(way < 0.0f);
    // The bits without their sign count away from zero.
    std::int32_t const sign = bits >> 31;
    std::int32_t const outwards = (up ^ sign) - sign;
    constexpr std::int32_t kSign = std::numeric_limits<std::int32_t>::min();
    std::int32_t const from_zero = up == 0 ? bits : (up & kSign) | 1;
    return std::bit_cast<float>((bits & ~kSign) == 0 ? from_zero : bits + outwards);
}
inline Vec3 offset_of_lane(Vec3 p, Vec3 p_error, Vec3 n, Vec3 w) {
    float d = dot(abs(n), p_error);
    d = dot(w, n) < 0.0f ? -d : d;
    Vec3 const offset = n * d;
    Vec3 const po = p + offset;
    return {next_float_towards(po.x, offset.x), next_float_towards(po.y, offset.y),
            next_float_towards(po.z, offset.z)};
}

}  // namespace nephroid
