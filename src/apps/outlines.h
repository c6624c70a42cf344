// Lines by which a scene's shapes are recognised when they are seen from far away in one direction: silhouettes and sharp edges.
#pragma once

#include "math/bounds.h"
#include "world/world.h"

#include <vector>

namespace nephroid::cli {

struct Outline {
    std::vector<std::vector<Vec3>> lines;  // in the world
    Bounds3 bounds;                        // of the lines
    bool shines = false;
};

/// Of each object of the world and of its instances; `view` is a direction in which they are looked at. Meshes of very many triangles,
/// and all shapes once there are very many lines, are drawn as their boxes; after that nothing more is drawn.
std::vector<Outline> outlines(World const& world, Vec3 view);

}  // namespace nephroid::cli
