#include "tessellate.h"

#include "model/shape.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::peers {

namespace {

/// A surface p(u, v) over the unit square, in m x n cells. At the edges that `closed_*` names a whole row is one point.
template <class Point>
TriangleMesh grid(int m, int n, bool closed_start, bool closed_end, Point&& point) {
    TriangleMesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= m; ++i) {
            Vec2 const uv{static_cast<float>(i) / static_cast<float>(m),
                          static_cast<float>(j) / static_cast<float>(n)};
            auto const [p, normal] = point(uv);
            mesh.p.push_back(p);
            mesh.n.push_back(normal);
            mesh.uv.push_back(uv);
        }
    auto const at = [m](int i, int j) { return j * (m + 1) + i; };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < m; ++i) {
            if (!(closed_start && j == 0))
                mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            if (!(closed_end && j == n - 1))
                mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

using PointNormal = std::pair<Vec3, Vec3>;

/// Of a whole turn, in the share that the shape has.
int part_of(int segments, float phi_max) {
    return std::max(3, static_cast<int>(std::ceil(static_cast<float>(segments) * phi_max / kTwoPi)));
}

TriangleMesh mesh_of(Sphere const& s, int segments) {
    float const lo = std::max(std::min(s.z_min, s.z_max), -s.radius);
    float const hi = std::min(std::max(s.z_min, s.z_max), s.radius);
    float const from = std::acos(clamp(hi / s.radius, -1, 1)), to = std::acos(clamp(lo / s.radius, -1, 1));
    // (u, v) of a sphere: longitude, and the angle from +z, in shares.
    return grid(part_of(segments, s.phi_max), std::max(2, segments / 2), from == 0, to >= kPi, [&](Vec2 uv) {
        float const phi = uv.x * s.phi_max, theta = lerp(uv.y, from, to);
        Vec3 const n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        return PointNormal{s.radius * n, n};
    });
}
TriangleMesh mesh_of(Cylinder const& s, int segments) {
    float const lo = std::min(s.z_min, s.z_max), hi = std::max(s.z_min, s.z_max);
    return grid(part_of(segments, s.phi_max), 1, false, false, [&](Vec2 uv) {
        float const phi = uv.x * s.phi_max;
        Vec3 const n{std::cos(phi), std::sin(phi), 0};
        return PointNormal{Vec3{s.radius * n.x, s.radius * n.y, lerp(uv.y, lo, hi)}, n};
    });
}
TriangleMesh mesh_of(Disk const& s, int segments) {
    return grid(part_of(segments, s.phi_max), 1, false, s.inner_radius == 0, [&](Vec2 uv) {
        float const phi = uv.x * s.phi_max, r = lerp(uv.y, s.radius, s.inner_radius);
        return PointNormal{Vec3{r * std::cos(phi), r * std::sin(phi), s.height}, Vec3{0, 0, 1}};
    });
}
TriangleMesh parallelogram(Vec3 origin, Vec3 u, Vec3 v) {
    TriangleMesh m;
    m.p = {origin, origin + u, origin + u + v, origin + v};
    m.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
}
void append(TriangleMesh& to, TriangleMesh const& from) {
    auto const first = static_cast<int>(to.p.size());
    to.p.insert(to.p.end(), from.p.begin(), from.p.end());
    to.uv.insert(to.uv.end(), from.uv.begin(), from.uv.end());
    for (Vec3i const t : from.triangles) to.triangles.push_back(t + Vec3i(first));
}
TriangleMesh mesh_of(Quad const& s, int) { return parallelogram(s.origin, s.edge_u, s.edge_v); }
TriangleMesh mesh_of(Box const& s, int) {
    Vec3 const e = s.hi - s.lo;
    Vec3 const x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
    TriangleMesh m;
    append(m, parallelogram(s.lo, z, y));
    append(m, parallelogram(s.lo, x, z));
    append(m, parallelogram(s.lo, y, x));
    append(m, parallelogram(s.hi, -y, -z));
    append(m, parallelogram(s.hi, -z, -x));
    append(m, parallelogram(s.hi, -x, -y));
    return m;
}
/// Flat patches are two triangles, others a grid.
TriangleMesh mesh_of(BilinearMesh const& s, int) {
    TriangleMesh m;
    for (auto const& patch : s.patches) {
        std::array<Vec3, 4> c;
        for (std::size_t i = 0; i < 4; ++i) c[i] = s.p[static_cast<std::size_t>(patch[i])];
        Vec3 const flat = cross(c[1] - c[0], c[2] - c[0]);
        bool const planar = std::abs(dot(flat, c[3] - c[0])) <= 1e-5f * length(flat) * length(c[3] - c[0]);
        int const n = planar ? 1 : 16;
        auto const first = static_cast<int>(m.p.size());
        auto const blend = [&](auto const& values, Vec2 uv) {
            auto const at = [&](std::size_t i) { return values[static_cast<std::size_t>(patch[i])]; };
            return (1 - uv.y) * ((1 - uv.x) * at(0) + uv.x * at(1)) +
                   uv.y * ((1 - uv.x) * at(2) + uv.x * at(3));
        };
        TriangleMesh const cells = grid(n, n, false, false, [&](Vec2 uv) {
            return PointNormal{blend(s.p, uv), s.n.empty() ? Vec3{0} : blend(s.n, uv)};
        });
        m.p.insert(m.p.end(), cells.p.begin(), cells.p.end());
        if (!s.n.empty()) m.n.insert(m.n.end(), cells.n.begin(), cells.n.end());
        for (Vec2 const uv : cells.uv) m.uv.push_back(s.uv.empty() ? uv : blend(s.uv, uv));
        for (Vec3i const t : cells.triangles) m.triangles.push_back(t + Vec3i(first));
    }
    return m;
}
TriangleMesh mesh_of(LoopSubdivision const& s, int) { return subdivide(s); }
TriangleMesh mesh_of(TriangleMesh const& m, int) { return m; }

}  // namespace

TriangleMesh tessellate(Shape const& shape, int segments) {
    return match(shape, [&](auto const& s) { return mesh_of(s, segments); });
}

}  // namespace nephroid::peers
