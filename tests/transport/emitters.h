// Emitting shapes, the maps that place them, and the irradiance that they cause at a point, by Lambert's formula or by a
// quadrature in double.
#pragma once

#include "scenes.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::test {

using D3 = std::array<double, 3>;
inline D3 operator-(D3 a, D3 b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline D3 operator+(D3 a, D3 b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline D3 operator*(D3 a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(D3 a, D3 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline D3 cross(D3 a, D3 b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(D3 a) { return std::sqrt(dot(a, a)); }
inline D3 apply(Mat4 const& m, D3 p) {
    D3 r{};
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = m.m[i][0] * p[0] + m.m[i][1] * p[1] + m.m[i][2] * p[2] + m.m[i][3];
    return r;
}

/// Irradiance of a horizontal receiver at p under a polygon of radiance 1 (Lambert 1760): 1/2 sum gamma_i (n . Gamma_i), what
/// is below the horizon cut away. Signed: positive where the polygon's front (counter-clockwise) is seen.
inline double polygon_irradiance(D3 p, std::vector<D3> const& corners) {
    std::vector<D3> v;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        D3 const a = corners[i] - p;
        D3 const b = corners[(i + 1) % corners.size()] - p;
        if (a[2] >= 0) v.push_back(a);
        if ((a[2] > 0 && b[2] < 0) || (a[2] < 0 && b[2] > 0))
            v.push_back(a + (b - a) * (a[2] / (a[2] - b[2])));
    }
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        D3 const& a = v[i];
        D3 const& b = v[(i + 1) % v.size()];
        D3 const n = cross(a, b);
        double const sine = length(n);
        if (sine > 0) sum += std::atan2(sine, dot(a, b)) * n[2] / sine;
    }
    return -sum / 2;
}

inline std::vector<D3> quad_corners(Quad const& q, Mat4 const& m) {
    auto const at = [&](float u, float v) {
        return apply(m, doubles(q.origin + u * q.edge_u + v * q.edge_v));
    };
    std::vector<D3> c{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    if (determinant3(m) < 0) std::swap(c[1], c[3]);  // the front stays the front
    return c;
}

/// The same by quadrature over a surface at(u, v), (u, v) in [0,1]^2, whose front is along d/du x d/dv before it is mapped by m.
/// The surface is convex or flat, so that every front that faces p is seen from there.
template <class At>
double surface_irradiance(D3 p, Mat4 const& m, At const& at) {
    constexpr int n = 250;
    constexpr double h = 1e-5;
    double const side = determinant3(m) < 0 ? -1 : 1;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double const u = (i + 0.5) / n;
            double const v = (j + 0.5) / n;
            D3 const area = cross(apply(m, at(u + h, v)) - apply(m, at(u - h, v)),
                                  apply(m, at(u, v + h)) - apply(m, at(u, v - h))) *
                            (side / (4 * h * h));
            D3 const w = apply(m, at(u, v)) - p;
            double const r2 = dot(w, w);
            double const cosines = w[2] * -dot(area, w);
            if (w[2] > 0 && cosines > 0) sum += cosines / (r2 * r2);
        }
    return sum / (n * n);
}

struct EmittingShape {
    std::string name;
    Shape shape;
    bool flat;
    std::function<double(Mat4 const&, D3)> irradiance;  // of one side, radiance 1
};

inline std::vector<EmittingShape> emitting_shapes() {
    constexpr double pi = 3.14159265358979323846;
    // All of them between z = -1/2 and 1/2, the flat ones looking down.
    Quad const quad{{-0.5f, 0.4f, 0}, {1, 0, 0}, {0.2f, -0.8f, 0}};
    auto const of_quad = [quad](Mat4 const& m, D3 p) {
        return std::max(0.0, polygon_irradiance(p, quad_corners(quad, m)));
    };
    Vec3 const c00 = quad.origin;
    Vec3 const c10 = c00 + quad.edge_u;
    Vec3 const c01 = c00 + quad.edge_v;
    Vec3 const c11 = c10 + quad.edge_v;
    BilinearMesh patch;
    patch.p = {c00, c10, c01, c11};
    patch.patches = {{0, 1, 2, 3}};
    Box const box{{-0.5f, -0.3f, -0.4f}, {0.4f, 0.5f, 0.3f}};
    auto const of_box = [box](Mat4 const& m, D3 p) {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (bool high : {false, true}) {
                Vec3 const size = box.hi - box.lo;
                Quad face{high ? box.hi : box.lo, {0, 0, 0}, {0, 0, 0}};
                int const a = (axis + (high ? 1 : 2)) % 3;
                int const b = (axis + (high ? 2 : 1)) % 3;
                face.edge_u[a] = high ? -size[a] : size[a];
                face.edge_v[b] = high ? -size[b] : size[b];
                sum += std::max(0.0, polygon_irradiance(p, quad_corners(face, m)));
            }
        return sum;
    };
    return {
        {"sphere", Sphere{0.5f, -0.5f, 0.5f}, false,
         [](Mat4 const& m, D3 p) {
             return surface_irradiance(p, m, [](double u, double v) {
                 double const s = std::sin(pi * u);
                 return D3{0.5 * s * std::cos(2 * pi * v), 0.5 * s * std::sin(2 * pi * v),
                           0.5 * std::cos(pi * u)};
             });
         }},
        {"cylinder", Cylinder{0.4f, -0.5f, 0.3f}, false,
         [](Mat4 const& m, D3 p) {
             return surface_irradiance(p, m, [](double u, double v) {
                 return D3{0.4 * std::cos(2 * pi * u), 0.4 * std::sin(2 * pi * u), -0.5 + 0.8 * v};
             });
         }},
        {"disk", Disk{0.1f, 0.5f, 0.2f}, true,
         [](Mat4 const& m, D3 p) {
             return surface_irradiance(p, m, [](double u, double v) {
                 double const r = 0.2 + 0.3 * u;
                 return D3{r * std::cos(2 * pi * v), r * std::sin(2 * pi * v), 0.1};
             });
         }},
        {"quad", quad, true, of_quad},
        {"triangles", rectangle(c00, c10, c11, c01), true, of_quad},
        {"bilinear patch", patch, true, of_quad},
        {"box", box, false, of_box},
        {"box of triangles", box_mesh(box.lo, box.hi, false), false, of_box},
    };
}

struct Placement {
    std::string name;
    Mat4 outer, middle, inner;  // outer * middle * inner
    [[nodiscard]] Mat4 all() const { return outer * (middle * inner); }
};
inline std::vector<Placement> placements() {
    Mat4 const up = translate(0.1, -0.1, 1.6);
    Mat4 const none;
    return {
        {"moved", up, none, none},
        {"scaled", up, scale(0.5, 0.5, 0.5), scale(2.8, 2.8, 2.8)},
        {"stretched", up, scale(1.5, 0.7, 1.2), rotation(20, 1, 0, 0)},
        {"rotated", up, rotation(25, 1, 0, 0), rotation(15, 0, 1, 0)},
        {"mirrored", up, rotation(15, 0, 1, 0), scale(-1, 1, 1)},
        {"sheared", up, shear(0.6), rotation(30, 0, 0, 1)},
        {"all at once", up * rotation(20, 0, 1, 0), scale(1.3, -0.8, 1), shear(-0.5) * rotation(10, 1, 1, 0)},
    };
}

/// The disk looks up in its own space: turned over first.
inline Mat4 turned(EmittingShape const& e, Mat4 const& m) {
    return std::holds_alternative<Disk>(e.shape) ? m * rotation(180, 1, 0, 0) : m;
}

/// nesting 0: the object itself is placed; 1: an instance is; 2: an instance within an instance.
inline void place(Scene& s, EmittingShape const& e, Placement const& where, int nesting,
                  AreaLight const& light) {
    if (nesting == 0) {
        Object& o = add(s, e.shape);
        o.to_group = turned(e, where.all());
        o.light = light;
        return;
    }
    GroupId const leaf = s.add(Group{});
    Object& o = add(s.groups[leaf.value], e.shape);
    o.to_group = turned(e, nesting == 1 ? Mat4{} : where.inner);
    o.light = light;
    if (nesting == 1) {
        s.world().instances.push_back({leaf, rows_of(where.all()), {}});
        return;
    }
    GroupId const branch = s.add(Group{});
    s.groups[branch.value].instances.push_back({leaf, rows_of(where.middle), {}});
    s.world().instances.push_back({branch, rows_of(where.outer), {}});
}

}  // namespace nephroid::test
