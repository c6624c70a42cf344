// Microfacets: a surface of many small mirrors whose normals wm are spread about +z (Cook & Torrance 1982; PBRT 4th ed., 9.6).
// All directions are in the shading frame; wm has wm.z > 0. Shadowing is Smith's, height-correlated (Heitz 2014, eq. 99):
// G = 1 / (1 + Lambda(wo) + Lambda(wi)), on both sides of the surface.
#pragma once

#include "math/frame.h"
#include "scene/material.h"

namespace nephroid {

struct Microfacets {
    float ax = 0, ay = 0;  // alpha along x and y
    Distribution kind = Distribution::TrowbridgeReitz;
    bool multiscatter = false;  // models of it make up for the light that one reflection alone loses

    /// So nearly a mirror that floats cannot tell: models turn into smooth ones (pbrt-v4).
    [[nodiscard]] bool smooth() const { return max(ax, ay) < 1e-3f; }
    /// So narrow that light is traced through it, as through a mirror: photons would tell little there, and what it throws on other
    /// surfaces is a caustic. Half of a GGX lobe of alpha = 0.1 lies within 6 degrees.
    [[nodiscard]] bool near_specular() const { return max(ax, ay) < 0.1f; }
};

/// Density of normals: projected area one, integral D(wm) wm.z dwm = 1.
float microfacet_d(Microfacets const& m, Vec3 wm);
/// |cos theta| Lambda(w), finite everywhere: |cos theta| more of it is the area that w sees (Heitz 2014).
float microfacet_hidden(Microfacets const& m, Vec3 w);
/// Smith's Lambda: the invisible area per visible one from w; infinite in the tangent plane.
inline float microfacet_lambda(Microfacets const& m, Vec3 w) {
    return w.z == 0.0f ? kInfinity : microfacet_hidden(m, w) / abs_cos_theta(w);
}
inline float microfacet_g1(Microfacets const& m, Vec3 w) { return 1.0f / (1.0f + microfacet_lambda(m, w)); }
inline float microfacet_g(Microfacets const& m, Vec3 wo, Vec3 wi) {
    return 1.0f / (1.0f + microfacet_lambda(m, wo) + microfacet_lambda(m, wi));
}
/// G / |cos_o cos_i|, as models need it; finite unless both directions lie in the tangent plane (then 0).
inline float microfacet_g_over_cosines(Microfacets const& m, Vec3 wo, Vec3 wi) {
    float const o = abs_cos_theta(wo), i = abs_cos_theta(wi);
    float const below = o * i + (o * microfacet_hidden(m, wi) + i * microfacet_hidden(m, wo));
    return below > 0.0f ? 1.0f / below : 0.0f;
}
/// Draws a normal that faces light from w (either side). TrowbridgeReitz and Beckmann: visible normals (Heitz 2018; Heitz &
/// d'Eon 2014); Blinn: see microfacet_blinn.cpp.
Vec3 sample_microfacet(Microfacets const& m, Vec3 w, Vec2 u);
/// The density by solid angle with which sample_microfacet(w) gives wm.
float microfacet_pdf(Microfacets const& m, Vec3 w, Vec3 wm);

}  // namespace nephroid
