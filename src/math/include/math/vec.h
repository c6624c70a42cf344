// Vectors are glm's: plain structs, component-wise arithmetic. This header gives them their names here and adds the
// few functions that transport needs and glm has not. Lengths are in the scene's unit; angles are radians.
#pragma once

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace nephroid {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec2i = glm::ivec2;
using Vec3i = glm::ivec3;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiDouble = 3.14159265358979323846;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kTwoPi = 6.28318530717958647692f;
inline constexpr float kInvTwoPi = 0.15915494309189533577f;
inline constexpr float kInvFourPi = 0.07957747154594766788f;
inline constexpr float kPiOver2 = 1.57079632679489661923f;
inline constexpr float kPiOver4 = 0.78539816339744830961f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;  // the largest float below 1
inline constexpr float kMachineEpsilon = 0x1p-24f;         // half an ulp of 1: the rounding unit

inline float radians(float degrees) { return degrees * (kPi / 180.0f); }
inline float degrees(float radians) { return radians * (180.0f / kPi); }

template <class T>
constexpr T sqr(T x) {
    return x * x;
}
/// sqrt that treats a slightly negative rounding result as 0.
inline float safe_sqrt(float x) { return std::sqrt(x > 0.0f ? x : 0.0f); }
inline float clamp(float x, float lo, float hi) { return x < lo ? lo : (x > hi ? hi : x); }
inline float lerp(float t, float a, float b) { return (1.0f - t) * a + t * b; }

/// a*b - c*d without cancellation (Kahan; error at most 1.5 ulp).
inline float difference_of_products(float a, float b, float c, float d) {
    float const cd = c * d;
    float const error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}
/// Cross product accurate even for nearly parallel vectors.
inline Vec3 cross_accurate(Vec3 a, Vec3 b) {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

using glm::cross;
using glm::dot;
inline float abs_dot(Vec3 a, Vec3 b) { return std::abs(dot(a, b)); }
inline float length_squared(Vec3 v) { return dot(v, v); }
inline float length(Vec3 v) { return std::sqrt(dot(v, v)); }
inline float distance_squared(Vec3 a, Vec3 b) { return length_squared(a - b); }
inline Vec3 normalize(Vec3 v) { return v * (1.0f / length(v)); }
inline Vec3 abs(Vec3 v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
// Plain comparisons, not fmin and fmax: they compile to one instruction each. With a NaN the second argument is returned.
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline Vec3 min(Vec3 a, Vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
inline Vec3 max(Vec3 a, Vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
inline float max_component(Vec3 v) { return max(v.x, max(v.y, v.z)); }
inline bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
/// first ? a : b, by coordinates: the compiler sees no branch in it.
inline Vec3 choose(bool first, Vec3 a, Vec3 b) {
    return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}
inline Vec3 face_forward(Vec3 n, Vec3 v) { return dot(n, v) < 0.0f ? -n : n; }

/// The angle between two unit vectors, accurate near 0 and pi (Kahan), radians.
inline float angle_between(Vec3 a, Vec3 b) {
    return dot(a, b) < 0.0f ? kPi - 2.0f * std::asin(clamp(length(a + b) / 2.0f, 0.0f, 1.0f))
                            : 2.0f * std::asin(clamp(length(b - a) / 2.0f, 0.0f, 1.0f));
}

/// Bound on the relative error of n rounded operations, (1 +- eps)^n <= 1 + gamma(n). PBRT 4th ed., 6.8.1.
inline constexpr float gamma_bound(int n) {
    return (static_cast<float>(n) * kMachineEpsilon) / (1.0f - static_cast<float>(n) * kMachineEpsilon);
}

}  // namespace nephroid
