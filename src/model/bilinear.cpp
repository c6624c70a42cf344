// Bilinear patches p(u,v) = (1-u)(1-v) p00 + u (1-v) p10 + (1-u) v p01 + u v p11 (PBRT 4th ed., 6.6; Reshetov 2019).
#include "shape_common.h"

namespace nephroid {

namespace {

struct Corners {
    Vec3 p00, p10, p01, p11;
};
Corners corners(BilinearMesh const& m, std::uint32_t patch) {
    auto const& i = m.patches[patch];
    auto const at = [&](int k) { return m.p[static_cast<std::size_t>(i[static_cast<std::size_t>(k)])]; };
    return {at(0), at(1), at(2), at(3)};
}
template <class T>
T mix4(T const& a, T const& b, T const& c, T const& d, float u, float v) {
    return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
}
struct Tangents {
    Vec3 du, dv;
};
Tangents tangents(Corners const& c, float u, float v) {
    return {(1 - v) * (c.p10 - c.p00) + v * (c.p11 - c.p01), (1 - u) * (c.p01 - c.p00) + u * (c.p11 - c.p10)};
}
Vec3 point_error(Corners const& c, float u, float v) {
    return gamma_bound(6) * mix4(abs(c.p00), abs(c.p10), abs(c.p01), abs(c.p11), u, v);
}
/// Texture coordinates of the mesh at the patch's own (u, v).
Vec2 mesh_uv(BilinearMesh const& m, std::uint32_t patch, float u, float v) {
    if (m.uv.empty()) return {u, v};
    auto const& i = m.patches[patch];
    auto const at = [&](int k) { return m.uv[static_cast<std::size_t>(i[static_cast<std::size_t>(k)])]; };
    return mix4(at(0), at(1), at(2), at(3), u, v);
}
Vec3 mesh_normal(BilinearMesh const& m, std::uint32_t patch, float u, float v) {
    auto const& i = m.patches[patch];
    auto const at = [&](int k) { return m.n[static_cast<std::size_t>(i[static_cast<std::size_t>(k)])]; };
    return mix4(at(0), at(1), at(2), at(3), u, v);
}
/// Geometric normal: across the tangents, turned to the side of the mesh's normals where there are any.
Vec3 patch_normal(BilinearMesh const& m, std::uint32_t patch, Tangents const& t, float u, float v) {
    Vec3 const raw = cross_accurate(t.du, t.dv);
    float const len = length(raw);
    Vec3 n = len > 0.0f ? raw / len : Vec3{0, 0, 1};
    if (!m.n.empty()) n = face_forward(n, mesh_normal(m, patch, u, v));
    return n;
}

}  // namespace

Bounds3 primitive_bounds(BilinearMesh const& m, std::uint32_t patch) {
    Corners const c = corners(m, patch);
    Bounds3 b;
    for (Vec3 const p : {c.p00, c.p10, c.p01, c.p11}) b.add(p);
    return b;
}
Bounds3 bounds(BilinearMesh const& m) {
    Bounds3 b;
    for (Vec3 const p : m.p) b.add(p);
    return b;
}

std::optional<ShapeHit> intersect(BilinearMesh const& m, std::uint32_t prim, Ray3d const& ray, double t_min,
                                  double t_max) {
    // For a fixed u the patch is a line a(u) + v d(u); the ray meets it where the three are coplanar with the ray:
    // ((a(u) - o) x d_line(u)) . d = 0, a quadratic in u. For each root the nearest points of the two lines give t and v.
    Corners const c = corners(m, prim);
    auto const p00 = detail::sub(detail::to_double(c.p00), ray.o);
    auto const p10 = detail::sub(detail::to_double(c.p10), ray.o);
    auto const p01 = detail::sub(detail::to_double(c.p01), ray.o);
    auto const p11 = detail::sub(detail::to_double(c.p11), ray.o);
    auto const e00 = detail::sub(p01, p00);
    auto const e10 = detail::sub(p11, p10);
    // f(u) = (a(u) x d) . (v line direction), expanded in u.
    double const f0 = detail::dot3(detail::cross3(p00, ray.d), e00);
    double const f1 = detail::dot3(detail::cross3(p10, ray.d), e10);
    auto const q = detail::cross3(detail::sub(p10, p00), detail::sub(e10, e00));
    double const a2 = -detail::dot3(q, ray.d);  // u^2
    double const a1 = f1 - f0 - a2;             // u
    double roots[2];
    int n = 0;
    double const scale = std::abs(f0) + std::abs(f1);
    if (std::abs(a2) <= 1e-14 * scale) {
        if (a1 == 0) return std::nullopt;
        roots[n++] = -f0 / a1;
    } else {
        double const discriminant = a1 * a1 - 4 * a2 * f0;
        if (discriminant < 0) return std::nullopt;
        double const s = -0.5 * (a1 + std::copysign(std::sqrt(discriminant), a1));
        roots[n++] = s / a2;
        if (s != 0) roots[n++] = f0 / s;
    }
    std::optional<ShapeHit> best;
    for (int i = 0; i < n; ++i) {
        double const u = roots[i];
        if (!(u >= 0 && u <= 1)) continue;
        std::array<double, 3> a;
        std::array<double, 3> e;
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = (1 - u) * p00[k] + u * p10[k];
            e[k] = (1 - u) * e00[k] + u * e10[k];
        }
        auto const normal = detail::cross3(ray.d, e);
        double const nn = detail::dot3(normal, normal);
        if (nn == 0) continue;
        double const t = detail::dot3(detail::cross3(a, e), normal) / nn;
        double const v = detail::dot3(detail::cross3(a, ray.d), normal) / nn;
        // Where the patch lies in a coordinate plane, a ray that leaves it starts on it to the bit, and t is 0 but for rounding.
        double const on_it = 1e-12 * std::sqrt(detail::dot3(a, a) / detail::dot3(ray.d, ray.d));
        if (t <= on_it) continue;
        if (!(v >= 0 && v <= 1) || !(t > t_min && t < t_max)) continue;
        if (!best || t < best->t) best = ShapeHit{t, static_cast<float>(u), static_cast<float>(v), prim};
    }
    return best;
}

