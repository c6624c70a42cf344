// Shapes as triangles, for renderers that know nothing else.
#pragma once

#include "scene/shape.h"

namespace nephroid::peers {

/// `shape` in its own space, with the (u, v) that it has as a shape. Curved shapes get their exact normals, which say what their side
/// is: facets show at outlines only, and `segments` go around. The others are wound counter-clockwise.
TriangleMesh tessellate(Shape const& shape, int segments = 512);

}  // namespace nephroid::peers
