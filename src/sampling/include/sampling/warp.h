// Warps from the unit square to where samples are wanted; each with its density and, where it exists, its inverse.
// Sources: PBRT 4th ed., appendix A, and the papers named.
#pragma once

#include "math/vec.h"

#include <array>
#include <cmath>
#include <optional>

namespace nephroid {

// --- disk ---------------------------------------------------------------------------------------------------------
/// Shirley & Chiu 1997, concentric map: low distortion, density 1/pi over the unit disk. The two kinds of wedges are one
/// calculation with x and y swapped, without a branch, which half of all points would take; the angle stays within pi/4,
/// where the Taylor series of degree 9 and 8 are exact to a float's rounding.
inline Vec2 square_to_disk(Vec2 u) {
    float const a = 2.0f * u.x - 1.0f;
    float const b = 2.0f * u.y - 1.0f;
    bool const along_x = std::abs(a) > std::abs(b);
    float const r = along_x ? a : b;
    float const ratio = (along_x ? b : a) / (r != 0.0f ? r : 1.0f);
    float const phi = kPiOver4 * ratio;
    float const p2 = phi * phi;
    float const sine =
        phi * (1.0f + p2 * (-1.0f / 6 + p2 * (1.0f / 120 + p2 * (-1.0f / 5040 + p2 * (1.0f / 362880)))));
    float const cosine = 1.0f + p2 * (-0.5f + p2 * (1.0f / 24 + p2 * (-1.0f / 720 + p2 * (1.0f / 40320))));
    // Both products are made before the choice, lest compilers turn it into a branch.
    float const along = r * cosine;
    float const across = r * sine;
    return {along_x ? along : across, along_x ? across : along};
}
inline Vec2 disk_to_square(Vec2 p) {
    float const r = std::sqrt(p.x * p.x + p.y * p.y);
    float phi = std::atan2(p.y, p.x);
    if (phi < -kPiOver4) phi += kTwoPi;  // [-pi/4, 7pi/4)
    float a;
    float b;
    if (phi < kPiOver4) {
        a = r, b = phi * a / kPiOver4;
    } else if (phi < 3 * kPiOver4) {
        b = r, a = -(phi - kPiOver2) * b / kPiOver4;
    } else if (phi < 5 * kPiOver4) {
        a = -r, b = (phi - kPi) * a / kPiOver4;
    } else {
        b = -r, a = -(phi - 3 * kPiOver2) * b / kPiOver4;
    }
    return {clamp((a + 1.0f) * 0.5f, 0.0f, kOneMinusEpsilon),
            clamp((b + 1.0f) * 0.5f, 0.0f, kOneMinusEpsilon)};
}
inline constexpr float kDiskPdf = kInvPi;

// --- hemispheres and spheres, solid angle ---------------------------------------------------------------------------
/// Malley's method: density cos(theta)/pi about +z.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
    Vec2 const d = square_to_disk(u);
    return {d.x, d.y, safe_sqrt(1.0f - d.x * d.x - d.y * d.y)};
}
inline float cosine_hemisphere_pdf(float cos_t) { return cos_t > 0.0f ? cos_t * kInvPi : 0.0f; }
inline Vec2 cosine_hemisphere_to_square(Vec3 w) { return disk_to_square({w.x, w.y}); }

inline Vec3 square_to_uniform_hemisphere(Vec2 u) {
    float const z = u.x;
    float const r = safe_sqrt(1.0f - z * z);
    float const phi = kTwoPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float kUniformHemispherePdf = kInvTwoPi;

inline Vec3 square_to_uniform_sphere(Vec2 u) {
    float const z = 1.0f - 2.0f * u.x;
    // sqrt(1 - z^2) = 2 sqrt(u (1-u)) without cancellation near the poles
    float const r = 2.0f * safe_sqrt(u.x * (1.0f - u.x));
    float const phi = kTwoPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float kUniformSpherePdf = kInvFourPi;

/// Within the cone of half-angle theta_max about +z; takes 1 - cos(theta_max), which stays exact for small cones.
inline Vec3 square_to_uniform_cone(Vec2 u, float one_minus_cos_max) {
    float const one_minus_cos = u.x * one_minus_cos_max;
    float const sin2 = one_minus_cos * (2.0f - one_minus_cos);
    float const r = safe_sqrt(sin2);
    float const phi = kTwoPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), 1.0f - one_minus_cos};
}
inline float uniform_cone_pdf(float one_minus_cos_max) { return 1.0f / (kTwoPi * one_minus_cos_max); }

