// Blinn's distribution: a power of the cosine (Blinn 1977), anisotropic by Ashikhmin & Shirley 2000: the exponent goes from
// nx along x to ny along y. n = 2 / alpha^2 - 2, by which it becomes Beckmann's as alpha falls (Walter et al. 2007).
//
// No stretching of space turns one roughness into another, so that visible normals have no closed form. Normals are drawn by
// D cos instead, and turned half around +z where w does not see them, which is no matter to D; where a normal and its
// counterpart are both seen the density is D cos, else twice that. Nothing is lost, and a sample weighs at most 2.
#include "microfacet_kinds.h"

namespace nephroid {

namespace {
float exponent(float alpha) { return max(0.0f, 2.0f / sqr(alpha) - 2.0f); }
}  // namespace

float blinn_d(Microfacets const& m, Vec3 wm) {
    // Ashikhmin & Shirley 2000, eq. 4 in its place; normalised so that D cos integrates to 1:
    // sqrt((nx + 2) (ny + 2)) / (2 pi) cos^(nx cos^2 phi + ny sin^2 phi).
    float const x2 = sqr(wm.x), y2 = sqr(wm.y), r2 = x2 + y2;
    // log cos without cancellation about +z.
    float const log_cos = r2 < 0.5f ? 0.5f * std::log1p(-r2) : std::log(wm.z);
    float const nx = exponent(m.ax), ny = exponent(m.ay);
    float const n = r2 > 0.0f ? (nx * x2 + ny * y2) / r2 : 0.0f;
    return kInvTwoPi * std::sqrt((nx + 2.0f) * (ny + 2.0f)) * std::exp(n * log_cos);
}

float blinn_hidden(Microfacets const& m, Vec3 w) {
    // Slopes along one azimuth have Student's distribution of nu = n + 2 degrees of freedom and scale alpha / sqrt 2 (Ribardiere
    // et al. 2017), so that |cos| Lambda = K integral_0^theta sin^(nu - 2)(x) sin(theta - x) dx with
    // K = Gamma((nu + 1) / 2) / (sqrt(pi) Gamma(nu / 2)), and, in p = (sin x / sin theta)^(nu - 1),
    //   = K sin^(nu - 1)(theta) / (nu - 1) integral_0^1 (sin theta - cos theta tan x) dp:
    // Gauss' rule with 4 points is within 0.002 in G1. Walter et al. 2007 take Beckmann's instead, which hides less: at alpha = 1
    // a mirror would return 1.7 times the light that came. Anisotropic: alpha is that along the azimuth of w.
    float const c = std::abs(w.z), c2 = sqr(c), s2 = sqr(w.x) + sqr(w.y);
    if (!(s2 > 0.0f)) return 0.0f;
    float const nu = max(2.0f, 2.0f * s2 / stretched_sine2(m, w));
    float const power = std::exp(0.5f * (nu - 1.0f) * (c2 < 0.5f ? std::log1p(-c2) : std::log(s2)));
    if (power < 1e-12f) return 0.0f;
    static constexpr float weight[] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};
    static constexpr float log_p[] = {-2.6674810f, -1.1084180f, -0.40057830f,
                                      -0.071950330f};  // of Gauss' nodes
    float integral = 0.0f;
    for (int i = 0; i < 4; ++i) {
        float const l = log_p[i] / (nu - 1.0f);
        integral += weight[i] * (1.0f - c * std::exp(l) / std::sqrt(c2 - s2 * std::expm1(2.0f * l)));
    }
    // Gamma(x + 1/2) / Gamma(x) by Stirling's series at x + 1.
    float const x = 0.5f * nu, y = 1.0f / (x + 1.0f);
    float const gammas =
        x / (x + 0.5f) * std::sqrt(x + 1.0f) * (1.0f - y * (0.125f - y * (1.0f / 128 + y * 5.0f / 1024)));
    constexpr float inv_sqrt_pi = 0.56418958354775628695f;
    return max(0.0f, gammas * inv_sqrt_pi * power * std::sqrt(s2) / (nu - 1.0f) * integral);
}

Vec3 blinn_sample(Microfacets const& m, Vec3 w, Vec2 u) {
    // Azimuth by 1 / (n(phi) + 2), then cos^(n(phi) + 1): Ashikhmin & Shirley 2000, eq. 9 and 10, for D cos.
    float const phi = kTwoPi * u.x;
    Vec2 const turned{m.ax * std::cos(phi), m.ay * std::sin(phi)};
    float const l2 = sqr(turned.x) + sqr(turned.y);
    float const n = (exponent(m.ax) * sqr(turned.x) + exponent(m.ay) * sqr(turned.y)) / l2;
    float const log_cos = std::log1p(-min(u.y, kOneMinusEpsilon)) / (n + 2.0f);
    float const r = safe_sqrt(-std::expm1(2.0f * log_cos) / l2);
    Vec3 const wm{turned.x * r, turned.y * r, std::exp(log_cos)};
    return dot(w, wm) < 0.0f ? Vec3{-wm.x, -wm.y, wm.z} : wm;
}

float blinn_pdf(Microfacets const& m, Vec3 w, Vec3 wm) {
    bool const both = 2.0f * w.z * wm.z > dot(w, wm);  // the counterpart is seen too
    return microfacet_d(m, wm) * wm.z * (both ? 1.0f : 2.0f);
}

}  // namespace nephroid
