// Lights that are not surfaces: what they send to a point, what rays they send out, with which densities these are sampled,
// and their power.
// One file a light; pure functions of the scene's struct and of what was derived from it (LightData).
#pragma once

#include "math/bounds.h"
#include "math/frame.h"
#include "math/ray.h"
#include "model/assets.h"
#include "model/light_bounds.h"
#include "model/texture.h"
#include "sampling/distribution.h"
#include "sampling/warp.h"
#include "scene/match.h"
#include "scene/scene.h"

#include <memory>
#include <optional>
#include <vector>

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

/// A ray of light as it leaves its source, for tracing forward (PBRT 4th ed., 12.2): the estimate of the power that it
/// carries is radiance * |cos(n, ray.d)| (1 where n = 0) / (pdf_position * pdf_direction).
struct EmissionSample {
    Ray ray;                            // d is unit, away from the light
    Vec3 p_error{0, 0, 0}, n{0, 0, 0};  // of a surface; 0 where there is none
    Spectrum radiance;                  // W/(m^2 sr); W/sr of a delta position, W/m^2 of a delta direction
    float pdf_position = 1;             // by area (of the disk across the ray for lights at infinity) …
    float pdf_direction = 1;            // … and by solid angle; 1 where it is a delta
    bool delta_position = false, delta_direction = false;
};
/// The densities of an EmissionSample. Delta parts give 0.
struct EmissionDensity {
    float position = 0, direction = 0;
};

/// Importance of a picture (or table) over its square: luminance times the map's Jacobian, of an environment with its bilinear
/// footprints.
struct EnvironmentTable {
    Distribution2D distribution;
    std::vector<float> vertical, horizontal;  // measured lights: angles of the edges of rows and columns

    [[nodiscard]] std::size_t bytes() const {
        return distribution.bytes() + (vertical.size() + horizontal.size()) * sizeof(float);
    }
};

struct Portal;  // of an infinite light (portal.h)
struct SunSky;  // what a SunSkyLight is made ready as (light_sunsky.cpp)

/// Derived from a Light when the world is compiled.
struct LightData {
    RuntimeSpectrum emission;  // scale applied: W/sr, W/m^2/sr …, per nm in spectral mode
    Transform to_world;
    Vec3 position{0, 0, 0};   // of lights at a point, world
    Vec3 direction{0, 0, 1};  // spot: along the axis; distant: towards the light; world, unit
    float cos_outer = -1, cos_inner = -1;
    EnvironmentMapping mapping = EnvironmentMapping::EqualArea;  // of an infinite image, resolved
    float image_scale = 1;                                       // infinite image: radiance per stored value
    float direction_scale = 0;  // by picture or table: of to_world (math/transform.h)
    Vec2 window{1, 1};          // projection: half of its picture's sides at distance 1
    float flux =
        0;  // by picture or table, at a point: integral of the relative intensity over directions, sr …
    float peak = 0;  // … and its greatest value
    std::shared_ptr<EnvironmentTable const> table;
    std::shared_ptr<Portal const> portal;
    std::shared_ptr<SunSky const> sun_sky;
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

/// A ray that the light sends out; `scene` bounds everything that can receive it. Lights at infinity send theirs through the
/// disk across the direction, as wide as the scene. Nothing where no light goes.
std::optional<EmissionSample> sample_emission(Light const& light, LightData const& data, Assets const& assets,
                                              BoundingSphere const& scene, Vec2 u_position, Vec2 u_direction,
                                              Wavelengths const& lambda);
/// The densities with which sample_emission finds the ray through p (any of its points) that travels along w.
EmissionDensity emission_density(Light const& light, LightData const& data, BoundingSphere const& scene,
                                 Vec3 p, Vec3 w);
/// Nothing for lights at infinity. Its intensity is of the spectrum's largest value, as in power().
std::optional<LightBounds> light_bounds(Light const& light, LightData const& data, Assets const& assets);

/// Emission with scale and, where given, power or illuminance taken into account: what spd * result emits.
/// `unit_output`: what a spd of luminance 1 would emit in all (lm or lx), for `target` >= 0.
RuntimeSpectrum emission_spectrum(Assets& assets, Spd const& spd, float scale, float target,
                                  double unit_output);

}  // namespace nephroid
