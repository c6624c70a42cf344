// Patterns by formula: checkerboards, dots, and what is made of noise. Parameters and results are pbrt-v4's
// (PBRT 4th ed., 10.4; 3rd ed., 10.5 and 10.6).
#pragma once

#include "model/texture_mapping.h"

namespace nephroid {

/// The share in [0, 1] of the footprint, weighted by a triangle three times as wide as it, in which a checkerboard shows its
/// second texture.
float checkerboard_second(CheckerboardTexture const& t, Transform const& to_texture, TexturePoint const& at);

/// Is (s, t) in a dot?
bool inside_dot(Vec2 st);

float evaluate(FbmTexture const& t, Transform const& to_texture, TexturePoint const& at);
float evaluate(WrinkledTexture const& t, Transform const& to_texture, TexturePoint const& at);
float evaluate(WindyTexture const& t, Transform const& to_texture, TexturePoint const& at);
/// A linear sRGB reflectance.
Vec3 evaluate(MarbleTexture const& t, Transform const& to_texture, TexturePoint const& at);

}  // namespace nephroid
