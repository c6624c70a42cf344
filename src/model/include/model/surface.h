// Points on surfaces, as shapes give them and as shading needs them.
#pragma once

#include "math/transform.h"
#include "math/vec.h"

#include <cmath>

namespace nephroid {

/// A point of a surface in some space, with its differential geometry.
struct SurfacePoint {
    Vec3 p{0, 0, 0};
    Vec3 p_error{0, 0, 0};  // |computed - exact| per coordinate, at most
    Vec3 ng{0, 0, 1};       // geometric normal, unit; the side that area lights emit to
    Vec3 ns{0, 0, 1};       // shading normal, unit, in the hemisphere of ng or not, as the mesh says
    Vec2 uv{0, 0};
    Vec3 dpdu{0, 0, 0}, dpdv{0, 0, 0};
};

/// A point drawn on a surface; the density is by area in the space of p.
struct ShapeSample {
    Vec3 p{0, 0, 0};
    Vec3 p_error{0, 0, 0};
    Vec3 n{0, 0, 1};  // as SurfacePoint::ng
    Vec2 uv{0, 0};
    float pdf_area = 0;
};

/// An affine map by its 3x4 rows alone, for instances: it can do without an inverse, since normals go by cofactors.
struct AffineMap {
    std::array<std::array<float, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    /// The largest row sum of |M| |M^-1|, >= 1: how a trip there and back magnifies roundings. 1 for scales along the axes.
    float round_trip = 1;

    [[nodiscard]] Vec3 vector(Vec3 v) const {
        return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
    }
    [[nodiscard]] Vec3 point(Vec3 p) const { return vector(p) + Vec3{m[0][3], m[1][3], m[2][3]}; }
    /// cofactor(M) n: the area vector of a surface element of unit area and normal n. Its length is the element's stretch,
    /// its direction the new normal (reversed by a mirroring map).
    [[nodiscard]] Vec3 area_vector(Vec3 n) const {
        Vec3 const c0{m[0][0], m[1][0], m[2][0]};
        Vec3 const c1{m[0][1], m[1][1], m[2][1]};
        Vec3 const c2{m[0][2], m[1][2], m[2][2]};
        return cross(c1, c2) * n.x + cross(c2, c0) * n.y + cross(c0, c1) * n.z;
    }
    [[nodiscard]] float determinant() const {
        Vec3 const c0{m[0][0], m[1][0], m[2][0]};
        Vec3 const c1{m[0][1], m[1][1], m[2][1]};
        Vec3 const c2{m[0][2], m[1][2], m[2][2]};
        return dot(c0, cross(c1, c2));
    }
    /// |M| e: how a bound on an error grows.
    [[nodiscard]] Vec3 magnify(Vec3 e) const {
        Vec3 r;
        for (int i = 0; i < 3; ++i)
            r[i] = std::abs(m[static_cast<std::size_t>(i)][0]) * e.x +
                   std::abs(m[static_cast<std::size_t>(i)][1]) * e.y +
                   std::abs(m[static_cast<std::size_t>(i)][2]) * e.z;
        return r;
    }
    [[nodiscard]] Vec3 point_error(Vec3 p, Vec3 p_error) const {
        Vec3 const t = abs(Vec3{m[0][3], m[1][3], m[2][3]});
        return gamma_bound(4) * (magnify(abs(p)) + t) + (1.0f + gamma_bound(4)) * magnify(p_error);
    }
};

/// The same point seen from the space that the map leads to. Normals keep their side whether the map mirrors or not.
SurfacePoint transformed(AffineMap const& map, SurfacePoint const& s);
ShapeSample transformed(AffineMap const& map, ShapeSample const& s);

}  // namespace nephroid
