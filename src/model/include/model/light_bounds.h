// What a light, or a crowd of them, can send where: Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with
// Adaptive Tree Splitting".
#pragma once

#include "math/bounds.h"

namespace nephroid {

struct LightBounds {
    Bounds3 box;
    Vec3 axis{0, 0, 1};
    float intensity = 0;     // greatest radiant intensity, W/sr: good for choosing
    float cos_normals = -1;  // theta_o: normals lie within this angle of the axis
    float cos_emission = 0;  // theta_e: light leaves within this angle of a normal
    bool two_sided = false;
};

}  // namespace nephroid
