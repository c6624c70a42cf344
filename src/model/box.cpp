// Axis-aligned box, normals outwards. Part = face: 2 * axis + (0 at lo, 1 at hi).
#include "shape_common.h"

#include <limits>
#include <utility>

namespace nephroid {

Bounds3 bounds(Box const& s) { return {s.lo, s.hi}; }

std::optional<ShapeHit> intersect(Box const& s, std::uint32_t, Ray3d const& ray, double t_min, double t_max) {
    // Slabs (Kay & Kajiya 1986), remembering the faces by which the ray enters and leaves.
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    std::uint32_t enter_face = 0;
    std::uint32_t leave_face = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        double const lo = s.lo[static_cast<int>(axis)];
        double const hi = s.hi[static_cast<int>(axis)];
        double const o = ray.o[axis];
        if (ray.d[axis] == 0) {
            if (o < lo || o > hi) return std::nullopt;
            continue;
        }
        double t0 = (lo - o) / ray.d[axis];
        double t1 = (hi - o) / ray.d[axis];
        std::uint32_t f0 = 2 * axis;
        std::uint32_t f1 = 2 * axis + 1;
        if (t0 > t1) std::swap(t0, t1), std::swap(f0, f1);
        if (t0 > enter) enter = t0, enter_face = f0;
        if (t1 < leave) leave = t1, leave_face = f1;
    }
    if (enter > leave) return std::nullopt;
    if (enter > t_min && enter < t_max) return ShapeHit{enter, 0, 0, enter_face};
    if (leave > t_min && leave < t_max) return ShapeHit{leave, 0, 0, leave_face};
    return std::nullopt;
}

SurfacePoint surface(Box const& s, ShapeHit const& hit, Vec3 p) {
    int const axis = static_cast<int>(hit.part / 2);
    bool const high = hit.part % 2 != 0;
    int const a = (axis + 1) % 3;
    int const b = (axis + 2) % 3;
    p[axis] = high ? s.hi[axis] : s.lo[axis];
    SurfacePoint r;
    r.p = p;  // exact in the normal's direction; elsewhere on the face by rounding, which does not matter
    r.ng = Vec3{0, 0, 0};
    r.ng[axis] = high ? 1.0f : -1.0f;
    r.ns = r.ng;
    float const wa = s.hi[a] - s.lo[a];
    float const wb = s.hi[b] - s.lo[b];
    r.uv = {(p[a] - s.lo[a]) / wa, (p[b] - s.lo[b]) / wb};
    r.dpdu = r.dpdv = Vec3{0, 0, 0};
    r.dpdu[a] = wa;
    r.dpdv[b] = wb;
    return r;
}

std::uint32_t part_count(Box const&) { return 6; }
float part_area(Box const& s, std::uint32_t part) {
    int const axis = static_cast<int>(part / 2);
    Vec3 const d = s.hi - s.lo;
    return d[(axis + 1) % 3] * d[(axis + 2) % 3];
}

ShapeSample sample(Box const& s, std::uint32_t part, Vec2 u) {
    int const axis = static_cast<int>(part / 2);
    int const a = (axis + 1) % 3;
    int const b = (axis + 2) % 3;
    Vec3 p;
    p[axis] = part % 2 ? s.hi[axis] : s.lo[axis];
    p[a] = lerp(u.x, s.lo[a], s.hi[a]);
    p[b] = lerp(u.y, s.lo[b], s.hi[b]);
    ShapeSample r;
    r.p = p;
    r.n = Vec3{0, 0, 0};
    r.n[axis] = part % 2 ? 1.0f : -1.0f;
    r.uv = u;
    r.pdf_area = 1.0f / part_area(s, part);
    return r;
}

std::optional<Vec2> invert_area(Box const& s, std::uint32_t part, Vec3 p, Vec2) {
    int const axis = static_cast<int>(part / 2);
    int const a = (axis + 1) % 3;
    int const b = (axis + 2) % 3;
    return detail::unit_square((p[a] - s.lo[a]) / (s.hi[a] - s.lo[a]),
                               (p[b] - s.lo[b]) / (s.hi[b] - s.lo[b]));
}

}  // namespace nephroid
