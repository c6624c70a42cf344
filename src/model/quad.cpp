// Parallelogram; (s, t) are its coordinates along the two edges and its uv.
#include "shape_common.h"

namespace nephroid {

namespace {
Vec3 quad_point(Quad const& q, float s, float t) { return q.origin + s * q.edge_u + t * q.edge_v; }
Vec3 quad_error(Quad const& q, float s, float t) {
    return gamma_bound(4) * (abs(q.origin) + s * abs(q.edge_u) + t * abs(q.edge_v));
}
}  // namespace

Bounds3 bounds(Quad const& q) {
    Bounds3 b;
    for (int i = 0; i < 4; ++i) b.add(quad_point(q, static_cast<float>(i & 1), static_cast<float>(i >> 1)));
    return b;
}

std::optional<ShapeHit> intersect(Quad const& q, std::uint32_t, Ray3d const& ray, double t_min,
                                  double t_max) {
    auto const eu = detail::to_double(q.edge_u);
    auto const ev = detail::to_double(q.edge_v);
    auto const n = detail::cross3(eu, ev);
    double const denominator = detail::dot3(n, ray.d);
    if (denominator == 0) return std::nullopt;
    auto const to_origin = detail::sub(detail::to_double(q.origin), ray.o);
    double const t = detail::dot3(n, to_origin) / denominator;
    if (!(t > t_min && t < t_max)) return std::nullopt;
    // Coordinates by Cramer's rule on the plane: w = p - origin = s eu + v ev.
    auto const w = detail::sub(detail::at(ray, t), detail::to_double(q.origin));
    double const nn = detail::dot3(n, n);
    double const s = detail::dot3(detail::cross3(w, ev), n) / nn;
    double const v = detail::dot3(detail::cross3(eu, w), n) / nn;
    if (s < 0 || s > 1 || v < 0 || v > 1) return std::nullopt;
    return ShapeHit{t, static_cast<float>(s), static_cast<float>(v), 0};
}

SurfacePoint surface(Quad const& q, ShapeHit const& hit, Vec3) {
    SurfacePoint r;
    r.p = quad_point(q, hit.u, hit.v);
    r.p_error = quad_error(q, hit.u, hit.v);
    r.ng = normalize(cross_accurate(q.edge_u, q.edge_v));
    r.ns = r.ng;
    r.uv = {hit.u, hit.v};
    r.dpdu = q.edge_u;
    r.dpdv = q.edge_v;
    return r;
}

std::uint32_t part_count(Quad const&) { return 1; }
float part_area(Quad const& q, std::uint32_t) { return length(cross_accurate(q.edge_u, q.edge_v)); }

ShapeSample sample(Quad const& q, std::uint32_t part, Vec2 u) {
    ShapeSample r;
    r.p = quad_point(q, u.x, u.y);
    r.p_error = quad_error(q, u.x, u.y);
    r.n = normalize(cross_accurate(q.edge_u, q.edge_v));
    r.uv = u;
    r.pdf_area = 1.0f / part_area(q, part);
    return r;
}

std::optional<Vec2> invert_area(Quad const&, std::uint32_t, Vec3, Vec2 uv) {
    return detail::unit_square(uv.x, uv.y);
}

}  // namespace nephroid
