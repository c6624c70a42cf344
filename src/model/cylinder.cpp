// Open cylinder about the z axis. Parametrisation of PBRT 4th ed., 6.3.
#include "shape_common.h"

namespace nephroid {

namespace {
float z_lo(Cylinder const& s) { return std::fmin(s.z_min, s.z_max); }
float z_hi(Cylinder const& s) { return std::fmax(s.z_min, s.z_max); }
}  // namespace

Bounds3 bounds(Cylinder const& s) {
    Bounds3 b;
    b.add({-s.radius, -s.radius, z_lo(s)});
    b.add({s.radius, s.radius, z_hi(s)});
    return b;
}

std::optional<ShapeHit> intersect(Cylinder const& s, std::uint32_t, Ray3d const& ray, double t_min,
                                  double t_max) {
    // The circle x^2 + y^2 = r^2, solved as for the sphere with z left out.
    double const r = s.radius;
    double const a = ray.d[0] * ray.d[0] + ray.d[1] * ray.d[1];
    if (a == 0) return std::nullopt;
    double const h = ray.d[0] * ray.o[0] + ray.d[1] * ray.o[1];
    double const len_o = std::sqrt(ray.o[0] * ray.o[0] + ray.o[1] * ray.o[1]);
    double const c = (len_o - r) * (len_o + r);
    double const vx = ray.o[0] - h / a * ray.d[0];
    double const vy = ray.o[1] - h / a * ray.d[1];
    double const len_v = std::sqrt(vx * vx + vy * vy);
    double t[2];
    if (!detail::solve_quadratic(a, h, c, a * (r - len_v) * (r + len_v), t[0], t[1])) return std::nullopt;
    for (double const ti : t) {
        if (!(ti > t_min && ti < t_max)) continue;
        auto const p = detail::at(ray, ti);
        if (p[2] < z_lo(s) || p[2] > z_hi(s)) continue;
        if (s.phi_max < kTwoPi && detail::azimuth(p[0], p[1]) > s.phi_max) continue;
        return ShapeHit{ti, 0, 0, 0};
    }
    return std::nullopt;
}

SurfacePoint surface(Cylinder const& s, ShapeHit const&, Vec3 p) {
    float const rho = std::sqrt(p.x * p.x + p.y * p.y);
    p.x *= s.radius / rho;
    p.y *= s.radius / rho;
    SurfacePoint r;
    r.p = p;
    r.p_error = gamma_bound(3) * abs(Vec3{p.x, p.y, 0});
    r.ng = normalize(Vec3{p.x, p.y, 0});
    r.ns = r.ng;
    float const height = z_hi(s) - z_lo(s);
    r.uv = {detail::azimuth(p.x, p.y) / s.phi_max, (p.z - z_lo(s)) / height};
    r.dpdu = {-s.phi_max * p.y, s.phi_max * p.x, 0};
    r.dpdv = {0, 0, height};
    return r;
}

std::uint32_t part_count(Cylinder const&) { return 1; }
float part_area(Cylinder const& s, std::uint32_t) { return (z_hi(s) - z_lo(s)) * s.radius * s.phi_max; }

ShapeSample sample(Cylinder const& s, std::uint32_t part, Vec2 u) {
    float const phi = u.y * s.phi_max;
    Vec3 const n{std::cos(phi), std::sin(phi), 0};
    ShapeSample r;
    r.n = normalize(n);
    r.p = {s.radius * r.n.x, s.radius * r.n.y, lerp(u.x, z_lo(s), z_hi(s))};
    r.p_error = gamma_bound(3) * abs(Vec3{r.p.x, r.p.y, 0});
    r.uv = {u.y, u.x};
    r.pdf_area = 1.0f / part_area(s, part);
    return r;
}

std::optional<Vec2> invert_area(Cylinder const& s, std::uint32_t, Vec3 p, Vec2) {
    return detail::unit_square((p.z - z_lo(s)) / (z_hi(s) - z_lo(s)), detail::azimuth(p.x, p.y) / s.phi_max);
}

}  // namespace nephroid
