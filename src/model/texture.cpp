#include "model/texture.h"

#include "scene/match.h"
#include "spectrum/uplift.h"

#include <cmath>

namespace nephroid {

namespace {

struct MappedPoint {
    Vec2 st{0, 0};
    Vec2 dst_dx{0, 0}, dst_dy{0, 0};
};

MappedPoint map_point(TextureMapping const& mapping, Transform const& to_texture, TexturePoint const& at) {
    return match(
        mapping,
        [&](UvMapping const& m) {
            return MappedPoint{{m.su * at.uv.x + m.du, m.sv * at.uv.y + m.dv},
                               {m.su * at.duv_dx.x, m.sv * at.duv_dx.y},
                               {m.su * at.duv_dy.x, m.sv * at.duv_dy.y}};
        },
        [&](SphericalMapping const&) {
            Vec3 const v = to_texture.point(at.p);
            float const len = length(v);
            float const theta = len > 0.0f ? std::acos(clamp(v.z / len, -1.0f, 1.0f)) : 0.0f;
            float phi = std::atan2(v.y, v.x);
            if (phi < 0.0f) phi += kTwoPi;
            return MappedPoint{{theta * kInvPi, phi * kInvTwoPi}};
        },
        [&](CylindricalMapping const&) {
            Vec3 const v = to_texture.point(at.p);
            return MappedPoint{{(kPi + std::atan2(v.y, v.x)) * kInvTwoPi, v.z}};
        },
        [&](PlanarMapping const& m) {
            Vec3 const v = to_texture.point(at.p);
            return MappedPoint{{m.du + dot(v, m.v1), m.dv + dot(v, m.v2)}};
        });
}

Wrap wrap_of(WrapMode w) {
    switch (w) {
        case WrapMode::Repeat:
            return Wrap::Repeat;
        case WrapMode::Black:
            return Wrap::Black;
        case WrapMode::Clamp:
            return Wrap::Clamp;
        case WrapMode::Octahedral:
            return Wrap::OctahedralSphere;
    }
    return Wrap::Repeat;
}
TextureFilter filter_of(FilterMode f) {
    switch (f) {
        case FilterMode::Point:
            return TextureFilter::Point;
        case FilterMode::Bilinear:
            return TextureFilter::Bilinear;
        case FilterMode::Trilinear:
            return TextureFilter::Trilinear;
        case FilterMode::Ewa:
            return TextureFilter::Ewa;
    }
    return TextureFilter::Bilinear;
}

/// Which of the two inputs a checkerboard shows (PBRT 4th ed., 10.4.4, without its filtering).
bool checkerboard_first(CheckerboardTexture const& t, TextureData const& data, TexturePoint const& at) {
    // Is floor(x) odd? In floats, which any coordinate fits.
    auto const odd = [](float x) { return std::floor(x) - 2.0f * std::floor(0.5f * std::floor(x)) == 1.0f; };
    if (t.dimension == 2) {
        Vec2 const st = map_point(t.mapping, data.mapping, at).st;
        return odd(st.x) == odd(st.y);
    }
    Vec3 const p = data.mapping.point(at.p);
    return (odd(p.x) != odd(p.y)) == odd(p.z);
}

}  // namespace

Spectrum rgb_to_spectrum(Vec3 rgb, SpectrumRole role, Wavelengths const& lambda) {
    if (role == SpectrumRole::Albedo) rgb = {clamp(rgb.x, 0, 1), clamp(rgb.y, 0, 1), clamp(rgb.z, 0, 1)};
    if (lambda.is_rgb()) return {rgb.x, rgb.y, rgb.z, 0.0f};
    if (role == SpectrumRole::Albedo) return srgb_to_sigmoid(rgb)(lambda);
    // Unbounded: twice the largest component keeps the sigmoid away from its ends (PBRT 4th ed., 4.6.6).
    float const m = 2.0f * max_component(rgb);
    if (!(m > 0.0f)) return {};
    return srgb_to_sigmoid(rgb / m)(lambda) * m;
}

float evaluate_float(Assets const& assets, TextureId id, TexturePoint const& at) {
    TextureData const& data = assets.data(id);
    return match(
        assets.scene()[id].kind, [](ConstantFloatTexture const& t) { return t.value; },
        [](ConstantSpectrumTexture const&) { return 0.0f; },
        [&](ImageTexture const& t) {
            MappedPoint m = map_point(t.mapping, data.mapping, at);
            m.st.y = 1.0f - m.st.y;
            float const v = t.scale * assets.pyramid(t.image).lookup(m.st, filter_of(t.filter),
                                                                     wrap_of(t.wrap), m.dst_dx, m.dst_dy);
            return t.invert ? std::fmax(0.0f, 1.0f - v) : v;
        },
        [&](CheckerboardTexture const& t) {
            return evaluate_float(assets, checkerboard_first(t, data, at) ? t.tex1 : t.tex2, at);
        },
        [&](ScaleTexture const& t) {
            float const s = evaluate_float(assets, t.scale, at);
            return s == 0.0f ? 0.0f : s * evaluate_float(assets, t.tex, at);
        },
        [&](MixTexture const& t) {
            float const a = evaluate_float(assets, t.amount, at);
            float const x = a != 1.0f ? evaluate_float(assets, t.tex1, at) : 0.0f;
            float const y = a != 0.0f ? evaluate_float(assets, t.tex2, at) : 0.0f;
            return (1.0f - a) * x + a * y;
        });
}

Spectrum evaluate_spectrum(Assets const& assets, TextureId id, TexturePoint const& at,
                           Wavelengths const& lambda) {
    TextureData const& data = assets.data(id);
    return match(
        assets.scene()[id].kind, [](ConstantFloatTexture const& t) { return Spectrum(t.value); },
        [&](ConstantSpectrumTexture const&) { return data.spectrum.sample(lambda); },
        [&](ImageTexture const& t) {
            MappedPoint m = map_point(t.mapping, data.mapping, at);
            m.st.y = 1.0f - m.st.y;
            Vec3 rgb = t.scale * assets.pyramid(t.image).lookup_rgb(m.st, filter_of(t.filter),
                                                                    wrap_of(t.wrap), m.dst_dx, m.dst_dy);
            if (t.invert) rgb = Vec3{1.0f} - rgb;
            return rgb_to_spectrum(max(rgb, Vec3{0.0f}), t.role, lambda);
        },
        [&](CheckerboardTexture const& t) {
            return evaluate_spectrum(assets, checkerboard_first(t, data, at) ? t.tex1 : t.tex2, at, lambda);
        },
        [&](ScaleTexture const& t) {
            float const s = evaluate_float(assets, t.scale, at);
            return s == 0.0f ? Spectrum{} : s * evaluate_spectrum(assets, t.tex, at, lambda);
        },
        [&](MixTexture const& t) {
            float const a = evaluate_float(assets, t.amount, at);
            Spectrum const x = a != 1.0f ? evaluate_spectrum(assets, t.tex1, at, lambda) : Spectrum{};
            Spectrum const y = a != 0.0f ? evaluate_spectrum(assets, t.tex2, at, lambda) : Spectrum{};
            return x * (1.0f - a) + y * a;
        });
}

}  // namespace nephroid
