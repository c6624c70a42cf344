// Distributions of microfacet normals and their shadowing.
#include "model/microfacet.h"

#include <cmath>

namespace nephroid {

namespace {

/// (alpha(phi) tan theta)^2, the roughness that w sees along its own azimuth (PBRT 4th ed., eq. 9.22).
float projected_slope2(Microfacets const& m, Vec3 w) {
    return (sqr(m.ax * w.x) + sqr(m.ay * w.y)) / sqr(w.z);
}

}  // namespace

float microfacet_d(Microfacets const& m, Vec3 wm) {
    if (!(wm.z > 0.0f)) return 0.0f;
    // Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33, with the tangents multiplied out.
    float const e = sqr(wm.x / m.ax) + sqr(wm.y / m.ay) + sqr(wm.z);
    return 1.0f / (kPi * m.ax * m.ay * sqr(e));
}

float microfacet_lambda(Microfacets const& m, Vec3 w) {
    if (w.z == 0.0f) return kInfinity;
    // Heitz 2014, eq. 72.
    return 0.5f * (std::sqrt(1.0f + projected_slope2(m, w)) - 1.0f);
}

Vec3 sample_microfacet(Microfacets const& m, Vec3 w, Vec2 u) {
    // Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", listing 3: stretched to alpha = 1, the visible
    // normals are the halfway vectors of w and a uniform spherical cap.
    if (w.z < 0.0f) w = -w;
    Vec3 const stretched = normalize(Vec3{m.ax * w.x, m.ay * w.y, w.z});
    float const z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    float const r = safe_sqrt(1.0f - z * z);
    float const phi = kTwoPi * u.x;
    Vec3 const half = Vec3{r * std::cos(phi), r * std::sin(phi), z} + stretched;
    return normalize(Vec3{m.ax * half.x, m.ay * half.y, max(1e-7f, half.z)});
}

float microfacet_pdf(Microfacets const& m, Vec3 w, Vec3 wm) {
    // Heitz 2018, eq. 3: G1(w) D(wm) max(0, w.wm) / |cos theta|, with G1 / |cos theta| written so that it has no 0/0.
    if (w.z < 0.0f) w = -w;
    float const visible = 2.0f / (w.z + std::sqrt(sqr(m.ax * w.x) + sqr(m.ay * w.y) + sqr(w.z)));
    return visible * microfacet_d(m, wm) * max(0.0f, dot(w, wm));
}

}  // namespace nephroid
