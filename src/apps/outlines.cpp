#include "outlines.h"

#include "model/shape.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace nephroid::cli {

namespace {

constexpr std::size_t kMostTriangles = 50000;  // of a mesh whose edges are looked at
constexpr std::size_t kMostLines = 20000;      // … in all; boxes beyond
constexpr std::size_t kMostObjects = 2000;     // … and nothing beyond that
constexpr float kSharp = 0.9f;                 // cosine between the normals at an edge: 26 degrees
constexpr int kSteps = 72;                     // of a circle

using Line = std::vector<Vec3>;

Vec3 mapped(Mat4 const& m, Vec3 p, double w) {
    auto const row = [&](std::size_t i) {
        return static_cast<float>(m.m[i][0] * static_cast<double>(p.x) +
                                  m.m[i][1] * static_cast<double>(p.y) +
                                  m.m[i][2] * static_cast<double>(p.z) + m.m[i][3] * w);
    };
    return {row(0), row(1), row(2)};
}

/// A curve over [from, to] in straight pieces.
template <class P>
void curve(std::vector<Line>& out, float from, float to, P&& point) {
    int const n = std::max(1, static_cast<int>(std::ceil(kSteps * (to - from) / kTwoPi)));
    Line line;
    for (int i = 0; i <= n; ++i)
        line.push_back(point(from + (to - from) * static_cast<float>(i) / static_cast<float>(n)));
    out.push_back(std::move(line));
}
void arc(std::vector<Line>& out, float radius, float z, float phi_max) {
    if (radius > 0)
        curve(out, 0, phi_max, [&](float a) { return Vec3{radius * std::cos(a), radius * std::sin(a), z}; });
}
void box(std::vector<Line>& out, Bounds3 const& b) {
    if (b.empty()) return;
    for (int i = 0; i < 8; ++i)
        for (int axis = 1; axis < 8; axis *= 2)
            if ((i & axis) == 0) out.push_back({b.corner(i), b.corner(i | axis)});
}

// Outlines in the shape's own space, seen along `view` (of any length).
void draw(std::vector<Line>& out, Sphere const& s, Vec3 view) {
    bool const whole = s.z_min <= -s.radius && s.z_max >= s.radius && s.phi_max >= kTwoPi;
    Frame const f = frame_from_z(normalize(view));
    auto const rim = [&](float a) { return (f.x * std::cos(a) + f.y * std::sin(a)) * s.radius; };
    if (whole) return curve(out, 0, kTwoPi, rim);
    auto const there = [&](Vec3 p) {
        float const phi = std::atan2(p.y, p.x);
        return p.z >= s.z_min && p.z <= s.z_max && (phi < 0 ? phi + kTwoPi : phi) <= s.phi_max;
    };
    for (int i = 0; i < kSteps; ++i) {
        auto const angle = [](int k) { return kTwoPi * static_cast<float>(k) / kSteps; };
        Vec3 const a = rim(angle(i)), b = rim(angle(i + 1));
        if (there(a) && there(b)) out.push_back({a, b});
    }
    auto const radius_at = [&](float z) { return std::sqrt(std::max(0.0f, s.radius * s.radius - z * z)); };
    for (float const z : {s.z_min, s.z_max}) arc(out, radius_at(z), z, s.phi_max);
    if (s.phi_max < kTwoPi)
        for (float const phi : {0.0f, s.phi_max})
            curve(out, std::asin(clamp(s.z_min / s.radius, -1.0f, 1.0f)),
                  std::asin(clamp(s.z_max / s.radius, -1.0f, 1.0f)), [&](float a) {
                      float const r = s.radius * std::cos(a);
                      return Vec3{r * std::cos(phi), r * std::sin(phi), s.radius * std::sin(a)};
                  });
}
void draw(std::vector<Line>& out, Cylinder const& c, Vec3 view) {
    for (float const z : {c.z_min, c.z_max}) arc(out, c.radius, z, c.phi_max);
    auto const upright = [&](float phi) {
        Vec3 const p{c.radius * std::cos(phi), c.radius * std::sin(phi), 0};
        out.push_back({p + Vec3{0, 0, c.z_min}, p + Vec3{0, 0, c.z_max}});
    };
    // Where the normal (cos, sin, 0) is across the view.
    float const side = std::atan2(-view.x, view.y);
    for (float phi : {side, side + kPi}) {
        if (phi < 0) phi += kTwoPi;
        if (phi <= c.phi_max) upright(phi);
    }
    if (c.phi_max < kTwoPi) upright(0), upright(c.phi_max);
}
void draw(std::vector<Line>& out, Disk const& d, Vec3) {
    arc(out, d.radius, d.height, d.phi_max);
    arc(out, d.inner_radius, d.height, d.phi_max);
    if (d.phi_max < kTwoPi)
        for (float const phi : {0.0f, d.phi_max}) {
            Vec3 const w{std::cos(phi), std::sin(phi), 0}, up{0, 0, d.height};
            out.push_back({w * d.inner_radius + up, w * d.radius + up});
        }
}
void draw(std::vector<Line>& out, Box const& b, Vec3) { box(out, {b.lo, b.hi}); }
void draw(std::vector<Line>& out, Quad const& q, Vec3) {
    Vec3 const a = q.origin, b = a + q.edge_u, d = a + q.edge_v;
    out.push_back({a, b, b + q.edge_v, d, a});
}
void draw(std::vector<Line>& out, BilinearMesh const& m, Vec3) {
    if (m.patches.size() > kMostTriangles / 10) return box(out, bounds(m));
    auto const p = [&](int i) { return m.p[static_cast<std::size_t>(i)]; };
    for (auto const& q : m.patches) out.push_back({p(q[0]), p(q[1]), p(q[3]), p(q[2]), p(q[0])});
}
void draw(std::vector<Line>&, LoopSubdivision const&, Vec3) {}  // became triangles

/// Borders, sharp edges, and those between a triangle that is seen from the front and one that is seen from behind.
void draw(std::vector<Line>& out, TriangleMesh const& m, Vec3 view) {
    if (m.triangles.size() > kMostTriangles) return box(out, bounds(m));
    // By place: along seams points are there twice.
    std::map<std::array<float, 3>, int> places;
    struct Edge {
        Vec3 a, b, n;
        int faces = 0;
        bool drawn = false;
    };
    std::map<std::pair<int, int>, Edge> edges;
    for (Vec3i const& t : m.triangles) {
        std::array<Vec3, 3> p;
        std::array<int, 3> id{};
        for (int i = 0; i < 3; ++i) {
            auto const k = static_cast<std::size_t>(i);
            p[k] = m.p[static_cast<std::size_t>(t[i])];
            id[k] =
                places.try_emplace({p[k].x, p[k].y, p[k].z}, static_cast<int>(places.size())).first->second;
        }
        Vec3 const across = cross(p[1] - p[0], p[2] - p[0]);
        if (!(length(across) > 0)) continue;
        Vec3 const n = normalize(across);
        for (std::size_t i = 0; i < 3; ++i) {
            std::size_t const k = (i + 1) % 3;
            Edge& e = edges[std::minmax(id[i], id[k])];
            if (e.faces++ == 0) {
                e.a = p[i], e.b = p[k], e.n = n;
            } else if (std::abs(dot(e.n, n)) < kSharp || (dot(e.n, n) < 0 && e.faces == 2) ||
                       (dot(e.n, view) < 0) != (dot(n, view) < 0)) {
                // Neighbours in one plane, of a seam that is turned round, are no edge: see below.
                e.drawn = std::abs(dot(e.n, n)) < 1 - 1e-5f;
            }
        }
    }
    for (auto const& [ids, e] : edges)
        if (e.drawn || e.faces == 1) out.push_back({e.a, e.b});
}

class Draughtsman {
  public:
    Draughtsman(World const& world, Vec3 view) : scene_(world.scene()), view_(view) {}

