// From a point of a surface to the two coordinates of a texture, with the footprint (PBRT 4th ed., 10.2).
#pragma once

#include "model/texture.h"

namespace nephroid {

/// (s, t), and what a pixel covers there: their derivatives along the pixel's two axes, 0 where they do not exist.
struct MappedPoint {
    Vec2 st{0, 0};
    Vec2 dst_dx{0, 0}, dst_dy{0, 0};
};

/// Of the mappings that start from the point in space.
MappedPoint map_point_in_space(TextureMapping const& mapping, Transform const& to_texture,
                               TexturePoint const& at);

/// `to_texture` is the mapping's world_to_texture, compiled.
inline MappedPoint map_point(TextureMapping const& mapping, Transform const& to_texture,
                             TexturePoint const& at) {
    if (auto const* m = std::get_if<UvMapping>(&mapping))
        return {{m->su * at.uv.x + m->du, m->sv * at.uv.y + m->dv},
                {m->su * at.duv_dx.x, m->sv * at.duv_dx.y},
                {m->su * at.duv_dy.x, m->sv * at.duv_dy.y}};
    return map_point_in_space(mapping, to_texture, at);
}

}  // namespace nephroid
