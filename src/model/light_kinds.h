// What each kind of light has to be able to do; light.cpp asks the kinds by these names. A new kind is a struct in
// scene/light.h, a line below, and a file with its functions; until they are all there, the build stops.
#pragma once

#include "model/light.h"

#include <algorithm>
#include <concepts>

namespace nephroid {

/// Every kind. `where` in messages is that of `light`, which holds the struct.
#define NEPHROID_LIGHT(K)                                                                                    \
    LightData prepare(K const& kind, Light const& light, Assets& assets);                                    \
    std::optional<LightSample> sample_light(K const& kind, LightData const& d, Assets const& assets, Vec3 p, \
                                            Vec2 u, Wavelengths const& lambda);                              \
    float power(K const& kind, LightData const& d, Assets const& assets, BoundingSphere const& scene);       \
    std::optional<EmissionSample> sample_emission(K const& kind, LightData const& d, Assets const& assets,   \
                                                  BoundingSphere const& scene, Vec2 u_position,              \
                                                  Vec2 u_direction, Wavelengths const& lambda);              \
    EmissionDensity emission_density(K const& kind, LightData const& d, BoundingSphere const& scene, Vec3 p, \
                                     Vec3 w);                                                                \
    std::optional<LightBounds> light_bounds(K const& kind, LightData const& d, Assets const& assets);

/// Those that are seen where a ray meets nothing (is_infinite).
#define NEPHROID_ENVIRONMENT(K)                                                                            \
    NEPHROID_LIGHT(K)                                                                                      \
    Spectrum environment_radiance(K const& kind, LightData const& d, Assets const& assets, Vec3 p, Vec3 w, \
                                  Wavelengths const& lambda);                                              \
    float environment_pdf(K const& kind, LightData const& d, Vec3 p, Vec3 w);

NEPHROID_LIGHT(PointLight)
NEPHROID_LIGHT(SpotLight)
NEPHROID_LIGHT(DistantLight)
NEPHROID_LIGHT(GoniometricLight)
NEPHROID_LIGHT(ProjectionLight)
NEPHROID_LIGHT(MeasuredLight)
NEPHROID_ENVIRONMENT(InfiniteLight)
NEPHROID_ENVIRONMENT(SunSkyLight)
#undef NEPHROID_LIGHT
#undef NEPHROID_ENVIRONMENT

template <class K>
concept LightModel = requires(K const& k, Light const& light, LightData const& d, Assets& assets, Vec3 p,
                              Vec2 u, Wavelengths const& lambda, BoundingSphere const& scene) {
    { prepare(k, light, assets) } -> std::same_as<LightData>;
    { sample_light(k, d, assets, p, u, lambda) } -> std::same_as<std::optional<LightSample>>;
    { power(k, d, assets, scene) } -> std::same_as<float>;
    { sample_emission(k, d, assets, scene, u, u, lambda) } -> std::same_as<std::optional<EmissionSample>>;
    { emission_density(k, d, scene, p, p) } -> std::same_as<EmissionDensity>;
    { light_bounds(k, d, assets) } -> std::same_as<std::optional<LightBounds>>;
};
template <class K>
concept EnvironmentModel = LightModel<K> && requires(K const& k, LightData const& d, Assets const& assets,
                                                     Vec3 p, Vec3 w, Wavelengths const& lambda) {
    { environment_radiance(k, d, assets, p, w, lambda) } -> std::same_as<Spectrum>;
    { environment_pdf(k, d, p, w) } -> std::same_as<float>;
};
static_assert(LightModel<PointLight>);
static_assert(LightModel<SpotLight>);
static_assert(LightModel<DistantLight>);
static_assert(LightModel<GoniometricLight>);
static_assert(LightModel<ProjectionLight>);
static_assert(LightModel<MeasuredLight>);
static_assert(EnvironmentModel<InfiniteLight>);
static_assert(EnvironmentModel<SunSkyLight>);

// --- what kinds share -------------------------------------------------------------------------------------------------
/// The light's transform; fails at the light where it has no inverse.
Transform placed(Light const& light, Assets const& assets);
/// Unit direction from -> to, in the world.
inline Vec3 axis(Transform const& to_world, Vec3 from, Vec3 to) {
    return normalize(to_world.vector(to - from));
}
/// What arrives at p from a point that sends `intensity` there.
std::optional<LightSample> sample_from_point(LightData const& d, Vec3 p, Spectrum intensity);

/// A ray from a point along w (world, unit), drawn with density `pdf`.
std::optional<EmissionSample> emission_from_point(LightData const& d, Vec3 w, Spectrum intensity, float pdf);
/// A ray through the scene's disk from a light at infinity in direction `to_light`, drawn with `pdf_direction`.
std::optional<EmissionSample> emission_from_infinity(BoundingSphere const& scene, Vec3 to_light,
                                                     Spectrum radiance, float pdf_direction, bool delta,
                                                     Vec2 u_position);
/// By area, of the ray through p along w; 0 where it passes the disk by.
float disk_density(BoundingSphere const& scene, Vec3 p, Vec3 w);

/// Bounds of a light at a point whose greatest intensity is `intensity`: all around, or within theta_o and then theta_e.
LightBounds bounds_at_point(LightData const& d, float intensity);
/// theta_e of light that ends sharply: above 0, or who asks whether an angle is below it would see nothing.
inline constexpr float kSharpEdge = 0.01f;
LightBounds bounds_at_point(LightData const& d, float intensity, Vec3 axis, float theta_o, float theta_e);

/// How a density over directions of light space changes on the way to the world (math/transform.h).
inline float direction_density(LightData const& d, Vec3 local) {
    return d.direction_scale == 0.0f ? 1.0f : direction_density(d.direction_scale, d.to_world.vector(local));
}
/// A direction of the world, in light space.
inline Vec3 local_direction(LightData const& d, Vec3 w) { return normalize(d.to_world.vector_inverse(w)); }

/// A function of the texels of a picture over the unit square, (0, 0) the upper left corner of the first: the same rounding
/// as in Distribution2D, so that a texel is lit where its density is above 0.
struct Texel {
    int x = 0, y = 0;
};
inline Texel nearest_texel(Image const& image, Vec2 st) {
    auto const cell = [](float t, int n) {
        return t > 0.0f ? static_cast<int>(std::min(t * static_cast<float>(n), static_cast<float>(n - 1)))
                        : 0;
    };
    return {cell(st.x, image.width()), cell(st.y, image.height())};
}

}  // namespace nephroid
