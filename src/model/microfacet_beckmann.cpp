// Beckmann's distribution: slopes are normally distributed with variance alpha^2 / 2 (Beckmann & Spizzichino 1963).
#include "microfacet_kinds.h"

namespace nephroid {

namespace {

constexpr float kInvSqrtPi = 0.56418958354775628695f;

/// The s with 1 + erf(s) = t, 0 < t < 2: Giles 2012, "Approximating the erfinv function", table 5, with 1 - x^2 = t (2 - t)
/// so that the lower tail keeps its digits. Relative error 1e-6.
float inverse_erf_from_below(float t) {
    auto const polynomial = [](float w, auto... c) {
        float p = 0.0f;
        ((p = p * w + c), ...);
        return p;
    };
    float const w = -std::log(t * (2.0f - t));
    float const p =
        w < 5.0f ? polynomial(w - 2.5f, 2.81022636e-08f, 3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f,
                              0.00021858087f, -0.00125372503f, -0.00417768164f, 0.246640727f, 1.50140941f)
                 : polynomial(std::sqrt(w) - 3.0f, -0.000200214257f, 0.000100950558f, 0.00134934322f,
                              -0.00367342844f, 0.00573950773f, -0.0076224613f, 0.00943887047f, 1.00167406f,
                              2.83297682f);
    return p * (t - 1.0f);
}

/// The slope s along w of a visible normal at alpha = 1, w = (sine, 0, cosine). Its density is that of all slopes times
/// max(0, cosine - s sine) (Heitz & d'Eon 2014, eq. 13), whose integral up to s, doubled, is
///   cosine (1 + erf s) + sine exp(-s^2) / sqrt(pi).
/// In t = 1 + erf(s) it is increasing and concave, with the derivative cosine - s sine (Jakob 2014), so that Newton's steps
/// from below never overshoot; a step from above may, and is halved into the bracket.
float visible_slope(float sine, float cosine, float u) {
    float const a = cosine / sine;  // no normal of a greater slope is seen
    float const most = 1.0f + std::erf(a);
    float const target = u * (cosine * most + sine * kInvSqrtPi * std::exp(-a * a));
    float low = 0.0f, high = most;
    // Exact at the normal (uniform in t) and near it at grazing angles (falling linearly to 0).
    float t = most * lerp(sine, u, 1.0f - std::sqrt(1.0f - u));
    float s = 0.0f;
    for (int i = 0; i < 12; ++i) {
        t = max(t, 1e-12f);
        s = inverse_erf_from_below(min(t, 2.0f - 1.2e-7f));
        float const value = cosine * t + sine * kInvSqrtPi * std::exp(-s * s) - target;
        (value < 0.0f ? low : high) = t;
        float const slope = cosine - s * sine;
        float next = t - value / slope;
        if (!(next > low && next < high)) next = 0.5f * (low + high);
        float const step = std::abs(next - t);
        t = next;
        if (step <= 2e-7f * t) break;
    }
    return min(inverse_erf_from_below(clamp(t, 1e-12f, 2.0f - 1.2e-7f)), a);
}

}  // namespace

float beckmann_d(Microfacets const& m, Vec3 wm) {
    // Walter et al. 2007, eq. 25, anisotropic as in Heitz 2014, eq. 81.
    float const z2 = sqr(wm.z);
    float const tan2 = (sqr(wm.x / m.ax) + sqr(wm.y / m.ay)) / z2;
    float const d = std::exp(-tan2) / (kPi * m.ax * m.ay * z2 * z2);
    return d < kInfinity ? d : 0.0f;  // 0 / 0 at the horizon, where exp wins
}

float beckmann_hidden(Microfacets const& m, Vec3 w) {
    // Heitz 2014, eq. 70, with erf itself and not a fit: visible normals have their density by it. Times |cos|.
    float const s = std::sqrt(stretched_sine2(m, w)), c = std::abs(w.z);
    if (c >= 4.0f * s) return 0.0f;  // Lambda < 2e-9
    float const a = c / s;
    return max(0.0f, 0.5f * (s * kInvSqrtPi * std::exp(-a * a) - c * std::erfc(a)));
}

Vec3 beckmann_sample(Microfacets const& m, Vec3 w, Vec2 u) {
    // Heitz & d'Eon 2014: stretched to alpha = 1, the slope across w is independent of the one along it, and not weighted.
    Vec3 const v = normalize(Vec3{m.ax * w.x, m.ay * w.y, w.z});
    float const sine = std::sqrt(sqr(v.x) + sqr(v.y));
    Vec2 const toward = sine > 1e-7f ? Vec2{v.x / sine, v.y / sine} : Vec2{1, 0};
    auto const inside = [](float x) { return clamp(x, 1e-10f, kOneMinusEpsilon); };
    float const along =
        sine > 1e-7f ? visible_slope(sine, v.z, inside(u.x)) : inverse_erf_from_below(2.0f * inside(u.x));
    float const across = inverse_erf_from_below(2.0f * inside(u.y));
    return normalize(Vec3{-m.ax * (toward.x * along - toward.y * across),
                          -m.ay * (toward.y * along + toward.x * across), 1.0f});
}

}  // namespace nephroid
