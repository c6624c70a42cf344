#include "math/transform.h"

#include <cmath>
#include <utility>

namespace nephroid {

Mat4 operator*(Mat4 const& a, Mat4 const& b) {
    Mat4 r;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            double s = 0;
            for (int k = 0; k < 4; ++k) s += a.m[i][k] * b.m[k][j];
            r.m[i][j] = s;
        }
    return r;
}

Mat4 transpose(Mat4 const& a) {
    Mat4 r;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) r.m[i][j] = a.m[j][i];
    return r;
}

double determinant3(Mat4 const& a) {
    auto const& m = a.m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

std::optional<Mat4> inverse(Mat4 const& a) {
    // Gauss-Jordan on [A | 1]: full pivoting by choosing, among the rows left, the largest entry of the column.
    Mat4 l = a;
    Mat4 r;
    for (int col = 0; col < 4; ++col) {
        int pivot = col;
        for (int row = col + 1; row < 4; ++row)
            if (std::abs(l.m[row][col]) > std::abs(l.m[pivot][col])) pivot = row;
        double const p = l.m[pivot][col];
        if (!(std::abs(p) > 0) || !std::isfinite(p)) return std::nullopt;
        std::swap(l.m[col], l.m[pivot]);
        std::swap(r.m[col], r.m[pivot]);
        for (int k = 0; k < 4; ++k) l.m[col][k] /= p, r.m[col][k] /= p;
        for (int row = 0; row < 4; ++row) {
            if (row == col) continue;
            double const f = l.m[row][col];
            if (f == 0) continue;
            for (int k = 0; k < 4; ++k) l.m[row][k] -= f * l.m[col][k], r.m[row][k] -= f * r.m[col][k];
        }
    }
    for (auto const& row : r.m)
        for (double const x : row)
            if (!std::isfinite(x)) return std::nullopt;
    return r;
}

Mat4 translate(double x, double y, double z) {
    Mat4 r;
    r.m[0][3] = x, r.m[1][3] = y, r.m[2][3] = z;
    return r;
}

Mat4 scale(double x, double y, double z) {
    Mat4 r;
    r.m[0][0] = x, r.m[1][1] = y, r.m[2][2] = z;
    return r;
}

std::optional<Mat4> rotate(double angle, double x, double y, double z) {
    double const len = std::sqrt(x * x + y * y + z * z);
    if (!(len > 0) || !std::isfinite(len)) return std::nullopt;
    x /= len, y /= len, z /= len;
    double const t = angle * kPiDouble / 180.0;
    double const s = std::sin(t);
    double const c = std::cos(t);
    Mat4 r;
    r.m[0] = {x * x + (1 - x * x) * c, x * y * (1 - c) - z * s, x * z * (1 - c) + y * s, 0};
    r.m[1] = {x * y * (1 - c) + z * s, y * y + (1 - y * y) * c, y * z * (1 - c) - x * s, 0};
    r.m[2] = {x * z * (1 - c) - y * s, y * z * (1 - c) + x * s, z * z + (1 - z * z) * c, 0};
    return r;
}

std::optional<Mat4> look_at(std::array<double, 3> eye, std::array<double, 3> look, std::array<double, 3> up) {
    using V = std::array<double, 3>;
    auto cross3 = [](V a, V b) {
        return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    auto normalised = [](V a) -> std::optional<V> {
        double const len = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        if (!(len > 0) || !std::isfinite(len)) return std::nullopt;
        return V{a[0] / len, a[1] / len, a[2] / len};
    };
    auto const dir = normalised({look[0] - eye[0], look[1] - eye[1], look[2] - eye[2]});
    auto const u = normalised(up);
    if (!dir || !u) return std::nullopt;
    auto const right_raw = cross3(*u, *dir);
    double const sine =
        std::sqrt(right_raw[0] * right_raw[0] + right_raw[1] * right_raw[1] + right_raw[2] * right_raw[2]);
    if (!(sine > 1e-9)) return std::nullopt;
    auto const right = *normalised(right_raw);
    auto const new_up = cross3(*dir, right);
    Mat4 camera_to_world;
    for (int i = 0; i < 3; ++i) camera_to_world.m[i] = {right[i], new_up[i], (*dir)[i], eye[i]};
    return inverse(camera_to_world);
}

Mat4 perspective(double fov, double near, double far) {
    Mat4 p;
    p.m[2] = {0, 0, far / (far - near), -far * near / (far - near)};
    p.m[3] = {0, 0, 1, 0};
    double const inv_tan = 1.0 / std::tan(fov * kPiDouble / 360.0);
    return scale(inv_tan, inv_tan, 1) * p;
}

bool is_identity(Mat4 const& a) { return a == Mat4{}; }
bool swaps_handedness(Mat4 const& a) { return determinant3(a) < 0; }
bool is_affine(Mat4 const& a) { return a.m[3][0] == 0 && a.m[3][1] == 0 && a.m[3][2] == 0 && a.m[3][3] == 1; }

Bounds3 Transform::bounds(Bounds3 const& b) const {
    Bounds3 r;
    if (b.empty()) return r;
    for (int i = 0; i < 8; ++i) r.add(point(b.corner(i)));
    return r;
}

Vec3 Transform::error(Rows const& r, Vec3 p, Vec3 e) {
    Vec3 out;
    for (int i = 0; i < 3; ++i) {
        float const magnitude =
            std::abs(r[i][0] * p.x) + std::abs(r[i][1] * p.y) + std::abs(r[i][2] * p.z) + std::abs(r[i][3]);
        float const carried = std::abs(r[i][0]) * e.x + std::abs(r[i][1]) * e.y + std::abs(r[i][2]) * e.z;
        out[i] = gamma_bound(4) * magnitude + (gamma_bound(4) + 1.0f) * carried;
    }
    return out;
}

float direction_scale(Vec3 x, Vec3 y, Vec3 z) {
    float const scale2 = (dot(x, x) + dot(y, y) + dot(z, z)) / 3.0f;
    auto const small = [&](float v) { return std::abs(v) <= 1e-6f * scale2; };
    bool const similar = small(dot(x, y)) && small(dot(y, z)) && small(dot(z, x)) &&
                         small(dot(x, x) - scale2) && small(dot(y, y) - scale2) && small(dot(z, z) - scale2);
    return similar ? 0.0f : abs_dot(x, cross_accurate(y, z));
}

std::optional<Transform> make_transform(Mat4 const& m) {
    if (!is_affine(m)) return std::nullopt;
    auto const inv = inverse(m);
    if (!inv) return std::nullopt;
    Transform t;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            t.m[i][j] = static_cast<float>(m.m[i][j]);
            t.inv[i][j] = static_cast<float>(inv->m[i][j]);
            if (!std::isfinite(t.m[i][j]) || !std::isfinite(t.inv[i][j])) return std::nullopt;
        }
    return t;
}

}  // namespace nephroid
