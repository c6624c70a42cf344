// Lights. An Spd gives a colour only: the emitted quantity is scale * spd / photometric(spd), so that scale counts in
// luminance (pbrt-v4). `power` (lm) or `illuminance` (lx), where >= 0, is what scale 1 then gives. Angles are radians.
#pragma once

#include "math/transform.h"
#include "scene/id.h"
#include "spectrum/spd.h"

#include <array>
#include <variant>
#include <vector>

namespace nephroid {

/// Isotropic intensity, W/sr.
struct PointLight {
    Spd intensity = RgbIlluminantSpd{{1, 1, 1}};
    float scale = 1, power = -1;
    Vec3 from{0, 0, 0};
};
/// Full intensity within cone_angle - cone_delta of the axis from->to, 0 beyond cone_angle, smoothstep in cosine between.
struct SpotLight {
    Spd intensity = RgbIlluminantSpd{{1, 1, 1}};
    float scale = 1, power = -1;
    Vec3 from{0, 0, 0}, to{0, 0, 1};
    float cone_angle = 0.52359878f, cone_delta = 0.08726646f;
};
/// Parallel light that travels along to - from; radiance * scale is the irradiance on a facing surface.
struct DistantLight {
    Spd radiance = RgbIlluminantSpd{{1, 1, 1}};
    float scale = 1, illuminance = -1;
    Vec3 from{0, 0, 0}, to{0, 0, 1};
};
enum class EnvironmentMapping : std::uint8_t {
    BySize,     // a square picture is equal-area, one twice as wide as high lat-long
    EqualArea,  // Clarberg's octahedral square (pbrt-v4)
    LatLong     // longitude by latitude, twice as wide as high
};
/// Light from everywhere around: constant, or an image (then `radiance` only names the illuminant).
struct InfiniteLight {
    Spd radiance = RgbIlluminantSpd{{1, 1, 1}};
    ImageId image;
    EnvironmentMapping mapping = EnvironmentMapping::BySize;
    float scale = 1, illuminance = -1;
};
/// Intensity by direction from a square equal-area picture (Clarberg's, its centre +y of light space: pbrt-v4 swaps y and
/// z), nearest texel; of colours their average.
struct GoniometricLight {
    Spd intensity = RgbIlluminantSpd{{1, 1, 1}};
    ImageId image;
    float scale = 1, power = -1;
};
/// A slide projector at the origin: the picture fills the window of `fov` (its shorter side) about +z, +y is up; nearest texel.
struct ProjectionLight {
    ImageId image;
    float fov = kPiOver2;
    float scale = 1, power = -1;
};
/// Luminous intensity (cd) by direction as lamps are measured, bilinear in the angles. Angle 0 of `vertical` is straight
/// down (-z of light space), beyond its ends it is dark; `horizontal` goes counterclockwise seen from above, from 0 (+x).
struct IntensityTable {
    std::vector<float> vertical;    // ascending, within [0, pi], at least two
    std::vector<float> horizontal;  // ascending, from 0 to 2 pi, which are the same plane
    std::vector<float> candela;     // vertical.size() of each horizontal angle
};
/// A measured lamp (IESNA LM-63): intensity only gives its colour.
struct MeasuredLight {
    Spd intensity = RgbIlluminantSpd{{1, 1, 1}};
    IntensityTable table;
    float scale = 1, power = -1;
};
using LightKind = std::variant<PointLight, SpotLight, DistantLight, InfiniteLight, GoniometricLight,
                               ProjectionLight, MeasuredLight>;

struct Light {
    LightKind kind;
    Mat4 to_world;
    SourceLocation where;
};

/// Emission of a shape's surface, to the side of its normal or to both.
struct AreaLight {
    Spd radiance = RgbIlluminantSpd{{1, 1, 1}};
    ImageId image;      // when valid: radiance over the shape's (u, v), times scale; or …
    TextureId texture;  // … a spectrum texture: `radiance` then only names the illuminant
    float scale = 1, power = -1;
    bool two_sided = false;
    SourceLocation where;
};

}  // namespace nephroid
