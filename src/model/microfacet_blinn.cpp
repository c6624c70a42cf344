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
    // Walter et al. 2007, section 5.2: Beckmann's, at the same alpha.
    return beckmann_hidden(m, w);
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
