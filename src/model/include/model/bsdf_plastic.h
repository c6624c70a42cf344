// A diffuse base under a dielectric boundary, in closed form.
#pragma once

#include "model/bsdf_sample.h"
#include "model/bsdf_smooth.h"
#include "model/microfacet.h"

namespace nephroid {

/// f = specular * boundary's reflection + t(wo) t(wi) rho / (eta^2 pi (1 - rho K)): what the boundary lets through, twice, and all
/// turns of light between a Lambertian base and the boundary, which reflects K of diffuse light back (Saunderson 1942).
struct PlasticBsdf {
    Spectrum reflectance, specular;
    float eta = 1.5f;  // of the hero lane
    Microfacets facets;
    bool nonlinear = true;  // false: rho / (1 - K), so that the turns do not change the colour (Mitsuba)
    bool dispersive = false;
    std::uint8_t bounces = 0;  // how often light may meet the base; 0: without end
    float depth = 0;           // optical depth of the layer between, which absorbs, along the normal
};
inline BsdfTraits traits(PlasticBsdf const& b) { return {.chooses = true, .hero_only = b.dispersive}; }
NEPHROID_BSDF(PlasticBsdf);
static_assert(ScatteringModel<PlasticBsdf>);
DeltaBranches delta_branches(PlasticBsdf const& b, Vec3 wo, Mode mode);

}  // namespace nephroid
