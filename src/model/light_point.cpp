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

std::optional<EmissionSample> sample_emission(PointLight const&, LightData const& d, Assets const&,
                                              BoundingSphere const&, Vec2, Vec2 u_direction,
                                              Wavelengths const& lambda) {
    return emission_from_point(d, square_to_uniform_sphere(u_direction), d.emission.sample(lambda),
                               kUniformSpherePdf);
}

EmissionDensity emission_density(PointLight const&, LightData const&, BoundingSphere const&, Vec3, Vec3) {
    return {0.0f, kUniformSpherePdf};
}

std::optional<LightBounds> light_bounds(PointLight const&, LightData const& d, Assets const&) {
    return bounds_at_point(d, d.emission.max_value());
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

/// Inverse of the integral of 2 (3 x^2 - 2 x^3): x of 2 x^3 - x^4 = u. The left side is convex, so that Newton's method
/// comes down from the right without ever passing the root; 2 x^3 >= u says where to start.
float sample_smoothstep(float u) {
    auto const target = static_cast<double>(u);
    double x = std::cbrt(target / 2);
    if (!(x > 0)) return 0;
    for (int i = 0; i < 6; ++i) {
        double const f = x * x * x * (2 - x) - target;
        x = std::min(1.0, x - f / (x * x * (6 - 4 * x)));
    }
    return static_cast<float>(x);
}

/// By solid angle: as the intensity, of which the falloff takes half between the cones.
float spot_density(LightData const& d, Vec3 w) {
    auto const solid_angle = static_cast<float>(spot_solid_angle(d));
    return solid_angle > 0.0f ? spot_falloff(d, dot(w, d.direction)) / solid_angle : 0.0f;
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

std::optional<EmissionSample> sample_emission(SpotLight const&, LightData const& d, Assets const&,
                                              BoundingSphere const&, Vec2, Vec2 u_direction,
                                              Wavelengths const& lambda) {
    // The inner cone evenly, or between the cones by the falloff.
    float const inner = 1.0f - d.cos_inner;
    float const between = (d.cos_inner - d.cos_outer) / 2.0f;
    float const split = u_direction.x * (inner + between);
    Vec3 local;
    if (split < inner) {
        local = square_to_uniform_cone({split / inner, u_direction.y}, inner);
    } else {
        float const x = sample_smoothstep(std::min((split - inner) / between, 1.0f));
        float const one_minus_cos = inner + (1.0f - x) * 2.0f * between;
        local = spherical_direction(safe_sqrt(one_minus_cos * (2.0f - one_minus_cos)), 1.0f - one_minus_cos,
                                    kTwoPi * u_direction.y);
    }
    Vec3 const w = normalize(frame_from_z(d.direction).from_local(local));
    return emission_from_point(d, w, d.emission.sample(lambda) * spot_falloff(d, dot(w, d.direction)),
                               spot_density(d, w));
}

EmissionDensity emission_density(SpotLight const&, LightData const& d, BoundingSphere const&, Vec3, Vec3 w) {
    return {0.0f, spot_density(d, w)};
}

std::optional<LightBounds> light_bounds(SpotLight const& l, LightData const& d, Assets const&) {
    return bounds_at_point(d, d.emission.max_value(), d.direction, l.cone_angle - l.cone_delta, l.cone_delta);
}

}  // namespace nephroid
