// Ashikhmin & Shirley 2000, "An Anisotropic Phong BRDF Model".
#pragma once

#include "model/bsdf_sample.h"

namespace nephroid {

struct AshikhminShirleyBsdf {
    Spectrum reflectance, specular;  // R_d, R_s
    float nu = 100, nv = 100;        // exponents along x and y
};
inline BsdfTraits traits(AshikhminShirleyBsdf const&) { return {.chooses = true}; }
NEPHROID_BSDF(AshikhminShirleyBsdf);
static_assert(ScatteringModel<AshikhminShirleyBsdf>);

}  // namespace nephroid
