// glTF 2.0's metallic-roughness model (Appendix B of the specification) with its KHR extensions transmission,
// volume, ior, specular, clearcoat, sheen, anisotropy and dispersion.
//
//   clearcoat over sheen over mix(dielectric, metal, metallic),
//   the dielectric being specular over mix(diffuse, transmission)
//
// Facets are GGX with alpha = roughness^2, Fresnel's reflectance is Schlick's, as there. The appendix leaves
// open how the parts are put together, and its sample implementation is neither reciprocal nor does it keep
// energy everywhere. Here:
//  - the coat reflects F(v.h) D V (sample: F(n.v) D V, not reciprocal); what is below a coat or sheen of
//    albedo E is multiplied by min(1 - E(n.v), 1 - E(n.l)), as KHR_materials_sheen has it for sheen (sample:
//    coat 1 - F(n.v));
//  - diffuse under specular is (1 - R(v)) (1 - R(l)) / (1 - mean R), R the albedo of the specular part
//    (Kelemen & Szirmay-Kalos 2001; sample: 1 - F(v.h), which makes 1.9 of 1 at grazing angles);
//  - transmission gets 1 - F(v.h) of each facet, as there; F goes by the angle outside the solid, and is 1 at
//    total reflection;
//  - what facets reflect among themselves comes back (Kulla & Conty 2017): of the specular part, and of thin
//    walls and solids with what they transmit, so that a white surface is white within 0.004. Not of
//    anisotropic solids, nor where the index is above 3: they darken (tests: by how much);
//  - base_color multiplies transmitted light once a surface: twice through a solid, once through a thin wall.
//
// Solids (KHR_materials_volume), from inside: the transmitting share of the surface is a dielectric boundary
// and the rest diffuse; coat and sheen are outside and dim what passes by the outer direction. Thin and
// opaque surfaces look the same from both sides. Facets with alpha < 1e-3 are mirrors: delta parts. Sheen has
// alpha >= kSheenAlphaMin.
#pragma once

#include "model/bsdf_sample.h"
#include "model/bsdf_smooth.h"
#include "model/microfacet.h"

namespace nephroid {

struct MetallicRoughnessBsdf {
    Spectrum base_color;
    Spectrum f0{0.04f};  // of the dielectric; its specular factor is in it
    Spectrum sheen_color;
    // The specification weighs what is below by the largest component of a colour, lest it take on the
    // complement. These are the largest of r, g, b, which no path's wavelengths move; a lane that is larger
    // still counts instead.
    float f0_top = 0.04f, sheen_top = 0;
    float f90 = 1;  // of the dielectric: its specular factor
    float metallic = 0, transmission = 0, clearcoat = 0;
    float eta = 1.5f;  // of the solid's inside for the hero lane; 1: light passes unbent
    float sheen_alpha = 1, clearcoat_alpha = 0;
    float axis_x = 1, axis_y = 0;  // where the facets' x axis lies in the shading frame
    Microfacets facets;
    bool solid = false, dispersive = false;

    [[nodiscard]] float transmitting() const { return (1.0f - metallic) * transmission; }
    [[nodiscard]] float diffusing() const { return (1.0f - metallic) * (1.0f - transmission); }
    [[nodiscard]] bool has_sheen() const { return max(sheen_top, sheen_color.max()) > 0.0f; }
    [[nodiscard]] bool has_rough_coat() const { return clearcoat > 0.0f && clearcoat_alpha >= 1e-3f; }
    /// Indices so near that nothing bends, and the facets of the boundary cannot be seen.
    [[nodiscard]] bool unbent() const { return solid && std::abs(eta - 1.0f) < 1e-3f; }
};

inline BsdfTraits traits(MetallicRoughnessBsdf const& b) {
    bool const smooth = b.facets.smooth();
    bool const bare = !(b.diffusing() > 0.0f) && !b.has_sheen();
    return {.delta = smooth && bare && !b.has_rough_coat(),
            .spreads_through = b.transmitting() > 0.0f && !smooth && !b.unbent(),
            .chooses = true,
            .hero_only = b.dispersive,
            .near_specular =
                bare && b.facets.near_specular() && !(b.clearcoat > 0.0f && b.clearcoat_alpha >= 0.1f)};
}
NEPHROID_BSDF(MetallicRoughnessBsdf);
static_assert(ScatteringModel<MetallicRoughnessBsdf>);

DeltaBranches delta_branches(MetallicRoughnessBsdf const& b, Vec3 wo, Mode mode);

/// Index at `lambda` (nm) of a glass of index `ior` at 587.6 nm and Abbe number 20 / dispersion
/// (KHR_materials_dispersion: Cauchy's first two terms); never below 1.
inline float cauchy_index(float ior, float dispersion, float lambda) {
    return max(1.0f, ior + (ior - 1.0f) * dispersion / 20.0f * (523655.0f / sqr(lambda) - 1.5168f));
}

}  // namespace nephroid
