// Parallel light from a direction.
#include "light_kinds.h"

namespace nephroid {

LightData prepare(DistantLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.direction = -axis(d.to_world, l.from, l.to);
    d.emission = emission_spectrum(assets, l.radiance, l.scale, l.illuminance, 1);
    return d;
}

std::optional<LightSample> sample_light(DistantLight const&, LightData const& d, Assets const&, Vec3, Vec2,
                                        Wavelengths const& lambda) {
    std::optional<LightSample> result;
    LightSample& s = result.emplace();
    s.wi = d.direction;
    s.radiance = d.emission.sample(lambda);
    s.pdf = 1;
    s.delta = true;
    s.at_infinity = true;
    return result;
}

float power(DistantLight const&, LightData const& d, Assets const&, BoundingSphere const& scene) {
    return d.emission.max_value() * (kPi * sqr(scene.radius));
}

std::optional<EmissionSample> sample_emission(DistantLight const&, LightData const& d, Assets const&,
                                              BoundingSphere const& scene, Vec2 u_position, Vec2,
                                              Wavelengths const& lambda) {
    return emission_from_infinity(scene, d.direction, d.emission.sample(lambda), 1.0f, true, u_position);
}

EmissionDensity emission_density(DistantLight const&, LightData const& d, BoundingSphere const& scene, Vec3 p,
                                 Vec3) {
    return {disk_density(scene, p, d.direction), 0.0f};
}

std::optional<LightBounds> light_bounds(DistantLight const&, LightData const&, Assets const&) {
    return std::nullopt;
}

}  // namespace nephroid