    void group(Group const& g, Mat4 const& to_world, std::vector<Outline>& out) {
        for (Object const& o : g.objects) object(o, to_world, out);
        for (Instance const& i : g.instances) {
            if (out.size() >= kMostObjects) return;
            Mat4 m;
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 4; ++c) m.m[r][c] = static_cast<double>(i.to_parent[r][c]);
            group(scene_[i.group], to_world * m, out);
        }
    }

  private:
    void object(Object const& o, Mat4 const& group_to_world, std::vector<Outline>& out) {
        if (out.size() >= kMostObjects) return;
        // Meshes of a compiled scene are in their group's space.
        bool const mesh =
            std::holds_alternative<TriangleMesh>(o.shape) || std::holds_alternative<BilinearMesh>(o.shape);
        Mat4 const m = mesh ? group_to_world : group_to_world * o.to_group;
        auto const back = inverse(m);
        if (!back) return;
        std::vector<Line> lines;
        match(o.shape, [&](auto const& shape) {
            if constexpr (requires { bounds(shape); })
                if (lines_ > kMostLines) return box(lines, bounds(shape));
            draw(lines, shape, mapped(*back, view_, 0));
        });
        lines_ += lines.size();
        Outline outline;
        outline.shines = o.light.has_value();
        for (Line& line : lines) {
            for (Vec3& p : line) {
                p = mapped(m, p, 1);
                outline.bounds.add(p);
            }
            outline.lines.push_back(std::move(line));
        }
        out.push_back(std::move(outline));
    }

    Scene const& scene_;
    Vec3 view_;
    std::size_t lines_ = 0;
};

}  // namespace

std::vector<Outline> outlines(World const& world, Vec3 view) {
    std::vector<Outline> out;
    Draughtsman(world, view).group(world.scene().world(), {}, out);
    return out;
}

}  // namespace nephroid::cli
