#include "model/texture.h"

#include "scene/match.h"
#include "spectrum/uplift.h"
#include "texture_procedural.h"

#include <cmath>

namespace nephroid {

namespace {

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

/// A picture's (s, t) is down from the upper left corner, a texture's up from the lower left.
MappedPoint picture_point(ImageTexture const& t, TextureData const& data, TexturePoint const& at) {
    MappedPoint const m = map_point(t.mapping, data.mapping, at);
    return {{m.st.x, 1.0f - m.st.y}, {m.dst_dx.x, -m.dst_dx.y}, {m.dst_dy.x, -m.dst_dy.y}};
}

/// (1 - w) a + w b, of which only what counts is evaluated. evaluate(id) gives a number or a spectrum.
template <class Evaluate>
auto blend(float w, TextureId a, TextureId b, Evaluate const& evaluate) {
    if (w == 0.0f) return evaluate(a);
    if (w == 1.0f) return evaluate(b);
    return evaluate(a) * (1.0f - w) + evaluate(b) * w;
}

/// The kinds that are made of others do the same with numbers and with spectra. What is left is for `leaf`.
template <class Value, class Evaluate, class Leaf>
Value evaluate_kind(TextureKind const& kind, TextureData const& data, TexturePoint const& at,
                    Evaluate const& evaluate, Leaf const& leaf, Assets const& assets) {
    return match(
        kind,
        [&](CheckerboardTexture const& t) {
            return blend(checkerboard_second(t, data.mapping, at), t.tex1, t.tex2, evaluate);
        },
        [&](ScaleTexture const& t) -> Value {
            float const s = evaluate_float(assets, t.scale, at);
            return s == 0.0f ? Value{} : evaluate(t.tex) * s;
        },
        [&](MixTexture const& t) {
            return blend(evaluate_float(assets, t.amount, at), t.tex1, t.tex2, evaluate);
        },
        [&](DirectionMixTexture const& t) {
            return blend(min(abs_dot(at.n, data.direction), 1.0f), t.tex2, t.tex1, evaluate);
        },
        [&](BilerpTexture const& t) {
            Vec2 const st = map_point(t.mapping, data.mapping, at).st;
            return blend(st.y, t.v00, t.v01, evaluate) * (1.0f - st.x) +
                   blend(st.y, t.v10, t.v11, evaluate) * st.x;
        },
        [&](DotsTexture const& t) {
            return evaluate(inside_dot(map_point(t.mapping, data.mapping, at).st) ? t.inside : t.outside);
        },
        leaf);
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
    Overloads const leaf{
        [](ConstantFloatTexture const& t) { return t.value; },
        [](ConstantSpectrumTexture const&) { return 0.0f; }, [](MarbleTexture const&) { return 0.0f; },
        [&](ImageTexture const& t) {
            MappedPoint const m = picture_point(t, data, at);
            float const v =
                t.scale * assets.pyramid(t.image).lookup(m.st, filter_of(t.filter), wrap_of(t.wrap), m.dst_dx,
                                                         m.dst_dy, t.max_anisotropy);
            return t.invert ? std::fmax(0.0f, 1.0f - v) : v;
        },
        [&](auto const& noise) { return evaluate(noise, data.mapping, at); }};
    return evaluate_kind<float>(
        assets.scene()[id].kind, data, at, [&](TextureId other) { return evaluate_float(assets, other, at); },
        leaf, assets);
}

Spectrum evaluate_spectrum(Assets const& assets, TextureId id, TexturePoint const& at,
                           Wavelengths const& lambda) {
    TextureData const& data = assets.data(id);
    Overloads const leaf{
        [](ConstantFloatTexture const& t) { return Spectrum(t.value); },
        [&](ConstantSpectrumTexture const&) { return data.spectrum.sample(lambda); },
        [&](MarbleTexture const& t) {
            return rgb_to_spectrum(evaluate(t, data.mapping, at), SpectrumRole::Albedo, lambda);
        },
        [&](ImageTexture const& t) {
            MappedPoint const m = picture_point(t, data, at);
            Vec3 rgb =
                t.scale * assets.pyramid(t.image).lookup_rgb(m.st, filter_of(t.filter), wrap_of(t.wrap),
                                                             m.dst_dx, m.dst_dy, t.max_anisotropy);
            if (t.invert) rgb = Vec3{1.0f} - rgb;
            return rgb_to_spectrum(max(rgb, Vec3{0.0f}), t.role, lambda);
        },
        [&](auto const& noise) { return Spectrum(evaluate(noise, data.mapping, at)); }};
    return evaluate_kind<Spectrum>(
        assets.scene()[id].kind, data, at,
        [&](TextureId other) { return evaluate_spectrum(assets, other, at, lambda); }, leaf, assets);
}

}  // namespace nephroid
