// What a surface emits where.
#pragma once

#include "light_table.h"
#include "model/texture.h"

namespace nephroid {

/// A factor on Emitter::radiance, as linear sRGB: the picture or the texture at a point of the surface.
inline Vec3 emission_picture(Assets const& assets, Emitter const& e, Vec2 uv) {
    // Light is 0 outside the picture's square only in name: coordinates are clamped to it.
    return max(assets.pyramid(e.light->image).bilerp_rgb(0, {uv.x, 1.0f - uv.y}, Wrap::Clamp), Vec3{0.0f});
}

/// Radiance of an emitting point, whatever its side. p is in the world.
inline Spectrum emission_at(Assets const& assets, Emitter const& e, Vec3 p, Vec2 uv,
                            Wavelengths const& lambda) {
    Spectrum const radiance = e.radiance.sample(lambda);
    if (e.light->image.valid())
        return radiance * rgb_to_spectrum(emission_picture(assets, e, uv), SpectrumRole::Unbounded, lambda);
    if (e.light->texture.valid()) {
        TexturePoint at;
        at.p = p;
        at.uv = uv;
        return radiance * clamp(evaluate_spectrum(assets, e.light->texture, at, lambda), 0.0f, kInfinity);
    }
    return radiance;
}

/// The share of its emission that an emitting point sends out, of light that is sampled there. A ray that finds the surface by
/// itself has passed its alpha already.
inline float opacity(Assets const& assets, Emitter const& e, Vec3 p, Vec2 uv) {
    if (!e.alpha.valid() || e.unseen) return 1.0f;
    TexturePoint at;
    at.p = p;
    at.uv = uv;
    return min(max(evaluate_float(assets, e.alpha, at), 0.0f), 1.0f);  // 0 if it is no number
}

/// How bright it is there relative to Emitter::radiance, for choosing places.
inline float emission_level(Assets const& assets, Emitter const& e, Vec3 p, Vec2 uv) {
    Vec3 rgb{1, 1, 1};
    if (e.light->image.valid()) {
        rgb = emission_picture(assets, e, uv);
    } else if (e.light->texture.valid()) {
        TexturePoint at;
        at.p = p;
        at.uv = uv;
        Spectrum const s = evaluate_spectrum(assets, e.light->texture, at, Wavelengths::rgb());
        rgb = max(Vec3{s[0], s[1], s[2]}, Vec3{0.0f});
    }
    // The mean of the channels, not luminance: a blue light is light.
    float const level = (rgb.x + rgb.y + rgb.z) / 3.0f * opacity(assets, e, p, uv);
    return std::isfinite(level) ? level : 0.0f;
}

}  // namespace nephroid
