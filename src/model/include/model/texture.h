// Evaluating textures at a point of a surface.
#pragma once

#include "model/assets.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

namespace nephroid {

/// Where a texture is asked for. The footprint is what a pixel covers there: the derivatives of (u, v) and of p along the
/// pixel's two axes, both on the surface; 0 = a point, looked up without any filtering.
struct TexturePoint {
    Vec3 p{0, 0, 0};  // world
    Vec2 uv{0, 0};
    Vec2 duv_dx{0, 0}, duv_dy{0, 0};
    Vec3 dpdx{0}, dpdy{0};  // world
    Vec3 n{
        0, 0,
        1};  // world, unit; for directionmix, which pbrt-v4 gives the geometric normal; its sign is not used
};

float evaluate_float(Assets const& assets, TextureId id, TexturePoint const& at);
Spectrum evaluate_spectrum(Assets const& assets, TextureId id, TexturePoint const& at,
                           Wavelengths const& lambda);

/// A linear sRGB triple in its role, as lanes.
Spectrum rgb_to_spectrum(Vec3 rgb, SpectrumRole role, Wavelengths const& lambda);

}  // namespace nephroid
