// Shapes: small meshes in the text, large ones in PLY files.
#include "writer.h"

#include "scene/match.h"
#include "scene/shape_name.h"

#include <bit>
#include <cstring>

namespace nephroid {

namespace {

constexpr std::size_t kMostInline = 200;  // points or triangles

void append(std::string& out, void const* data, std::size_t size) {
    out.append(static_cast<char const*>(data), size);
}
static_assert(std::endian::native == std::endian::little, "PLY files are written as memory holds them");

}  // namespace

std::string Writer::ply_file(TriangleMesh const& m) {
    std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(m.p.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!m.n.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!m.uv.empty()) out += "property float u\nproperty float v\n";
    out += "element face " + std::to_string(m.triangles.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
    out.reserve(out.size() + m.p.size() * 32 + m.triangles.size() * 13);
    for (std::size_t i = 0; i < m.p.size(); ++i) {
        append(out, &m.p[i].x, 12);
        if (!m.n.empty()) append(out, &m.n[i].x, 12);
        if (!m.uv.empty()) append(out, &m.uv[i].x, 8);
    }
    for (Vec3i const& t : m.triangles) {
        out += '\3';
        append(out, &t.x, 12);
    }
    return part("mesh", ".ply", std::move(out));
}

bool Writer::has_face(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const& m) { return !m.triangles.empty(); },
        [](BilinearMesh const& m) { return !m.patches.empty(); },
        [](LoopSubdivision const& m) { return !m.triangles.empty(); }, [](auto const&) { return true; });
}

/// Of a shape that has_face().
std::string Writer::shape(Shape const& shape, std::string const& more, SourceLocation where) {
    ParamText p;
    auto const points = [&](auto const& m) {
        p.points("point3", "P", m.p);
        if constexpr (requires { m.n; }) {
            p.points("normal", "N", m.n);
            p.points("point2", "uv", m.uv);
        }
    };
    auto const phi = [&](float phi_max) {
        if (phi_max < kTwoPi) p.angle("phimax", phi_max, !portable_);
    };
    char const* type = name_of(shape);
    match(
        shape,
        [&](TriangleMesh const& m) {
            if (m.p.size() > kMostInline || m.triangles.size() > kMostInline) {
                p.string("filename", ply_file(m));
                type = "plymesh";
                return;
            }
            p.integers("indices", &m.triangles[0].x, 3 * m.triangles.size());
            points(m);
        },
        [&](BilinearMesh const& m) {
            p.integers("indices", m.patches[0].data(), 4 * m.patches.size());
            points(m);
        },
        [&](LoopSubdivision const& m) {
            if (m.levels > 10) refuse(where, "a subdivision above 10 levels");
            p.integer("levels", m.levels, 3);
            p.integers("indices", &m.triangles[0].x, 3 * m.triangles.size());
            points(m);
        },
        [&](Sphere const& s) {
            p.number("radius", s.radius);
            p.number("zmin", s.z_min, -s.radius);
            p.number("zmax", s.z_max, s.radius);
            phi(s.phi_max);
        },
        [&](Cylinder const& s) {
            p.number("radius", s.radius);
            p.number("zmin", s.z_min, -1);
            p.number("zmax", s.z_max, 1);
            phi(s.phi_max);
        },
        [&](Disk const& s) {
            p.number("height", s.height, 0);
            p.number("radius", s.radius);
            p.number("innerradius", s.inner_radius, 0);
            phi(s.phi_max);
        },
        [&](Box const& s) {
            p.point("lo", s.lo);
            p.point("hi", s.hi);
        },
        [&](Quad const& s) {
            p.point("origin", s.origin);
            p.vector("u", s.edge_u);
            p.vector("v", s.edge_v);
        });
    return "  Shape \"" + std::string(type) + '"' + more + p.text() + '\n';
}

}  // namespace nephroid
