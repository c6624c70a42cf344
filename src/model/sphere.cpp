// Sphere about the origin, poles on z, cut in z and phi. Parametrisation of PBRT 4th ed., 6.2.
#include "model/sphere_ray.h"
#include "sampling/warp.h"
#include "shape_common.h"

namespace nephroid {

namespace {
/// Where it is cut; beyond its poles where it is not.
float lowest(Sphere const& s) {
    float const z = std::fmin(s.z_min, s.z_max);
    return z > -s.radius ? min(z, s.radius) : -kInfinity;
}
float highest(Sphere const& s) {
    float const z = std::fmax(s.z_min, s.z_max);
    return z < s.radius ? max(z, -s.radius) : kInfinity;
}

struct Cut {
    float z_lo, z_hi, theta_lo, theta_hi;  // theta of z_lo (larger) and of z_hi
    bool full_z;
};
Cut cut_of(Sphere const& s) {
    float const lo = max(lowest(s), -s.radius);
    float const hi = min(highest(s), s.radius);
    return {lo, hi, std::acos(clamp(lo / s.radius, -1.0f, 1.0f)),
            std::acos(clamp(hi / s.radius, -1.0f, 1.0f)), lo <= -s.radius && hi >= s.radius};
}
}  // namespace

Bounds3 bounds(Sphere const& s) {
    Cut const c = cut_of(s);
    Bounds3 b;
    b.add({-s.radius, -s.radius, c.z_lo});
    b.add({s.radius, s.radius, c.z_hi});
    return b;
}

bool is_whole(Sphere const& s) {
    return lowest(s) == -kInfinity && highest(s) == kInfinity && !(s.phi_max < kTwoPi);
}

std::optional<ShapeHit> intersect(Sphere const& s, std::uint32_t, Ray3d const& ray, double t_min,
                                  double t_max) {
    SphereEquation const e(ray, s.radius);
    if (!e.solvable()) return std::nullopt;
    SphereRoots const roots(e);
    double const z_lo = lowest(s);
    double const z_hi = highest(s);
    for (bool const far : {false, true}) {
        if (!far && e.from_inside()) continue;
        double const t = far ? roots.far : roots.near;
        if (!(t > t_min && t < t_max)) continue;
        auto const p = detail::at(ray, t);
        if (p[2] < z_lo || p[2] > z_hi) continue;
        if (s.phi_max < kTwoPi && detail::azimuth(p[0], p[1]) > s.phi_max) continue;
        return ShapeHit{t, 0, 0, 0};
    }
    return std::nullopt;
}

SurfacePoint bare_surface(Sphere const& s, Vec3 p) {
    p *= s.radius / length(p);
    if (p.x == 0.0f && p.y == 0.0f) p.x = 1e-5f * s.radius;  // the pole has no azimuth: pick one
    SurfacePoint r;
    r.p = p;
    r.p_error = gamma_bound(5) * abs(p);
    r.ng = normalize(p);
    r.ns = r.ng;
    return r;
}
SurfacePoint surface(Sphere const& s, ShapeHit const&, Vec3 local) {
    Cut const cut = cut_of(s);
    SurfacePoint r = bare_surface(s, local);
    Vec3 const p = r.p;
    float const phi = detail::azimuth(p.x, p.y);
    float const theta = std::acos(clamp(p.z / s.radius, -1.0f, 1.0f));
    float const span = cut.theta_hi - cut.theta_lo;
    r.uv = {phi / s.phi_max, (theta - cut.theta_lo) / span};
    float const rho = std::sqrt(p.x * p.x + p.y * p.y);
    float const cos_phi = p.x / rho;
    float const sin_phi = p.y / rho;
    r.dpdu = {-s.phi_max * p.y, s.phi_max * p.x, 0};
    r.dpdv = span * Vec3{p.z * cos_phi, p.z * sin_phi, -rho};
    return r;
}

std::uint32_t part_count(Sphere const&) { return 1; }
float part_area(Sphere const& s, std::uint32_t) {
    Cut const c = cut_of(s);
    return s.phi_max * s.radius * (c.z_hi - c.z_lo);  // Archimedes
}

ShapeSample sample(Sphere const& s, std::uint32_t part, Vec2 u) {
    // Uniform in z and phi is uniform by area (Archimedes). u.x = 0 is the top, as square_to_uniform_sphere has it.
    Cut const c = cut_of(s);
    float const z = c.z_hi - u.x * (c.z_hi - c.z_lo);
    float const rho = c.full_z ? 2.0f * s.radius * safe_sqrt(u.x * (1.0f - u.x))
                               : safe_sqrt((s.radius - z) * (s.radius + z));
    float const phi = u.y * s.phi_max;
    Vec3 p{rho * std::cos(phi), rho * std::sin(phi), z};
    p *= s.radius / length(p);
    ShapeSample r;
    r.p = p;
    r.p_error = gamma_bound(5) * abs(p);
    r.n = normalize(p);
    float const theta = std::acos(clamp(p.z / s.radius, -1.0f, 1.0f));
    r.uv = {u.y, (theta - c.theta_lo) / (c.theta_hi - c.theta_lo)};
    r.pdf_area = 1.0f / part_area(s, part);
    return r;
}

std::optional<Vec2> invert_area(Sphere const& s, std::uint32_t, Vec3 p, Vec2) {
    Cut const c = cut_of(s);
    p *= s.radius / length(p);
    return detail::unit_square((c.z_hi - p.z) / (c.z_hi - c.z_lo), detail::azimuth(p.x, p.y) / s.phi_max);
}

}  // namespace nephroid
