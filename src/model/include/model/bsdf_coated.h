// A dielectric coat over a diffuse or conducting base.
#pragma once

#include "model/bsdf_sample.h"
#include "model/bsdf_smooth.h"
#include "model/microfacet.h"

namespace nephroid {

/// The coat of a layered surface, at one point.
struct CoatLayer {
    Spectrum albedo;   // of the medium inside; black = none
    float eta = 1.5f;  // of the hero lane, relative to outside
    float thickness = 0.01f;
    float g = 0;
    Microfacets facets;
    std::uint8_t max_depth = 10, samples = 1;
    bool dispersive = false;
};
/// Random walks between the layers (Guo et al. 2018; PBRT 4th ed., 14.3). The value is an estimate: a fixed function of
/// (wo, wi, seed) whose mean over seeds is f.
struct CoatedDiffuseBsdf {
    CoatLayer coat;
    Spectrum reflectance;
    std::uint32_t seed = 0;
};
struct CoatedConductorBsdf {
    CoatLayer coat;
    Spectrum eta, k;  // relative to the coat
    Microfacets facets;
    std::uint32_t seed = 0;
};

inline BsdfTraits traits(CoatedDiffuseBsdf const& b) {
    return {.chooses = true, .hero_only = b.coat.dispersive};
}
inline BsdfTraits traits(CoatedConductorBsdf const& b) {
    return {.delta = b.facets.smooth() && b.coat.facets.smooth() && b.coat.albedo.is_black(),
            .chooses = true,
            .hero_only = b.coat.dispersive,
            .near_specular =
                b.facets.near_specular() && b.coat.facets.near_specular() && b.coat.albedo.is_black()};
}
NEPHROID_BSDF(CoatedDiffuseBsdf);
NEPHROID_BSDF(CoatedConductorBsdf);
static_assert(ScatteringModel<CoatedDiffuseBsdf>);
static_assert(ScatteringModel<CoatedConductorBsdf>);
DeltaBranches delta_branches(CoatedDiffuseBsdf const& b, Vec3 wo, Mode mode);
DeltaBranches delta_branches(CoatedConductorBsdf const& b, Vec3 wo, Mode mode);

}  // namespace nephroid
