// Affine and projective transforms. `Mat4` is in double: scene files chain many transforms, and precision is free there.
// `Transform` is what a pass uses: a float 3x4 matrix and its inverse, with bounds on the rounding error of points.
#pragma once

#include "math/bounds.h"
#include "math/vec.h"

#include <array>
#include <optional>

namespace nephroid {

/// Row-major 4x4 matrix that acts on column vectors, p' = M p.
struct Mat4 {
    std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

    bool operator==(Mat4 const&) const = default;
};

Mat4 operator*(Mat4 const& a, Mat4 const& b);
Mat4 transpose(Mat4 const& a);
double determinant3(Mat4 const& a);  // of the upper-left 3x3 block
/// Gauss-Jordan with full pivoting; nothing when singular or not finite.
std::optional<Mat4> inverse(Mat4 const& a);

Mat4 translate(double x, double y, double z);
Mat4 scale(double x, double y, double z);
/// By `angle` degrees about the axis (x, y, z), counter-clockwise seen from its tip; nothing for a zero axis.
std::optional<Mat4> rotate(double angle, double x, double y, double z);
/// pbrt's LookAt: the world-to-camera matrix of a left-handed camera that looks along +z, y up.
/// Nothing when eye = look or up is parallel to the view.
std::optional<Mat4> look_at(std::array<double, 3> eye, std::array<double, 3> look, std::array<double, 3> up);
/// pbrt's Perspective(fov in degrees, near, far).
Mat4 perspective(double fov, double near, double far);

bool is_identity(Mat4 const& a);
bool swaps_handedness(Mat4 const& a);
/// Does p' = M p keep w = 1?
bool is_affine(Mat4 const& a);

/// Affine transform and inverse in float. Default: identity.
struct Transform {
    // Rows of the 3x4 matrices.
    std::array<std::array<float, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    std::array<std::array<float, 4>, 3> inv{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    [[nodiscard]] Vec3 point(Vec3 p) const { return apply(m, p, 1.0f); }
    [[nodiscard]] Vec3 vector(Vec3 v) const { return apply(m, v, 0.0f); }
    /// Normals go by the inverse transpose; the result is not normalised.
    [[nodiscard]] Vec3 normal(Vec3 n) const { return apply_transposed(inv, n); }
    [[nodiscard]] Vec3 point_inverse(Vec3 p) const { return apply(inv, p, 1.0f); }
    [[nodiscard]] Vec3 vector_inverse(Vec3 v) const { return apply(inv, v, 0.0f); }
    [[nodiscard]] Vec3 normal_inverse(Vec3 n) const { return apply_transposed(m, n); }
    [[nodiscard]] Bounds3 bounds(Bounds3 const& b) const;

    /// Bound on |computed - exact| of point(p) when p itself is off by at most p_error in each coordinate
    /// (PBRT 4th ed., section 6.8.6).
    [[nodiscard]] Vec3 point_error(Vec3 p, Vec3 p_error) const { return error(m, p, p_error); }
    [[nodiscard]] Vec3 point_inverse_error(Vec3 p, Vec3 p_error) const { return error(inv, p, p_error); }

  private:
    using Rows = std::array<std::array<float, 4>, 3>;
    static Vec3 apply(Rows const& r, Vec3 p, float w) {
        return {r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z + r[0][3] * w,
                r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z + r[1][3] * w,
                r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z + r[2][3] * w};
    }
    static Vec3 apply_transposed(Rows const& r, Vec3 n) {
        return {r[0][0] * n.x + r[1][0] * n.y + r[2][0] * n.z, r[0][1] * n.x + r[1][1] * n.y + r[2][1] * n.z,
                r[0][2] * n.x + r[1][2] * n.y + r[2][2] * n.z};
    }
    static Vec3 error(Rows const& r, Vec3 p, Vec3 e);
};

/// How a linear map with columns x, y, z changes densities over directions: |det|, or 0 where it maps balls to balls and so
/// leaves them alone (to 1e-6). See direction_density.
float direction_scale(Vec3 x, Vec3 y, Vec3 z);
template <class Map>
float direction_scale(Map const& m) {
    return direction_scale(m.vector({1, 0, 0}), m.vector({0, 1, 0}), m.vector({0, 0, 1}));
}
/// d(directions before) / d(directions after the map) at a unit direction that the map makes `mapped`: |M w|^3 / |det M|.
inline float direction_density(float scale, Vec3 mapped) {
    if (scale == 0.0f) return 1.0f;
    float const stretch = length(mapped);
    return stretch * stretch * stretch / scale;
}

/// Nothing when the matrix is singular, not affine, or not finite in float.
std::optional<Transform> make_transform(Mat4 const& m);

}  // namespace nephroid
