// The distributions behind model/microfacet.h, each in its own file. What a distribution must say, beside its density:
// its hidden area `hidden(w)` = |cos| Lambda(w), which stays finite at grazing angles where Lambda does not. The visible
// area is then |cos| + hidden, the projected area of the normals that face w (Heitz 2014, eq. 23 with 43).
#pragma once

#include "model/microfacet.h"

#include <cmath>

namespace nephroid {

/// (w.x, w.y) stretched by the roughness: sin(theta) alpha(phi), PBRT 4th ed., eq. 9.22.
inline float stretched_sine2(Microfacets const& m, Vec3 w) { return sqr(m.ax * w.x) + sqr(m.ay * w.y); }

float beckmann_d(Microfacets const& m, Vec3 wm);
float beckmann_hidden(Microfacets const& m, Vec3 w);
Vec3 beckmann_sample(Microfacets const& m, Vec3 w, Vec2 u);

float blinn_d(Microfacets const& m, Vec3 wm);
float blinn_hidden(Microfacets const& m, Vec3 w);
Vec3 blinn_sample(Microfacets const& m, Vec3 w, Vec2 u);
float blinn_pdf(Microfacets const& m, Vec3 w, Vec3 wm);

}  // namespace nephroid
