// From a point of a surface to the two coordinates of a texture, with the footprint (PBRT 4th ed., 10.2).
#pragma once

#include "model/texture.h"

namespace nephroid {

/// (s, t), and what a pixel covers there: their derivatives along the pixel's two axes, 0 where they do not exist.
struct MappedPoint {
    Vec2 st{0, 0};
    Vec2 dst_dx{0, 0}, dst_dy{0, 0};
};

/// `to_texture` is the mapping's world_to_texture, compiled.
MappedPoint map_point(TextureMapping const& mapping, Transform const& to_texture, TexturePoint const& at);

}  // namespace nephroid
