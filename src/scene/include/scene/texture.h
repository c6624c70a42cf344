// Textures: numbers or spectra that vary over surfaces. Parameters and defaults are pbrt-v4's.
#pragma once

#include "math/transform.h"
#include "scene/id.h"
#include "spectrum/spd.h"

#include <string>
#include <variant>

namespace nephroid {

/// (u, v) -> (su u + du, sv v + dv)
struct UvMapping {
    float su = 1, sv = 1, du = 0, dv = 0;
};
struct SphericalMapping {
    Mat4 world_to_texture;
};
struct CylindricalMapping {
    Mat4 world_to_texture;
};
/// (v1·p + du, v2·p + dv), p in texture space
struct PlanarMapping {
    Mat4 world_to_texture;
    Vec3 v1{1, 0, 0}, v2{0, 1, 0};
    float du = 0, dv = 0;
};
using TextureMapping = std::variant<UvMapping, SphericalMapping, CylindricalMapping, PlanarMapping>;

enum class WrapMode : std::uint8_t { Repeat, Black, Clamp, Octahedral };
enum class FilterMode : std::uint8_t { Point, Bilinear, Trilinear, Ewa };

struct ConstantFloatTexture {
    float value = 1;
};
struct ConstantSpectrumTexture {
    Spd value = ConstantSpd{1};
    SpectrumRole role = SpectrumRole::Albedo;
};
struct ImageTexture {
    ImageId image;
    TextureMapping mapping;
    WrapMode wrap = WrapMode::Repeat;
    FilterMode filter = FilterMode::Bilinear;
    float scale = 1;
    bool invert = false;
    bool is_spectrum = true;
    SpectrumRole role = SpectrumRole::Albedo;
};
/// tex1 where the sum of the integer parts of the coordinates is even, tex2 elsewhere. dimension 2: mapping; 3: texture space.
struct CheckerboardTexture {
    TextureMapping mapping;
    Mat4 world_to_texture;
    int dimension = 2;
    TextureId tex1, tex2;
};
struct ScaleTexture {
    TextureId tex, scale;  // scale is a float texture
};
/// lerp(amount, tex1, tex2); amount is a float texture
struct MixTexture {
    TextureId tex1, tex2, amount;
};

using TextureKind = std::variant<ConstantFloatTexture, ConstantSpectrumTexture, ImageTexture,
                                 CheckerboardTexture, ScaleTexture, MixTexture>;

struct Texture {
    TextureKind kind;
    SourceLocation where;
};

/// A picture on disk, read when the world is compiled. `encoding` is "", "linear", "sRGB" or "gamma <g>"; "" means the
/// file format's own (sRGB for 8-bit, linear for the rest).
struct ImageFile {
    std::string path;
    std::string encoding;
    SourceLocation where;
};

}  // namespace nephroid
