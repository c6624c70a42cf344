// Triangles of a mesh (PBRT 4th ed., 6.5), and the baking of transforms into meshes.
#include "model/shape.h"
#include "sampling/warp.h"

namespace nephroid {

namespace {
struct Corners {
    std::size_t i0, i1, i2;
    Vec3 p0, p1, p2;
};
Corners corners(TriangleMesh const& m, std::uint32_t triangle) {
    Vec3i const t = m.triangles[triangle];
    auto const i0 = static_cast<std::size_t>(t.x);
    auto const i1 = static_cast<std::size_t>(t.y);
    auto const i2 = static_cast<std::size_t>(t.z);
    return {i0, i1, i2, m.p[i0], m.p[i1], m.p[i2]};
}
Vec3 interpolated_normal(TriangleMesh const& m, Corners const& c, float b0, float b1, float b2) {
    return b0 * m.n[c.i0] + b1 * m.n[c.i1] + b2 * m.n[c.i2];
}
}  // namespace

Bounds3 bounds(TriangleMesh const& mesh) {
    Bounds3 b;
    for (Vec3 const p : mesh.p) b.add(p);
    return b;
}

void triangle_surface(TriangleMesh const& m, std::uint32_t triangle, Vec2 b, bool flip, bool tangents,
                      SurfacePoint& r) {
    Corners const c = corners(m, triangle);
    float const b1 = b.x;
    float const b2 = b.y;
    float const b0 = 1.0f - b1 - b2;
    r.p = b0 * c.p0 + b1 * c.p1 + b2 * c.p2;
    r.p_error = gamma_bound(7) * (abs(b0 * c.p0) + abs(b1 * c.p1) + abs(b2 * c.p2));
    Vec3 const e1 = c.p1 - c.p0;
    Vec3 const e2 = c.p2 - c.p0;
    r.ng = normalize(cross_accurate(e1, e2));
    if (flip) r.ng = -r.ng;
    r.ns = r.ng;
    if (!m.n.empty()) {
        Vec3 const ns = interpolated_normal(m, c, b0, b1, b2);
        float const len2 = length_squared(ns);
        if (len2 > 0.0f) {
            r.ns = ns / std::sqrt(len2);
            r.ng = face_forward(r.ng, r.ns);
        }
    }
    // Without coordinates of its own a triangle has (0,0), (1,0), (1,1).
    r.uv = m.uv.empty() ? Vec2{b1 + b2, b2} : b0 * m.uv[c.i0] + b1 * m.uv[c.i1] + b2 * m.uv[c.i2];
    if (tangents) {
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
    } else {
        r.dpdu = r.dpdv = Vec3{0};
    }
}

float triangle_area(TriangleMesh const& m, std::uint32_t triangle) {
    Corners const c = corners(m, triangle);
    return 0.5f * length(cross_accurate(c.p1 - c.p0, c.p2 - c.p0));
}

ShapeSample sample_triangle(TriangleMesh const& m, std::uint32_t triangle, bool flip, Vec2 u) {
    Corners const c = corners(m, triangle);
    Vec2 const b = square_to_triangle(u);
    float const b0 = 1.0f - b.x - b.y;
    ShapeSample r;
    r.p = b0 * c.p0 + b.x * c.p1 + b.y * c.p2;
    r.p_error = gamma_bound(7) * (abs(b0 * c.p0) + abs(b.x * c.p1) + abs(b.y * c.p2));
    // Twice the area and the normal's direction are one vector.
    Vec3 const area2 = cross_accurate(c.p1 - c.p0, c.p2 - c.p0);
    float const inv = 1.0f / length(area2);
    r.n = area2 * (flip ? -inv : inv);
    if (!m.n.empty()) r.n = face_forward(r.n, interpolated_normal(m, c, b0, b.x, b.y));
    r.uv = m.uv.empty() ? Vec2{b.x + b.y, b.y} : b0 * m.uv[c.i0] + b.x * m.uv[c.i1] + b.y * m.uv[c.i2];
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
