// Shapes: sizes that are not zero, ranges that are not empty, indices within their lists.
#include "check.h"
#include "scene/match.h"

namespace nephroid {

namespace {

/// A full turn, with room for the rounding of 360 degrees.
constexpr float kFullTurn = kTwoPi * 1.000001f;
constexpr int kMaxLevels = 12;  // one triangle becomes 16 million

void check_phi(Check const& c, float phi_max) {
    c.require(phi_max > 0 && phi_max <= kFullTurn, "phimax must be above 0 and at most 360 degrees");
}

/// Points, the lists that go with them, and polygons of indices into them.
template <class Polygon, std::size_t N>
void check_polygons(Check const& c, std::size_t points, std::vector<Polygon> const& polygons) {
    using Index = std::conditional_t<GlmType<Polygon>, int, std::size_t>;
    for (std::size_t i = 0; i < polygons.size(); ++i)
        for (std::size_t k = 0; k < N; ++k) {
            auto const vertex = polygons[i][static_cast<Index>(k)];
            if (vertex >= 0 && static_cast<std::size_t>(vertex) < points) continue;
            c.scene.fail(c.where, "the mesh's face " + std::to_string(i) + " names vertex " +
                                      std::to_string(vertex) + ", but there are " + std::to_string(points) +
                                      ": correct the indices");
        }
}
template <class Polygon>
void check_counts(Check const& c, std::size_t points, std::vector<Polygon> const& polygons) {
    constexpr std::size_t kMost = std::size_t{1} << 31;
    if (points >= kMost || polygons.size() >= kMost)
        c.limit("the mesh has 2^31 vertices or faces or more: split it");
}
void check_per_point(Check const& c, std::size_t points, std::size_t normals, std::size_t uvs) {
    c.require(normals == 0 || normals == points, "the mesh needs as many normals as vertices, or none");
    c.require(uvs == 0 || uvs == points, "the mesh needs as many texture coordinates as vertices, or none");
}

}  // namespace

void check_shape(Check const& c, Shape const& shape) {
    check_finite(c, shape, "the shape");
    match(
        shape,
        [&](TriangleMesh const& m) {
            check_counts(c, m.p.size(), m.triangles);
            check_per_point(c, m.p.size(), m.n.size(), m.uv.size());
            check_polygons<Vec3i, 3>(c, m.p.size(), m.triangles);
        },
        [&](BilinearMesh const& m) {
            check_counts(c, m.p.size(), m.patches);
            check_per_point(c, m.p.size(), m.n.size(), m.uv.size());
            check_polygons<std::array<int, 4>, 4>(c, m.p.size(), m.patches);
        },
        [&](LoopSubdivision const& m) {
            check_counts(c, m.p.size(), m.triangles);
            check_polygons<Vec3i, 3>(c, m.p.size(), m.triangles);
            c.require(m.levels >= 0, "the number of subdivision levels must not be negative");
            if (m.levels > kMaxLevels)
                c.limit("at most " + std::to_string(kMaxLevels) + " levels of subdivision: use fewer");
        },
        [&](Sphere const& s) {
            c.require(s.radius > 0, "the sphere's radius must be above 0");
            c.require(s.z_min < s.z_max && s.z_min < s.radius && s.z_max > -s.radius,
                      "zmin and zmax leave nothing of the sphere: make zmin < zmax, within the radius");
            check_phi(c, s.phi_max);
        },
        [&](Cylinder const& s) {
            c.require(s.radius > 0, "the cylinder's radius must be above 0");
            c.require(s.z_min < s.z_max, "the cylinder's zmin must be below its zmax");
            check_phi(c, s.phi_max);
        },
        [&](Disk const& s) {
            c.require(s.radius > 0, "the disk's radius must be above 0");
            c.require(s.inner_radius >= 0 && s.inner_radius < s.radius,
                      "the disk's inner radius must be at least 0 and below its radius");
            check_phi(c, s.phi_max);
        },
        [&](Box const& s) {
            c.require(s.lo.x <= s.hi.x && s.lo.y <= s.hi.y && s.lo.z <= s.hi.z,
                      "the box's lower corner lies above its upper one: swap them");
        },
        [&](Quad const& s) {
            c.require(cross_accurate(s.edge_u, s.edge_v) != Vec3(0),
                      "the quad has no area: its edges must not be 0 or parallel");
        });
}

}  // namespace nephroid
