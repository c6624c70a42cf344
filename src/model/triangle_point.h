// A point of a triangle and its normals (PBRT 4th ed., 6.5). V is a vector of three floats: Float4 for one triangle, Vec3 where a loop
// goes over lanes; the bits are the same.
#pragma once

#include "math/float4.h"

#include <cmath>

namespace nephroid {

/// Barycentric coordinates.
struct Shares {
    float b0, b1, b2;

    explicit Shares(Vec2 b) : b0(1.0f - b.x - b.y), b1(b.x), b2(b.y) {}
    template <class T>
    [[nodiscard]] T mean(T const& v0, T const& v1, T const& v2) const {
        return b0 * v0 + b1 * v1 + b2 * v2;
    }
};

/// The point and the bound on its error.
template <class V>
struct TrianglePoint {
    V p, p_error;

    TrianglePoint(V p0, V p1, V p2, Shares const& b) {
        p0 = b.b0 * p0;
        p1 = b.b1 * p1;
        p2 = b.b2 * p2;
        p = p0 + p1 + p2;
        p_error = gamma_bound(7) * (abs(p0) + abs(p1) + abs(p2));
    }
};

/// Along the normal, twice the area long.
template <class V>
[[gnu::always_inline]] inline V double_area(V const& p0, V const& p1, V const& p2) {
    return cross_accurate(p1 - p0, p2 - p0);
}

/// Geometric and shading normal. `n` is interpolated, of any length; where it is 0 there is only the one.
template <class V>
struct TriangleNormals {
    V ng, ns;

    TriangleNormals(V const& double_area, bool flip) {
        float const inv = 1.0f / length(double_area);
        ng = double_area * (flip ? -inv : inv);
        ns = ng;
    }
    /// ng turns to the side of the mesh's own normals.
    void shade(V const& n) {
        float const len2 = dot(n, n);
        V const unit = n / std::sqrt(len2);
        float const side = dot(ng, unit) < 0.0f ? -1.0f : 1.0f;
        ns = choose(len2 > 0.0f, unit, ns);
        ng = choose(len2 > 0.0f, ng * side, ng);
    }
};

}  // namespace nephroid
