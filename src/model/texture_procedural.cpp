#include "texture_procedural.h"

#include "model/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nephroid {

namespace {

/// The second antiderivative of a square wave, +1 in [0, 1) and -1 in [1, 2) with period 2, without the part that is linear
/// in x, which second differences do not see. In doubles, because these differences cancel.
double square_wave_twice_integrated(double x) {
    double const y = x / 2 - std::floor(x / 2) - 0.5;
    return y * (1 - 2 * std::abs(y));
}

/// The square wave's average around x under a triangle that reaches r to either side: the second difference of the above.
double square_wave_averaged(double x, double r) {
    if (!(std::abs(x) + r < std::numeric_limits<double>::infinity())) return 0;
    double const whole = std::floor(x - r);
    if (whole == std::floor(x + r)) return whole - 2 * std::floor(whole / 2) == 0 ? 1 : -1;
    double const sum = square_wave_twice_integrated(x + r) - 2 * square_wave_twice_integrated(x) +
                       square_wave_twice_integrated(x - r);
    return std::clamp(sum / (r * r), -1.0, 1.0);
}

/// One coordinate of a checkerboard, filtered over one and a half times the longer of the footprint's two steps.
double stripes(float x, float dx, float dy) {
    return square_wave_averaged(static_cast<double>(x),
                                1.5 * static_cast<double>(max(std::abs(dx), std::abs(dy))));
}

Octaves octaves_at(Transform const& to_texture, TexturePoint const& at, float roughness, int count) {
    return {to_texture.point(at.p), to_texture.vector(at.dpdx), to_texture.vector(at.dpdy), roughness, count};
}

/// pbrt's marble, from light through a dark vein: control points of which each four in a row make a Bézier segment.
constexpr std::array<std::array<float, 3>, 9> kMarble{{{0.58f, 0.58f, 0.6f},
                                                       {0.58f, 0.58f, 0.6f},
                                                       {0.58f, 0.58f, 0.6f},
                                                       {0.5f, 0.5f, 0.5f},
                                                       {0.6f, 0.59f, 0.58f},
                                                       {0.58f, 0.58f, 0.6f},
                                                       {0.58f, 0.58f, 0.6f},
                                                       {0.2f, 0.2f, 0.33f},
                                                       {0.58f, 0.58f, 0.6f}}};

/// t in [0, 1] along the marble's colours.
Vec3 marble_color(float t) {
    constexpr int kSegments = static_cast<int>(kMarble.size()) - 3;
    float const along = t * static_cast<float>(kSegments);
    int const first = std::clamp(static_cast<int>(along), 0, kSegments - 1);
    float const u = along - static_cast<float>(first), v = 1.0f - u;
    std::array<float, 4> const weight{v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u};  // Bernstein's
    Vec3 rgb{0.0f};
    for (std::size_t i = 0; i < 4; ++i) {
        auto const& c = kMarble[static_cast<std::size_t>(first) + i];
        rgb += weight[i] * Vec3{c[0], c[1], c[2]};
    }
    return 1.5f * rgb;
}

}  // namespace

float checkerboard_second(CheckerboardTexture const& t, Transform const& to_texture, TexturePoint const& at) {
    double product = 1;
    if (t.dimension == 2) {
        MappedPoint const m = map_point(t.mapping, to_texture, at);
        for (int i = 0; i < 2; ++i) product *= stripes(m.st[i], m.dst_dx[i], m.dst_dy[i]);
    } else {
        Vec3 const p = to_texture.point(at.p), dx = to_texture.vector(at.dpdx),
                   dy = to_texture.vector(at.dpdy);
        for (int i = 0; i < 3; ++i) product *= stripes(p[i], dx[i], dy[i]);
    }
    return static_cast<float>(0.5 - 0.5 * product);
}

bool inside_dot(Vec2 st) {
    constexpr float kRadius = 0.35f;
    constexpr float kMostShift = 0.5f - kRadius;  // a dot stays in its cell
    Vec2 const cell{std::floor(st.x + 0.5f), std::floor(st.y + 0.5f)};
    auto const random = [&](float s, float t) { return perlin_noise({cell.x + s, cell.y + t, 0.5f}); };
    if (!(random(0.5f, 0.5f) > 0.0f)) return false;
    Vec2 const center = cell + kMostShift * Vec2{random(1.5f, 2.8f), random(4.5f, 9.8f)};
    Vec2 const d = st - center;
    return d.x * d.x + d.y * d.y < kRadius * kRadius;
}

float evaluate(FbmTexture const& t, Transform const& to_texture, TexturePoint const& at) {
    return fbm(octaves_at(to_texture, at, t.roughness, t.octaves));
}

float evaluate(WrinkledTexture const& t, Transform const& to_texture, TexturePoint const& at) {
    return turbulence(octaves_at(to_texture, at, t.roughness, t.octaves));
}

float evaluate(WindyTexture const&, Transform const& to_texture, TexturePoint const& at) {
    Octaves const wind = octaves_at(to_texture, at, 0.5f, 3).scaled(0.1f);
    return std::abs(fbm(wind)) * fbm(octaves_at(to_texture, at, 0.5f, 6));
}

Vec3 evaluate(MarbleTexture const& t, Transform const& to_texture, TexturePoint const& at) {
    Octaves const o = octaves_at(to_texture, at, t.roughness, t.octaves).scaled(t.scale);
    float const layer = o.p.y + t.variation * fbm(o);
    return marble_color(std::isfinite(layer) ? 0.5f + 0.5f * std::sin(layer) : 0.5f);
}

}  // namespace nephroid
