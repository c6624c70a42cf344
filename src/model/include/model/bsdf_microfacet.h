// Rough boundaries: conductors (PBRT 4th ed., 9.4 with 9.6) and dielectrics (9.7).
#pragma once

#include "model/bsdf_sample.h"
#include "model/microfacet.h"

namespace nephroid {

/// Microfacets of a conductor of index eta + i k relative to outside.
struct RoughConductorBsdf {
    Spectrum eta, k;
    Microfacets facets;
};
/// Microfacets of a dielectric, eta = n_inside / n_outside for the hero lane; `dispersive`: the others end here.
struct RoughDielectricBsdf {
    float eta = 1.5f;
    bool dispersive = false;
    Microfacets facets;
};

inline BsdfTraits traits(RoughConductorBsdf const& b) {
    return {.chooses = b.facets.multiscatter, .near_specular = b.facets.near_specular()};
}
inline BsdfTraits traits(RoughDielectricBsdf const& b) {
    return {.spreads_through = true,
            .chooses = true,
            .hero_only = b.dispersive,
            .near_specular = b.facets.near_specular()};
}
NEPHROID_BSDF(RoughConductorBsdf);
NEPHROID_BSDF(RoughDielectricBsdf);
static_assert(ScatteringModel<RoughConductorBsdf>);
static_assert(ScatteringModel<RoughDielectricBsdf>);

}  // namespace nephroid
