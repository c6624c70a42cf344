// Disk (or ring, or sector) in the plane z = height, normal +z. Parametrisation of PBRT 4th ed., 6.4.
#include "sampling/warp.h"
#include "shape_common.h"

namespace nephroid {

Bounds3 bounds(Disk const& s) {
    Bounds3 b;
    b.add({-s.radius, -s.radius, s.height});
    b.add({s.radius, s.radius, s.height});
    return b;
}

std::optional<ShapeHit> intersect(Disk const& s, std::uint32_t, Ray3d const& ray, double t_min,
                                  double t_max) {
    if (ray.d[2] == 0) return std::nullopt;
    double const t = (s.height - ray.o[2]) / ray.d[2];
    if (!(t > t_min && t < t_max)) return std::nullopt;
    auto const p = detail::at(ray, t);
    double const d2 = p[0] * p[0] + p[1] * p[1];
    double const inner = s.inner_radius;
    double const outer = s.radius;
    if (d2 > outer * outer || d2 < inner * inner) return std::nullopt;
    if (s.phi_max < kTwoPi && detail::azimuth(p[0], p[1]) > s.phi_max) return std::nullopt;
    return ShapeHit{t, 0, 0, 0};
}

SurfacePoint surface(Disk const& s, ShapeHit const&, Vec3 p) {
    SurfacePoint r;
    r.p = {p.x, p.y, s.height};
    float const rho = std::sqrt(p.x * p.x + p.y * p.y);
    float const width = s.radius - s.inner_radius;
    r.uv = {detail::azimuth(p.x, p.y) / s.phi_max, (s.radius - rho) / width};
    r.dpdu = {-s.phi_max * p.y, s.phi_max * p.x, 0};
    r.dpdv = rho > 0.0f ? Vec3{p.x, p.y, 0} * (-width / rho) : Vec3{-width, 0, 0};
    return r;
}

std::uint32_t part_count(Disk const&) { return 1; }
float part_area(Disk const& s, std::uint32_t) {
    return s.phi_max * 0.5f * (s.radius - s.inner_radius) * (s.radius + s.inner_radius);
}

ShapeSample sample(Disk const& s, std::uint32_t part, Vec2 u) {
    ShapeSample r;
    if (s.inner_radius == 0.0f && s.phi_max >= kTwoPi) {
        Vec2 const d = square_to_disk(u);
        r.p = {d.x * s.radius, d.y * s.radius, s.height};
    } else {
        // r^2 uniform between the inner and the outer radius.
        float const rho = std::sqrt(lerp(u.x, sqr(s.inner_radius), sqr(s.radius)));
        float const phi = u.y * s.phi_max;
        r.p = {rho * std::cos(phi), rho * std::sin(phi), s.height};
    }
    float const rho = std::sqrt(r.p.x * r.p.x + r.p.y * r.p.y);
    r.uv = {detail::azimuth(r.p.x, r.p.y) / s.phi_max, (s.radius - rho) / (s.radius - s.inner_radius)};
    r.n = {0, 0, 1};
    r.pdf_area = 1.0f / part_area(s, part);
    return r;
}

std::optional<Vec2> invert_area(Disk const& s, std::uint32_t, Vec3 p, Vec2) {
    float const r2 = p.x * p.x + p.y * p.y;
    float const u = (r2 - sqr(s.inner_radius)) / (sqr(s.radius) - sqr(s.inner_radius));
    if (s.inner_radius == 0.0f && s.phi_max >= kTwoPi) {
        if (!detail::unit_square(u, 0.0f)) return std::nullopt;
        return disk_to_square({p.x / s.radius, p.y / s.radius});
    }
    return detail::unit_square(u, detail::azimuth(p.x, p.y) / s.phi_max);
}

}  // namespace nephroid
