// Triangles of a mesh (PBRT 4th ed., 6.5), and the baking of transforms into meshes.
#include "model/shape.h"
#include "model/triangle_lanes.h"
#include "sampling/warp.h"
#include "triangle_point.h"

namespace nephroid {

namespace {

struct Corners {
    std::size_t i0, i1, i2;
    Float4 p0, p1, p2;

    Corners(TriangleMesh const& m, std::uint32_t triangle) {
        Vec3i const& t = m.triangles[triangle];
        i0 = static_cast<std::uint32_t>(t.x);
        i1 = static_cast<std::uint32_t>(t.y);
        i2 = static_cast<std::uint32_t>(t.z);
        p0 = to_lanes(m.p[i0]);
        p1 = to_lanes(m.p[i1]);
        p2 = to_lanes(m.p[i2]);
    }
    [[nodiscard]] Float4 edge1() const { return p1 - p0; }
    [[nodiscard]] Float4 edge2() const { return p2 - p0; }
    [[nodiscard]] Float4 area2() const { return double_area(p0, p1, p2); }
};

/// The point and the bound on its error.
void place(Corners const& c, Shares const& b, Vec3& p, Vec3& p_error) {
    TrianglePoint<Float4> const at(c.p0, c.p1, c.p2, b);
    p = to_vec3(at.p);
    p_error = to_vec3(at.p_error);
}
/// Of a mesh that has normals; not normalised.
Float4 interpolated_normal(TriangleMesh const& m, Corners const& c, Shares const& b) {
    return b.mean(to_lanes(m.n[c.i0]), to_lanes(m.n[c.i1]), to_lanes(m.n[c.i2]));
}
/// Without coordinates of its own a triangle has (0,0), (1,0), (1,1).
Vec2 interpolated_uv(TriangleMesh const& m, Corners const& c, Shares const& b) {
    return m.uv.empty() ? Vec2{b.b1 + b.b2, b.b2} : b.mean(m.uv[c.i0], m.uv[c.i1], m.uv[c.i2]);
}

void set_tangents(TriangleMesh const& m, Corners const& c, SurfacePoint& r) {
    Vec3 const e1 = to_vec3(c.edge1());
    Vec3 const e2 = to_vec3(c.edge2());
    Vec2 const uv0 = m.uv.empty() ? Vec2{0, 0} : m.uv[c.i0];
    Vec2 const uv1 = m.uv.empty() ? Vec2{1, 0} : m.uv[c.i1];
    Vec2 const uv2 = m.uv.empty() ? Vec2{1, 1} : m.uv[c.i2];
    Vec2 const d1 = uv1 - uv0;
    Vec2 const d2 = uv2 - uv0;
    float const det = difference_of_products(d1.x, d2.y, d1.y, d2.x);
    if (std::abs(det) > 1e-20f) {
        r.dpdu = (e1 * d2.y - e2 * d1.y) / det;
        r.dpdv = (e2 * d1.x - e1 * d2.x) / det;
    } else {
        r.dpdu = e1, r.dpdv = e2;
    }
}

}  // namespace

Bounds3 bounds(TriangleMesh const& mesh) {
    Bounds3 b;
    for (Vec3 const p : mesh.p) b.add(p);
    return b;
}

void triangle_surface(TriangleMesh const& m, std::uint32_t triangle, Vec2 uv, bool flip, bool tangents,
                      SurfacePoint& r) {
    Corners const c(m, triangle);
    Shares const b(uv);
    place(c, b, r.p, r.p_error);
    TriangleNormals<Float4> normals(c.area2(), flip);
    if (!m.n.empty()) normals.shade(interpolated_normal(m, c, b));
    r.ng = to_vec3(normals.ng);
    r.ns = to_vec3(normals.ns);
    r.uv = interpolated_uv(m, c, b);
    if (tangents) {
        set_tangents(m, c, r);
    } else {
        r.dpdu = r.dpdv = Vec3{0};
    }
}

void TriangleLanes::set(std::size_t lane, TriangleMesh const& m, std::uint32_t triangle, Vec2 uv, bool flip) {
    Vec3i const& t = m.triangles[triangle];
    auto const i0 = static_cast<std::uint32_t>(t.x);
    auto const i1 = static_cast<std::uint32_t>(t.y);
    auto const i2 = static_cast<std::uint32_t>(t.z);
    p_[0].set(lane, m.p[i0]), p_[1].set(lane, m.p[i1]), p_[2].set(lane, m.p[i2]);
    uv_.set(lane, uv);
    flip_[lane] = flip;
    if (m.n.empty()) return;
    n_[0].set(lane, m.n[i0]), n_[1].set(lane, m.n[i1]), n_[2].set(lane, m.n[i2]);
    shaded_ = true;
}

void TriangleLanes::surfaces(SurfaceLanes& __restrict s) const {
    for (std::size_t i = 0; i < kLanes; ++i) {
        TrianglePoint<Vec3> const at(p_[0][i], p_[1][i], p_[2][i], Shares(uv_[i]));
        TriangleNormals<Vec3> const normals(double_area(p_[0][i], p_[1][i], p_[2][i]), flip_[i] != 0);
        s.p.set(i, at.p);
        s.p_error.set(i, at.p_error);
        s.ng.set(i, normals.ng);
        s.ns.set(i, normals.ns);
    }
    if (!shaded_) return;
    for (std::size_t i = 0; i < kLanes; ++i) {
        TriangleNormals<Vec3> normals(double_area(p_[0][i], p_[1][i], p_[2][i]), flip_[i] != 0);
        normals.shade(Shares(uv_[i]).mean(n_[0][i], n_[1][i], n_[2][i]));
        s.ng.set(i, normals.ng);
        s.ns.set(i, normals.ns);
    }
}

float triangle_area(TriangleMesh const& m, std::uint32_t triangle) {
    return 0.5f * length(Corners(m, triangle).area2());
}

ShapeSample sample_triangle(TriangleMesh const& m, std::uint32_t triangle, bool flip, Vec2 u) {
    Corners const c(m, triangle);
    Shares const b(square_to_triangle(u));
    ShapeSample r;
    place(c, b, r.p, r.p_error);
    // Twice the area and the normal's direction are one vector.
    Float4 const area2 = c.area2();
    float const inv = 1.0f / length(area2);
    r.n = to_vec3(area2 * (flip ? -inv : inv));
    if (!m.n.empty()) r.n = face_forward(r.n, to_vec3(interpolated_normal(m, c, b)));
    r.uv = interpolated_uv(m, c, b);
    r.pdf_area = 2.0f * inv;
    return r;
}

namespace {
template <class Mesh>
void bake(Mesh& mesh, Mat4 const& m, bool reverse) {
    if (!is_identity(m)) {
        for (Vec3& p : mesh.p) {
            double const x = p.x;
            double const y = p.y;
            double const z = p.z;
            for (std::size_t i = 0; i < 3; ++i)
                p[static_cast<int>(i)] =
                    static_cast<float>(m.m[i][0] * x + m.m[i][1] * y + m.m[i][2] * z + m.m[i][3]);
        }
        if (auto const inv = inverse(m))
            for (Vec3& n : mesh.n) {
                double const x = n.x;
                double const y = n.y;
                double const z = n.z;
                for (std::size_t i = 0; i < 3; ++i)
                    n[static_cast<int>(i)] =
                        static_cast<float>(inv->m[0][i] * x + inv->m[1][i] * y + inv->m[2][i] * z);
            }
    }
    if (reverse)
        for (Vec3& n : mesh.n) n = -n;
}
}  // namespace

void transform_mesh(TriangleMesh& mesh, Mat4 const& to_world, bool reverse) { bake(mesh, to_world, reverse); }
void transform_mesh(BilinearMesh& mesh, Mat4 const& to_world, bool reverse) { bake(mesh, to_world, reverse); }

}  // namespace nephroid
