// Small helpers that the shape files share.
#pragma once

#include "model/ray3d.h"
#include "model/shape.h"

#include <cmath>

namespace nephroid::detail {

inline std::array<double, 3> to_double(Vec3 v) { return {v.x, v.y, v.z}; }
inline std::array<double, 3> sub(std::array<double, 3> const& a, std::array<double, 3> const& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Azimuth of (x, y) in [0, 2 pi).
inline float azimuth(double x, double y) {
    double phi = std::atan2(y, x);
    if (phi < 0) phi += 6.283185307179586;
    return static_cast<float>(phi);
}

/// A point of the unit square that sampling functions take, where (x, y) is one but for rounding; else nothing.
inline std::optional<Vec2> unit_square(float x, float y) {
    constexpr float slack = 1e-4f;
    std::optional<Vec2> u;
    if (x >= -slack && x <= 1.0f + slack && y >= -slack && y <= 1.0f + slack)
        u.emplace(clamp(x, 0.0f, kOneMinusEpsilon), clamp(y, 0.0f, kOneMinusEpsilon));
    return u;
}

/// Real roots of a t^2 + 2 h t + c, t0 <= t1, without cancellation; false when there are none.
inline bool solve_quadratic(double a, double h, double c, double discriminant_quarter, double& t0,
                            double& t1) {
    if (discriminant_quarter < 0 || a == 0) return false;
    double const root = std::sqrt(discriminant_quarter);
    double const q = h < 0 ? -h + root : -h - root;
    t0 = q / a;
    t1 = q != 0 ? c / q : t0;
    if (t0 > t1) std::swap(t0, t1);
    return true;
}

}  // namespace nephroid::detail
