// Schlick's Fresnel reflectance F = f0 + (f90 - f0) (1 - c)^5 (Schlick 1994), on mirrors and on microfacets.
// F is linear in f0 and f90, and so are the albedos: two numbers per direction serve all colours ("split
// sum", Karis 2013).
#pragma once

#include "model/microfacet.h"
#include "spectrum/spectrum.h"

namespace nephroid {

/// (1 - c)^5.
inline float schlick_weight(float c) {
    float const x = clamp(1.0f - c, 0.0f, 1.0f);
    return sqr(sqr(x)) * x;
}
inline Spectrum schlick(Spectrum f0, Spectrum f90, float weight) { return f0 + (f90 - f0) * weight; }
inline float schlick(float f0, float f90, float weight) { return f0 + (f90 - f0) * weight; }

/// Albedo of GGX microfacets with one reflection, where F is 1 (`one`) and where F is (1 - c)^5 (`edge`).
struct SchlickAlbedo {
    float one = 1, edge = 0;
    /// Of any f0 and f90 (float or Spectrum).
    template <class S>
    [[nodiscard]] S of(S f0, S f90) const {
        return f0 * (one - edge) + f90 * edge;
    }
};

/// Of isotropic facets, from a direction of cosine mu > 0: within 0.004 (tests). A mirror where
/// alpha < 1e-3.
SchlickAlbedo schlick_albedo(float mu, float alpha);
/// Of facets from w above, ax >= ay: within 0.015 (tests).
SchlickAlbedo schlick_albedo(Microfacets const& m, Vec3 w);
/// Cosine-weighted mean of it over the hemisphere.
SchlickAlbedo schlick_mean(Microfacets const& m);

/// Boundary of a solid of isotropic facets, index > 1: what one reflection or refraction loses of light from
/// a direction of cosine mu, outside or inside, and its cosine-weighted mean; within 0.01 (tests). F as in
/// schlick(), by the angle outside.
struct SolidBoundary {
    float alpha, index, f0, f90;
    [[nodiscard]] float lost(float mu, bool inside) const;
    [[nodiscard]] float lost_mean(bool inside) const;
    /// Greater indices have no table.
    [[nodiscard]] bool known() const;
};

/// What light that was reflected more than once between the facets has left, of the part that one reflection
/// loses (Kulla & Conty 2017, slide 20; Fdez-Aguera 2019 has the same series): F^2 E / (1 - F (1 - E)), F and
/// E means over the hemisphere.
inline Spectrum multiscatter_fresnel(Spectrum f_mean, float e_mean) {
    return f_mean * f_mean * e_mean / (Spectrum(1.0f) - f_mean * (1.0f - e_mean));
}

}  // namespace nephroid
