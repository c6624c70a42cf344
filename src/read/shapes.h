// Shapes out of parameters.
#pragma once

#include "params.h"

namespace nephroid {

/// Nothing, after a note, for shapes that are not rendered yet.
std::optional<Shape> make_shape(std::string const& type, Params& params);

// The meshes (meshes.cpp).
TriangleMesh triangle_mesh(Params& params);
BilinearMesh bilinear_mesh(Params& params);
LoopSubdivision loop_subdivision(Params& params);
/// From a PLY or OBJ file.
TriangleMesh mesh_from_file(Params& params);

}  // namespace nephroid
