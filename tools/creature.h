// A toy creature as one closed surface, for scenes that need a figure with a head, legs and a tail.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

/// Points, their outward unit normals, and triangles that run counter-clockwise as seen from outside; each edge belongs to two
/// of them. It looks along +x, stands on z = 0, and is about 2.7 long and 1.5 high.
struct CreatureMesh {
    std::vector<glm::dvec3> p, n;
    std::vector<std::array<std::int32_t, 3>> triangles;
};
/// Throws std::logic_error if the surface is not closed.
CreatureMesh creature();
