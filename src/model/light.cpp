// The sum over the kinds of light (light_kinds.h), and what they share.
#include "light_kinds.h"

#include "spectrum/color.h"

#include <cmath>

namespace nephroid {

RuntimeSpectrum emission_spectrum(Assets& assets, Spd const& spd, float scale, float target,
                                  double unit_output) {
    // A spectrum names a colour: it is scaled to luminance 1 first (pbrt-v4).
    double const y = photometric(spd);
    if (!(y > 0)) return assets.spectra().compile(ConstantSpd{0}, SpectrumRole::Illuminant);
    double s = scale / y;
    if (target >= 0 && unit_output > 0) s *= static_cast<double>(target) / unit_output;
    return assets.spectra().compile(spd, SpectrumRole::Illuminant).scaled(static_cast<float>(s));
}

Transform placed(Light const& light, Assets const& assets) {
    auto const t = make_transform(light.to_world);
    if (!t) assets.scene().fail(light.where, "the light's transform cannot be inverted; remove a scale by 0");
    return *t;
}

std::optional<LightSample> sample_from_point(LightData const& d, Vec3 p, Spectrum intensity) {
    std::optional<LightSample> result;
    Vec3 const to_light = d.position - p;
    float const r2 = length_squared(to_light);
    if (!(r2 > 0.0f) || intensity.is_black()) return result;
    LightSample& s = result.emplace();
    s.wi = to_light / std::sqrt(r2);
    s.radiance = intensity / r2;
    s.pdf = 1;
    s.delta = true;
    s.p = d.position;
    return result;
}

std::optional<EmissionSample> emission_from_point(LightData const& d, Vec3 w, Spectrum intensity, float pdf) {
    std::optional<EmissionSample> result;
    if (!(pdf > 0.0f) || !std::isfinite(pdf) || intensity.is_black()) return result;
    EmissionSample& s = result.emplace();
    s.ray = {d.position, w};
    s.radiance = intensity;
    s.pdf_direction = pdf;
    s.delta_position = true;
    return result;
}

std::optional<EmissionSample> emission_from_infinity(BoundingSphere const& scene, Vec3 to_light,
                                                     Spectrum radiance, float pdf_direction, bool delta,
                                                     Vec2 u_position) {
    std::optional<EmissionSample> result;
    float const pdf_position = 1.0f / (kPi * sqr(scene.radius));
    if (!(pdf_direction > 0.0f) || !std::isfinite(pdf_direction) || !std::isfinite(pdf_position) ||
        radiance.is_black())
        return result;
    Vec2 const disk = square_to_disk(u_position);
    EmissionSample& s = result.emplace();
    s.ray.o = scene.centre + scene.radius * (frame_from_z(to_light).from_local({disk.x, disk.y, 1.0f}));
    s.ray.d = -to_light;
    s.radiance = radiance;
    s.pdf_position = pdf_position;
    s.pdf_direction = pdf_direction;
    s.delta_direction = delta;
    return result;
}

float disk_density(BoundingSphere const& scene, Vec3 p, Vec3 w) {
    // What lies in the scene may lie on its sphere: a little more than rounding is let in.
    Vec3 const across = cross(p - scene.centre, w);
    float const radius2 = sqr(scene.radius);
    float const pdf = 1.0f / (kPi * radius2);
    return std::isfinite(pdf) && length_squared(across) <= radius2 * (1 + 0x1p-10f) ? pdf : 0.0f;
}

LightBounds bounds_at_point(LightData const& d, float intensity) {
    LightBounds b;
    b.box.add(d.position);
    b.intensity = intensity;
    return b;
}
LightBounds bounds_at_point(LightData const& d, float intensity, Vec3 axis, float theta_o, float theta_e) {
    LightBounds b = bounds_at_point(d, intensity);
    b.axis = axis;
    b.cos_normals = std::cos(std::min(theta_o, kPi));
    b.cos_emission = std::cos(std::min(std::max(theta_e, kSharpEdge), kPi));
    return b;
}

bool is_infinite(Light const& light) {
    return match(light.kind, []<class K>(K const&) { return EnvironmentModel<K>; });
}
bool is_delta(Light const& light) { return !is_infinite(light); }

LightData prepare(Light const& light, Assets& assets) {
    return match(light.kind, [&](auto const& kind) { return prepare(kind, light, assets); });
}

std::optional<LightSample> sample_light(Light const& light, LightData const& d, Assets const& assets, Vec3 p,
                                        Vec2 u, Wavelengths const& lambda) {
    return match(light.kind, [&](auto const& kind) { return sample_light(kind, d, assets, p, u, lambda); });
}

Spectrum environment_radiance(Light const& light, LightData const& d, Assets const& assets, Vec3 p, Vec3 w,
                              Wavelengths const& lambda) {
    return match(light.kind, [&]<class K>(K const& kind) -> Spectrum {
        if constexpr (EnvironmentModel<K>)
            return environment_radiance(kind, d, assets, p, w, lambda);
        else
            return {};
    });
}

float environment_pdf(Light const& light, LightData const& d, Vec3 p, Vec3 w) {
    return match(light.kind, [&]<class K>(K const& kind) -> float {
        if constexpr (EnvironmentModel<K>)
            return environment_pdf(kind, d, p, w);
        else
            return 0.0f;
    });
}

std::optional<EmissionSample> sample_emission(Light const& light, LightData const& d, Assets const& assets,
                                              BoundingSphere const& scene, Vec2 u_position, Vec2 u_direction,
                                              Wavelengths const& lambda) {
    return match(light.kind, [&](auto const& kind) {
        return sample_emission(kind, d, assets, scene, u_position, u_direction, lambda);
    });
}

EmissionDensity emission_density(Light const& light, LightData const& d, BoundingSphere const& scene, Vec3 p,
                                 Vec3 w) {
    return match(light.kind, [&](auto const& kind) { return emission_density(kind, d, scene, p, w); });
}

std::optional<LightBounds> light_bounds(Light const& light, LightData const& d, Assets const& assets) {
    return match(light.kind, [&](auto const& kind) { return light_bounds(kind, d, assets); });
}

float power(Light const& light, LightData const& d, Assets const& assets, BoundingSphere const& scene) {
    return match(light.kind, [&](auto const& kind) { return power(kind, d, assets, scene); });
}

}  // namespace nephroid