SurfacePoint surface(BilinearMesh const& m, ShapeHit const& hit, Vec3) {
    Corners const c = corners(m, hit.part);
    Tangents const t = tangents(c, hit.u, hit.v);
    SurfacePoint r;
    r.p = mix4(c.p00, c.p10, c.p01, c.p11, hit.u, hit.v);
    r.p_error = point_error(c, hit.u, hit.v);
    r.ng = patch_normal(m, hit.part, t, hit.u, hit.v);
    r.ns = r.ng;
    r.dpdu = t.du;
    r.dpdv = t.dv;
    r.uv = mesh_uv(m, hit.part, hit.u, hit.v);
    if (!m.uv.empty()) {
        // dp/d(s,t) of the mesh's own coordinates by the inverse of d(s,t)/d(u,v).
        Vec2 const ds_u = mesh_uv(m, hit.part, 1, hit.v) - mesh_uv(m, hit.part, 0, hit.v);
        Vec2 const ds_v = mesh_uv(m, hit.part, hit.u, 1) - mesh_uv(m, hit.part, hit.u, 0);
        float const det = difference_of_products(ds_u.x, ds_v.y, ds_v.x, ds_u.y);
        if (det != 0.0f) {
            r.dpdu = (t.du * ds_v.y - t.dv * ds_u.y) / det;
            r.dpdv = (t.dv * ds_u.x - t.du * ds_v.x) / det;
        }
    }
    if (!m.n.empty()) {
        Vec3 const ns = mesh_normal(m, hit.part, hit.u, hit.v);
        if (length_squared(ns) > 0.0f) r.ns = normalize(ns);
    }
    return r;
}

std::uint32_t part_count(BilinearMesh const& m) { return static_cast<std::uint32_t>(m.patches.size()); }

float part_area(BilinearMesh const& m, std::uint32_t part) {
    // No closed form for a twisted patch: Gauss-Legendre, 4 x 4 nodes, exact for planar ones (the integrand is bilinear there).
    constexpr float node[4] = {0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f};
    constexpr float weight[4] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};
    Corners const c = corners(m, part);
    float area = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            Tangents const t = tangents(c, node[i], node[j]);
            area += weight[i] * weight[j] * length(cross_accurate(t.du, t.dv));
        }
    return area;
}

float sample_pdf(BilinearMesh const& m, std::uint32_t patch, Vec2 uv) {
    Tangents const t = tangents(corners(m, patch), uv.x, uv.y);
    float const element = length(cross_accurate(t.du, t.dv));
    return element > 0.0f ? 1.0f / element : 0.0f;
}

ShapeSample sample(BilinearMesh const& m, std::uint32_t part, Vec2 u) {
    Corners const c = corners(m, part);
    Tangents const t = tangents(c, u.x, u.y);
    ShapeSample r;
    r.p = mix4(c.p00, c.p10, c.p01, c.p11, u.x, u.y);
    r.p_error = point_error(c, u.x, u.y);
    r.n = patch_normal(m, part, t, u.x, u.y);
    r.uv = mesh_uv(m, part, u.x, u.y);
    r.pdf_area = sample_pdf(m, part, u);
    return r;
}

std::optional<Vec2> invert_area(BilinearMesh const&, std::uint32_t, Vec3, Vec2 uv) {
    return detail::unit_square(uv.x, uv.y);
}

}  // namespace nephroid