// --- triangle, area -------------------------------------------------------------------------------------------------
/// Barycentric coordinates (of the second and third vertex), uniform by area (Heitz 2019, "A Low-Distortion Map Between
/// Triangle and Square").
inline Vec2 square_to_triangle(Vec2 u) {
    if (u.y > u.x) {
        float const x = u.x * 0.5f;
        return {x, u.y - x};
    }
    float const y = u.y * 0.5f;
    return {u.x - y, y};
}
inline Vec2 triangle_to_square(Vec2 b) {
    return b.x > b.y ? Vec2{b.x + b.y, 2.0f * b.y} : Vec2{2.0f * b.x, b.x + b.y};
}

// --- equal-area square <-> sphere -----------------------------------------------------------------------------------
/// Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD": octahedral, as pbrt-v4's environment maps.
Vec3 equal_area_square_to_sphere(Vec2 p);
Vec2 equal_area_sphere_to_square(Vec3 d);
/// A point outside [0,1]^2, brought back in the way that the octahedral square continues there.
Vec2 wrap_equal_area_square(Vec2 uv);

// --- one-dimensional pieces -----------------------------------------------------------------------------------------
/// Linear density between a at 0 and b at 1; uniform where both are 0. Without a branch, so that lanes may use it.
inline float sample_linear(float u, float a, float b) {
    float const x = u * (a + b) / (a + std::sqrt(lerp(u, a * a, b * b)));
    bool const at_zero = (u == 0.0f) & (a == 0.0f);  // 0 / 0
    float const inside = at_zero ? 0.0f : (x < kOneMinusEpsilon ? x : kOneMinusEpsilon);
    return a + b == 0.0f ? u : inside;
}
inline float linear_pdf(float x, float a, float b) {
    if (x < 0.0f || x > 1.0f) return 0.0f;
    return a + b == 0.0f ? 1.0f : 2.0f * lerp(x, a, b) / (a + b);
}
/// The u of which sample_linear makes x.
inline float invert_linear(float x, float a, float b) {
    return a + b == 0.0f ? x : x * (a * (2.0f - x) + b * x) / (a + b);
}
/// Tent of half-width r about 0.
inline float sample_tent(float u, float r) {
    return u < 0.5f ? -r + r * sample_linear(2.0f * u, 0.0f, 1.0f)
                    : r * sample_linear(2.0f * u - 1.0f, 1.0f, 0.0f);
}
inline float tent_pdf(float x, float r) { return std::abs(x) >= r ? 0.0f : 1.0f / r - std::abs(x) / (r * r); }

/// Bilinear density over the unit square with corner values w[0]=(0,0), w[1]=(1,0), w[2]=(0,1), w[3]=(1,1).
inline Vec2 sample_bilinear(Vec2 u, float const w[4]) {
    float const y = sample_linear(u.y, w[0] + w[1], w[2] + w[3]);
    float const x = sample_linear(u.x, lerp(y, w[0], w[2]), lerp(y, w[1], w[3]));
    return {x, y};
}
inline float bilinear_pdf(Vec2 p, float const w[4]) {
    float const sum = w[0] + w[1] + w[2] + w[3];
    float const value =
        (1 - p.x) * (1 - p.y) * w[0] + p.x * (1 - p.y) * w[1] + (1 - p.x) * p.y * w[2] + p.x * p.y * w[3];
    float const inside = sum == 0.0f ? 1.0f : 4.0f * value / sum;
    return (p.x < 0.0f) | (p.x > 1.0f) | (p.y < 0.0f) | (p.y > 1.0f) ? 0.0f : inside;
}
/// The u of which sample_bilinear makes p.
Vec2 invert_bilinear(Vec2 p, float const w[4]);
/// Weights for drawing by solid angle times the receiver's cosine: a polygon's map (spherical_triangle.h,
/// spherical_rectangle.h) is given sample_bilinear(u, weights) instead of u, and its density is multiplied by bilinear_pdf (Hart et
/// al. 2020, "Practical Product Sampling by Fitting and Composing Warps"). `corners`: directions, of any length, in which the
/// map sees the corners of the square (0,0), (1,0), (0,1), (1,1). The floor keeps every direction possible.
inline float cosine_weight(Vec3 corner, Vec3 n, bool two_sided) {
    float const c = dot(n, corner) / length(corner);
    return max(two_sided ? std::abs(c) : c, 0.01f);
}
inline std::array<float, 4> cosine_weights(std::array<Vec3, 4> const& corners, Vec3 n, bool two_sided) {
    return {cosine_weight(corners[0], n, two_sided), cosine_weight(corners[1], n, two_sided),
            cosine_weight(corners[2], n, two_sided), cosine_weight(corners[3], n, two_sided)};
}

/// Balance and power heuristics (Veach 1997, 9.2.2) of one sample from each of two strategies.
inline float balance_heuristic(float f, float g) { return f / (f + g); }
inline float power_heuristic(float f, float g) {
    float const f2 = f * f;
    if (std::isinf(f2)) return 1.0f;
    return f2 / (f2 + g * g);
}

}  // namespace nephroid
