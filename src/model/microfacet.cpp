// Distributions of microfacet normals and their shadowing: Trowbridge & Reitz's, and the choice among all.
#include "microfacet_kinds.h"

namespace nephroid {

namespace {

float trowbridge_reitz_d(Microfacets const& m, Vec3 wm) {
    // Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33, with the tangents multiplied out.
    float const e = sqr(wm.x / m.ax) + sqr(wm.y / m.ay) + sqr(wm.z);
    return 1.0f / (kPi * m.ax * m.ay * sqr(e));
}

float trowbridge_reitz_hidden(Microfacets const& m, Vec3 w) {
    // Heitz 2014, eq. 72, times |cos| and without the cancellation: (sqrt(c^2 + s^2) - c) / 2.
    float const s2 = stretched_sine2(m, w), c = std::abs(w.z);
    float const sum = c + std::sqrt(c * c + s2);
    return sum > 0.0f ? 0.5f * s2 / sum : 0.0f;
}

Vec3 trowbridge_reitz_sample(Microfacets const& m, Vec3 w, Vec2 u) {
    // Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", listing 3: stretched to alpha = 1, the visible
    // normals are the halfway vectors of w and a uniform spherical cap.
    Vec3 const stretched = normalize(Vec3{m.ax * w.x, m.ay * w.y, w.z});
    float const z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    float const r = safe_sqrt(1.0f - z * z);
    float const phi = kTwoPi * u.x;
    Vec3 const half = Vec3{r * std::cos(phi), r * std::sin(phi), z} + stretched;
    return normalize(Vec3{m.ax * half.x, m.ay * half.y, max(1e-7f, half.z)});
}

}  // namespace

float microfacet_d(Microfacets const& m, Vec3 wm) {
    if (!(wm.z > 0.0f)) return 0.0f;
    switch (m.kind) {
        case Distribution::Beckmann:
            return beckmann_d(m, wm);
        case Distribution::Blinn:
            return blinn_d(m, wm);
        case Distribution::TrowbridgeReitz:
            break;
    }
    return trowbridge_reitz_d(m, wm);
}

float microfacet_hidden(Microfacets const& m, Vec3 w) {
    switch (m.kind) {
        case Distribution::Beckmann:
            return beckmann_hidden(m, w);
        case Distribution::Blinn:
            return blinn_hidden(m, w);
        case Distribution::TrowbridgeReitz:
            break;
    }
    return trowbridge_reitz_hidden(m, w);
}

Vec3 sample_microfacet(Microfacets const& m, Vec3 w, Vec2 u) {
    if (w.z < 0.0f) w = -w;
    switch (m.kind) {
        case Distribution::Beckmann:
            return beckmann_sample(m, w, u);
        case Distribution::Blinn:
            return blinn_sample(m, w, u);
        case Distribution::TrowbridgeReitz:
            break;
    }
    return trowbridge_reitz_sample(m, w, u);
}

float microfacet_pdf(Microfacets const& m, Vec3 w, Vec3 wm) {
    if (w.z < 0.0f) w = -w;
    float const seen = dot(w, wm);
    if (!(seen > 0.0f)) return 0.0f;
    if (m.kind == Distribution::Blinn) return blinn_pdf(m, w, wm);
    // Heitz 2018, eq. 3: G1(w) D(wm) max(0, w.wm) / |cos theta|, with G1 / |cos theta| = 1 / the visible area.
    return microfacet_d(m, wm) * seen / (w.z + microfacet_hidden(m, w));
}

}  // namespace nephroid
