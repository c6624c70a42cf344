// A diffuse base under a dielectric boundary, in closed form.
#pragma once

#include "model/bsdf_sample.h"
#include "model/microfacet.h"

namespace nephroid {

struct PlasticBsdf {
    Spectrum reflectance, specular;
    float eta = 1.5f;  // of the hero lane
    Microfacets facets;
    bool nonlinear = true;
    bool dispersive = false;
};
inline BsdfTraits traits(PlasticBsdf const& b) { return {.chooses = true, .hero_only = b.dispersive}; }
NEPHROID_BSDF(PlasticBsdf);
static_assert(ScatteringModel<PlasticBsdf>);

}  // namespace nephroid
