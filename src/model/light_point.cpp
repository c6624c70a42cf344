// Lights at a point: the same in every direction, or a cone.
#include "light_kinds.h"

#include <cmath>

namespace nephroid {

// --- point ------------------------------------------------------------------------------------------------------------
LightData prepare(PointLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.position = d.to_world.point(l.from);
    d.emission = emission_spectrum(assets, l.intensity, l.scale, l.power, 4 * static_cast<double>(kPi));
    return d;
}

std::optional<LightSample> sample_light(PointLight const&, LightData const& d, Assets const&, Vec3 p, Vec2,
                                        Wavelengths const& lambda) {
    return sample_from_point(d, p, d.emission.sample(lambda));
}

float power(PointLight const&, LightData const& d, Assets const&, BoundingSphere const&) {
    return 4.0f * kPi * d.emission.max_value();
}

// --- spot -------------------------------------------------------------------------------------------------------------
namespace {

/// Solid angle of a spot, weighted by its falloff: 2 pi ((1 - cos_inner) + (cos_inner - cos_outer) / 2).
double spot_solid_angle(double cos_inner, double cos_outer) {
    return 2.0 * static_cast<double>(kPi) * ((1 - cos_inner) + (cos_inner - cos_outer) / 2);
}
double spot_solid_angle(LightData const& d) {
    return spot_solid_angle(static_cast<double>(d.cos_inner), static_cast<double>(d.cos_outer));
}

/// Smoothstep in the cosine between the cones (pbrt-v4).
float spot_falloff(LightData const& d, float cos_t) {
    if (cos_t <= d.cos_outer) return 0.0f;
    if (cos_t >= d.cos_inner) return 1.0f;
    float const x = (cos_t - d.cos_outer) / (d.cos_inner - d.cos_outer);
    return x * x * (3.0f - 2.0f * x);
}

}  // namespace

LightData prepare(SpotLight const& l, Light const& light, Assets& assets) {
    LightData d;
    d.to_world = placed(light, assets);
    d.position = d.to_world.point(l.from);
    d.direction = axis(d.to_world, l.from, l.to);
    d.cos_outer = std::cos(l.cone_angle);
    d.cos_inner = std::cos(l.cone_angle - l.cone_delta);
    d.emission = emission_spectrum(assets, l.intensity, l.scale, l.power, spot_solid_angle(d));
    return d;
}

std::optional<LightSample> sample_light(SpotLight const&, LightData const& d, Assets const&, Vec3 p, Vec2,
                                        Wavelengths const& lambda) {
    Vec3 const w = p - d.position;
    float const len = length(w);
    if (!(len > 0.0f)) return std::nullopt;
    float const falloff = spot_falloff(d, dot(w, d.direction) / len);
    if (falloff == 0.0f) return std::nullopt;
    return sample_from_point(d, p, d.emission.sample(lambda) * falloff);
}

float power(SpotLight const&, LightData const& d, Assets const&, BoundingSphere const&) {
    return d.emission.max_value() * static_cast<float>(spot_solid_angle(d));
}

}  // namespace nephroid
