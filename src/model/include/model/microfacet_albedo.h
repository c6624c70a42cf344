// What part of the light microfacets scatter at the first encounter, for light from a direction of cosine mu: the rest is
// shadowed, which models that compensate for it put back (Kulla & Conty 2017). From tables that the build computes by quadrature;
// tests hold them against quadrature of the models.
// alpha is the isotropic roughness; an anisotropic surface is answered by sqrt(ax ay).
#pragma once

#include "model/microfacet.h"

namespace nephroid {

/// E(mu, alpha) with F = 1: 1 at alpha = 0.
float microfacet_albedo(Distribution d, float mu, float alpha);
/// 2 integral E(mu) mu dmu.
float microfacet_albedo_average(Distribution d, float alpha);

/// Reflected and transmitted part with Fresnel's F of a dielectric, eta = n_transmitted / n_incident, below 1 from inside; power,
/// so that without shadowing they sum to 1.
float dielectric_reflection_albedo(Distribution d, float mu, float alpha, float eta);
float dielectric_transmission_albedo(Distribution d, float mu, float alpha, float eta);
/// 2 integral (R + T)(mu) mu dmu.
float dielectric_albedo_average(Distribution d, float alpha, float eta);

}  // namespace nephroid
