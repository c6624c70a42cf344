// What shapes do, each in its own space: bounds, intersection (analytic shapes only: Embree has its own triangles), the
// surface at a hit, and points drawn uniformly by area. One file a shape; pure functions on the scene's structs.
//
// Analytic intersection is done in double. A ray leaves a surface by a float error bound (math/ray.h), which is millions of
// double roundings, so that the sign of "outside or inside" is decided exactly and convex shapes never hit themselves.
#pragma once

#include "math/bounds.h"
#include "model/surface.h"
#include "scene/shape.h"

#include <optional>

namespace nephroid {

struct Ray3d {
    std::array<double, 3> o, d;
};

/// Where a ray met an analytic shape. `u, v` mean what the shape wants; `part` is its face or patch.
struct ShapeHit {
    double t = 0;
    float u = 0, v = 0;
    std::uint32_t part = 0;
};

// Each analytic shape has:
//   bounds(shape)                              a box around it
//   intersect(shape, ray, t_min, t_max)        nearest hit with t in (t_min, t_max)
//   surface(shape, hit, p)                     geometry at a hit; p = ray(t), off by rounding, is put back on the surface
//   part_count(shape), part_area(shape, part)
//   sample(shape, part, u)                     uniform by area over one part
//   invert_area(shape, part, p, uv)            the u that sample() makes the point p of; `uv` is its ShapeHit's u and v, which
//                                              quads and patches go by. Nothing beyond the part
#define NEPHROID_ANALYTIC_SHAPE(S)                                                                        \
    Bounds3 bounds(S const& shape);                                                                       \
    std::optional<ShapeHit> intersect(S const& shape, std::uint32_t prim, Ray3d const& ray, double t_min, \
                                      double t_max);                                                      \
    SurfacePoint surface(S const& shape, ShapeHit const& hit, Vec3 p);                                    \
    std::uint32_t part_count(S const& shape);                                                             \
    float part_area(S const& shape, std::uint32_t part);                                                  \
    ShapeSample sample(S const& shape, std::uint32_t part, Vec2 u);                                       \
    std::optional<Vec2> invert_area(S const& shape, std::uint32_t part, Vec3 p, Vec2 uv);

NEPHROID_ANALYTIC_SHAPE(Sphere)
NEPHROID_ANALYTIC_SHAPE(Cylinder)
NEPHROID_ANALYTIC_SHAPE(Disk)
NEPHROID_ANALYTIC_SHAPE(Box)
NEPHROID_ANALYTIC_SHAPE(Quad)
NEPHROID_ANALYTIC_SHAPE(BilinearMesh)
#undef NEPHROID_ANALYTIC_SHAPE
/// surface() without its coordinates and tangents, for those who do not ask for them: they are its angles.
SurfacePoint bare_surface(Sphere const& shape, Vec3 p);

/// Primitives that the intersector sees: the patches of a bilinear mesh, else 1.
template <class S>
std::uint32_t primitive_count(S const&) {
    return 1;
}
inline std::uint32_t primitive_count(BilinearMesh const& m) {
    return static_cast<std::uint32_t>(m.patches.size());
}
template <class S>
Bounds3 primitive_bounds(S const& shape, std::uint32_t) {
    return bounds(shape);
}
Bounds3 primitive_bounds(BilinearMesh const& m, std::uint32_t patch);

/// The density by area of the bilinear patch's sampler at (u, v): uniform in (u, v), so not constant by area.
float sample_pdf(BilinearMesh const& mesh, std::uint32_t patch, Vec2 uv);
/// For all other shapes it is 1 / part_area.
template <class S>
float sample_pdf(S const& shape, std::uint32_t part, Vec2) {
    return 1.0f / part_area(shape, part);
}

// --- triangles: the intersector is Embree's ---------------------------------------------------------------------------
Bounds3 bounds(TriangleMesh const& mesh);
/// Geometry at barycentric coordinates (b1, b2) of the second and third vertex. `flip`: the normal's side is the other one
/// (ReverseOrientation or a mirroring transform, not both). Tangents only on request, else 0. Fills `r` in place.
void triangle_surface(TriangleMesh const& mesh, std::uint32_t triangle, Vec2 b, bool flip, bool tangents,
                      SurfacePoint& r);
float triangle_area(TriangleMesh const& mesh, std::uint32_t triangle);
ShapeSample sample_triangle(TriangleMesh const& mesh, std::uint32_t triangle, bool flip, Vec2 u);

/// Vertices and normals mapped in double; `reverse` turns the mesh's own normals round.
void transform_mesh(TriangleMesh& mesh, Mat4 const& to_world, bool reverse);
void transform_mesh(BilinearMesh& mesh, Mat4 const& to_world, bool reverse);

/// Loop's scheme, refined `levels` times, vertices moved to the limit surface, with its normals.
/// Throws Error(Input) for a mesh that is not a manifold.
TriangleMesh subdivide(LoopSubdivision const& control);

}  // namespace nephroid
