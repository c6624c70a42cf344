// A dielectric coat over a conductor, in closed form.
#pragma once

#include "model/bsdf_sample.h"
#include "model/bsdf_smooth.h"
#include "model/microfacet.h"

namespace nephroid {

/// What CoatedConductorBsdf estimates, without a scattering medium: the coat's reflection and two lobes, one for light that met the
/// base once and one for all that met it more often, scaled so that the albedos are right (bsdf_coated_closed.cpp).
struct ClosedCoatedConductorBsdf {
    Spectrum eta, k;         // of the conductor, relative to the coat
    Microfacets coat, base;  // where both are smooth there is one mirrored direction, and the value is exact
    float coat_eta = 1.5f;   // of the hero lane, relative to outside
    float depth = 0;         // optical depth of the coat along the normal
    std::uint8_t bounces = 5;  // how often light may meet the base
    bool dispersive = false;
};
inline BsdfTraits traits(ClosedCoatedConductorBsdf const& b) {
    return {.delta = b.coat.smooth() && b.base.smooth(),
            .chooses = true,
            .hero_only = b.dispersive,
            .near_specular = b.coat.near_specular() && b.base.near_specular()};
}
NEPHROID_BSDF(ClosedCoatedConductorBsdf);
static_assert(ScatteringModel<ClosedCoatedConductorBsdf>);
DeltaBranches delta_branches(ClosedCoatedConductorBsdf const& b, Vec3 wo, Mode mode);

}  // namespace nephroid
