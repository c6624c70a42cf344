// Lights that are not surfaces: what they send to a point, with which density they are sampled, and their power.
// One file a light; pure functions of the scene's struct and of what was derived from it (LightData).
#pragma once

#include "math/bounds.h"
#include "math/frame.h"
#include "model/assets.h"
#include "model/texture.h"
#include "sampling/distribution.h"
#include "sampling/warp.h"
#include "scene/match.h"
#include "scene/scene.h"

#include <memory>
#include <optional>

namespace nephroid {

/// What a light is sampled for. The choice of a light, and of a point on it, may use the cosine at the receiver; where the
/// normal is 0 (a camera, a point in a volume) nothing is known about it.
struct Receiver {
    Vec3 p{0, 0, 0};
    Vec3 n{0, 0, 0};  // unit, shading; where `both_sides` is false, on the side that light is wanted from
    bool both_sides = true;  // light from behind counts too (transmission)
};

/// Light that arrives at a point from one direction.
struct LightSample {
    Spectrum radiance;  // for delta lights the irradiance on a facing surface: divide by pdf = 1
    Vec3 wi{0, 0, 1};   // unit, away from the receiver
    float pdf = 0;  // solid angle, times the probability of having chosen the light; 1 for delta directions
    bool delta = false;
    bool at_infinity = false;
    Vec3 p{0, 0, 0};        // where it comes from, unless at infinity …
    Vec3 p_error{0, 0, 0};  // … and its rounding bound and surface normal (0 for a point light)
    Vec3 n{0, 0, 0};
    Vec2 uv{0, 0};  // of the surface, where its emission is textured
};

/// Importance of an environment picture over its square: luminance (times the map's Jacobian), bilinear footprints included.
struct EnvironmentTable {
    Distribution2D distribution;
};

/// Derived from a Light when the world is compiled.
struct LightData {
    RuntimeSpectrum emission;  // scale applied: W/sr, W/m^2/sr …, per nm in spectral mode
    Transform to_world;
    Vec3 position{0, 0, 0};   // of point and spot, world
    Vec3 direction{0, 0, 1};  // spot: along the axis; distant: towards the light; world, unit
    float cos_outer = -1, cos_inner = -1;
    EnvironmentMapping mapping = EnvironmentMapping::EqualArea;  // of an infinite image, resolved
    float image_scale = 1;                                       // infinite image: radiance per stored value
    float volume_scale = 0;  // infinite image: |det to_world| where directions change their density, else 0
    std::shared_ptr<EnvironmentTable const> table;
};

/// Throws Error with the light's place for NaN emission or singular transforms. May read the light's picture from assets.
LightData prepare(Light const& light, Assets& assets);

/// Light arriving at p. `scene` bounds everything that can receive it.
std::optional<LightSample> sample_light(Light const& light, LightData const& data, Assets const& assets,
                                        Vec3 p, Vec2 u, Wavelengths const& lambda);
bool is_infinite(Light const& light);
bool is_delta(Light const& light);
/// Radiance of an infinite light at the receiver p along direction w (from there outwards); 0 for the others.
Spectrum environment_radiance(Light const& light, LightData const& data, Assets const& assets, Vec3 p, Vec3 w,
                              Wavelengths const& lambda);
/// Density by solid angle with which sample_light finds direction w at p; 0 for delta lights.
float environment_pdf(Light const& light, LightData const& data, Vec3 p, Vec3 w);

/// Total power, averaged over the visible spectrum (or rgb): good for choosing among lights. W.
float power(Light const& light, LightData const& data, Assets const& assets, BoundingSphere const& scene);

/// Emission with scale and, where given, power or illuminance taken into account: what spd * result emits.
/// `unit_output`: what a spd of luminance 1 would emit in all (lm or lx), for `target` >= 0.
RuntimeSpectrum emission_spectrum(Assets& assets, Spd const& spd, float scale, float target,
                                  double unit_output);

}  // namespace nephroid
