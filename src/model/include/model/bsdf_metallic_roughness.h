// glTF 2.0's metallic-roughness model with its KHR extensions.
#pragma once

#include "model/bsdf_sample.h"
#include "model/microfacet.h"

namespace nephroid {

struct MetallicRoughnessBsdf {
    Spectrum base_color, specular_color, sheen_color;
    float metallic = 1, specular = 1, transmission = 0, clearcoat = 0;
    float eta = 1.5f;  // of the hero lane
    float sheen_alpha = 0, clearcoat_alpha = 0;
    Microfacets facets;
    float rotation = 0;  // of the facets' axes about the normal, radians
    bool thin = true, dispersive = false;
};
inline BsdfTraits traits(MetallicRoughnessBsdf const& b) {
    return {.spreads_through = b.transmission > 0.0f, .chooses = true, .hero_only = b.dispersive};
}
NEPHROID_BSDF(MetallicRoughnessBsdf);
static_assert(ScatteringModel<MetallicRoughnessBsdf>);

}  // namespace nephroid
