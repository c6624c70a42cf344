// Shapes in their own space. Parameters, parametrisation and defaults are pbrt-v4's; box and quad are ours.
#pragma once

#include "math/transform.h"
#include "math/vec.h"

#include <array>
#include <variant>
#include <vector>

namespace nephroid {

struct TriangleMesh {
    std::vector<Vec3> p;
    std::vector<Vec3> n;   // empty or one per point
    std::vector<Vec2> uv;  // empty or one per point
    std::vector<Vec3i> triangles;
};
/// Patches over four points p00, p10, p01, p11: p(u,v) bilinear.
struct BilinearMesh {
    std::vector<Vec3> p;
    std::vector<Vec3> n;
    std::vector<Vec2> uv;
    std::vector<std::array<int, 4>> patches;
};
/// Loop's subdivision surface of a control mesh, evaluated as its limit after `levels` refinements.
struct LoopSubdivision {
    std::vector<Vec3> p;
    std::vector<Vec3i> triangles;
    int levels = 3;
};
/// Around the origin, poles on z; cut to z in [z_min, z_max] and phi in [0, phi_max] (radians).
struct Sphere {
    float radius = 1, z_min = -1, z_max = 1, phi_max = kTwoPi;
};
/// Around the z axis.
struct Cylinder {
    float radius = 1, z_min = -1, z_max = 1, phi_max = kTwoPi;
};
/// In the plane z = height, normal +z.
struct Disk {
    float height = 0, radius = 1, inner_radius = 0, phi_max = kTwoPi;
};
/// Axis-aligned in its own space, normals outwards.
struct Box {
    Vec3 lo{-1, -1, -1}, hi{1, 1, 1};
};
/// The parallelogram origin + s*edge_u + t*edge_v, s, t in [0,1]; normal along edge_u × edge_v; uv = (s, t).
struct Quad {
    Vec3 origin{-1, -1, 0}, edge_u{2, 0, 0}, edge_v{0, 2, 0};
};

using Shape = std::variant<TriangleMesh, BilinearMesh, LoopSubdivision, Sphere, Cylinder, Disk, Box, Quad>;

}  // namespace nephroid
