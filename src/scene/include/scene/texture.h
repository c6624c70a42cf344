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
    float max_anisotropy =
        8;  // of Ewa: a footprint longer than this times its width is blurred across; at least 1
    float scale = 1;
    bool invert = false;
    bool is_spectrum = true;
    SpectrumRole role = SpectrumRole::Albedo;
};
/// tex1 where the sum of the integer parts of the coordinates is even, tex2 elsewhere, averaged over the footprint.
/// dimension 2: mapping; 3: texture space.
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
/// |n·dir| tex1 + (1 - |n·dir|) tex2 at a surface with normal n; dir is a direction in the world, of any length.
struct DirectionMixTexture {
    TextureId tex1, tex2;
    Vec3 dir{0, 1, 0};
};
/// Bilinear between the corners of the unit square of the mapping, going on beyond it: v01 is at (0, 1).
struct BilerpTexture {
    TextureMapping mapping;
    TextureId v00, v01, v10, v11;
};
/// At most one dot in each unit square of the mapping, of radius 0.35.
struct DotsTexture {
    TextureMapping mapping;
    TextureId inside, outside;
};

inline constexpr int kMaxOctaves =
    64;  // the frequency doubles with each: beyond a float's digits long before

/// Fractional Brownian motion: `octaves` of Perlin's noise, each at twice the frequency and `roughness` times the height of
/// the one before. A float.
struct FbmTexture {
    Mat4 world_to_texture;
    int octaves = 8;
    float roughness = 0.5f;
};
/// The same of the noise's absolute values. A float.
struct WrinkledTexture {
    Mat4 world_to_texture;
    int octaves = 8;
    float roughness = 0.5f;
};
/// Waves under a wind that varies over long distances. A float.
struct WindyTexture {
    Mat4 world_to_texture;
};
/// Layers along y, `scale` to the unit, bent by `variation` times fractional Brownian motion. A spectrum.
struct MarbleTexture {
    Mat4 world_to_texture;
    int octaves = 8;
    float roughness = 0.5f;
    float scale = 1;
    float variation = 0.2f;
};

using TextureKind =
    std::variant<ConstantFloatTexture, ConstantSpectrumTexture, ImageTexture, CheckerboardTexture,
                 ScaleTexture, MixTexture, DirectionMixTexture, BilerpTexture, DotsTexture, FbmTexture,
                 WrinkledTexture, WindyTexture, MarbleTexture>;

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
