// Evaluating textures at a point of a surface.
#pragma once

#include "model/assets.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelengths.h"

namespace nephroid {

/// Where a texture is asked for. Footprints are the derivatives of (u, v) along the pixel's two axes; 0 = a point.
struct TexturePoint {
    Vec3 p{0, 0, 0};  // world
    Vec2 uv{0, 0};
    Vec2 duv_dx{0, 0}, duv_dy{0, 0};
};

float evaluate_float(Assets const& assets, TextureId id, TexturePoint const& at);
Spectrum evaluate_spectrum(Assets const& assets, TextureId id, TexturePoint const& at,
                           Wavelengths const& lambda);

/// A linear sRGB triple in its role, as lanes.
Spectrum rgb_to_spectrum(Vec3 rgb, SpectrumRole role, Wavelengths const& lambda);

}  // namespace nephroid
