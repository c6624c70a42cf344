// What a dielectric boundary, smooth or of microfacets, does to light as a whole: from one direction, and to diffuse light that comes
// from inside. What the layer below absorbs on the way along the normal is its optical depth.
#pragma once

#include "model/microfacet.h"

namespace nephroid {

/// The part of light from a direction of cosine mu outside that arrives below a layer of optical depth `depth`.
float boundary_transmittance(Microfacets const& m, float eta, float depth, float mu);
/// The part that is reflected, of light from a direction of cosine mu outside.
float boundary_reflectance(Microfacets const& m, float eta, float mu);

/// What becomes of diffuse light that leaves the base of a layer: 2 integral R(mu) exp(-2 depth / mu) mu dmu comes back to the base, and
/// 2 integral T(mu) exp(-depth / mu) mu dmu gets out. Together 1 where the boundary is smooth and the layer absorbs nothing.
struct DiffuseBoundary {
    float back = 0, out = 0;
};
/// From tables, to 1e-3, where they reach that index; beyond, that of the last.
DiffuseBoundary diffuse_boundary(Microfacets const& m, float eta, float depth);
bool diffuse_boundary_covers(float eta);

}  // namespace nephroid
