// What each kind of light has to be able to do; light.cpp asks the kinds by these names. A new kind is a struct in
// scene/light.h, a line below, and a file with its functions; until they are all there, the build stops.
#pragma once

#include "model/light.h"

#include <concepts>

namespace nephroid {

/// Every kind. `where` in messages is that of `light`, which holds the struct.
#define NEPHROID_LIGHT(K)                                                                                    \
    LightData prepare(K const& kind, Light const& light, Assets& assets);                                    \
    std::optional<LightSample> sample_light(K const& kind, LightData const& d, Assets const& assets, Vec3 p, \
                                            Vec2 u, Wavelengths const& lambda);                              \
    float power(K const& kind, LightData const& d, Assets const& assets, BoundingSphere const& scene);

/// Those that are seen where a ray meets nothing (is_infinite).
#define NEPHROID_ENVIRONMENT(K)                                                                            \
    NEPHROID_LIGHT(K)                                                                                      \
    Spectrum environment_radiance(K const& kind, LightData const& d, Assets const& assets, Vec3 p, Vec3 w, \
                                  Wavelengths const& lambda);                                              \
    float environment_pdf(K const& kind, LightData const& d, Vec3 p, Vec3 w);

NEPHROID_LIGHT(PointLight)
NEPHROID_LIGHT(SpotLight)
NEPHROID_LIGHT(DistantLight)
NEPHROID_ENVIRONMENT(InfiniteLight)
#undef NEPHROID_LIGHT
#undef NEPHROID_ENVIRONMENT

template <class K>
concept LightModel = requires(K const& k, Light const& light, LightData const& d, Assets& assets, Vec3 p,
                              Vec2 u, Wavelengths const& lambda, BoundingSphere const& scene) {
    { prepare(k, light, assets) } -> std::same_as<LightData>;
    { sample_light(k, d, assets, p, u, lambda) } -> std::same_as<std::optional<LightSample>>;
    { power(k, d, assets, scene) } -> std::same_as<float>;
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
static_assert(EnvironmentModel<InfiniteLight>);

// --- what kinds share -------------------------------------------------------------------------------------------------
/// The light's transform; fails at the light where it has no inverse.
Transform placed(Light const& light, Assets const& assets);
/// Unit direction from -> to, in the world.
inline Vec3 axis(Transform const& to_world, Vec3 from, Vec3 to) {
    return normalize(to_world.vector(to - from));
}
/// What arrives at p from a point that sends `intensity` there.
std::optional<LightSample> sample_from_point(LightData const& d, Vec3 p, Spectrum intensity);

}  // namespace nephroid
