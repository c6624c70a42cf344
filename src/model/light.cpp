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

float power(Light const& light, LightData const& d, Assets const& assets, BoundingSphere const& scene) {
    return match(light.kind, [&](auto const& kind) { return power(kind, d, assets, scene); });
}

}  // namespace nephroid
