// The valley of scenes/gallery/valley.pbrt: ground, spruces, where they stand, and how high the snow lies. Lengths: 10 m; z is up;
// the lake's level is z = 0.
#pragma once

#include "mesh.h"

#include <string>

namespace meshes {

/// A spruce, 1 high: whorls of drooping branches, each a strip folded like a roof. The trunk is the scene's own.
Mesh spruce();
/// Hills around a lake, mountains behind it. v is the height over the snow line, in [0, 1]; u is 0.5.
Mesh valley_ground();
/// v -> how much snow: TGA, 4 x 64 pixels, lowest row first.
std::string snow_line();
/// pbrt: objects "grove" and "spruce", of the object "one spruce", at the places where they grow on valley_ground().
std::string valley_woods();

}  // namespace meshes
