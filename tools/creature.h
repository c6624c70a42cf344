// A toy creature as one closed surface, for scenes that need a figure with a head, legs and a tail.
#pragma once

#include "mesh.h"

namespace meshes {

/// Normals point outwards, and each edge belongs to two triangles. It looks along +x, stands on z = 0, and is about 2.7 long and
/// 1.5 high. Throws std::logic_error if the surface is not closed.
Mesh creature();

}  // namespace meshes
