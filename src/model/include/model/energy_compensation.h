// Light that one encounter with microfacets shadows goes on to other facets, and leaves as if from a diffuse surface: Kulla & Conty
// 2017, "Revisiting Physically Based Shading at Imageworks". The lobe is reciprocal, and with the single encounters it makes a
// surface that absorbs nothing white. The albedos come from tables: where ax and ay differ those of the isotropic roughness
// sqrt(ax ay) stand in, but for Trowbridge and Reitz's mirrors, which have a table of their own.
#pragma once

#include "model/adjoint.h"
#include "model/microfacet.h"
#include "spectrum/spectrum.h"

namespace nephroid {

/// Of a surface that reflects alone. What each facet absorbs is in `tint`.
struct ReflectionCompensation {
    float lost_o;   // 1 - E(wo): also the share of samples that this lobe deserves
    float average;  // 1 - E_avg
};
ReflectionCompensation reflection_compensation(Microfacets const& m, Vec3 wo);
/// (1 - E(wo)) (1 - E(wi)) / (pi (1 - E_avg)), both on one side.
float evaluate(ReflectionCompensation const& c, Microfacets const& m, Vec3 wi);
/// What is left of the light after a second and all later encounters: F^2 E / (1 - F (1 - E)), E and F averages.
Spectrum compensation_tint(Spectrum f_average, Microfacets const& m);

/// Of a dielectric's boundary, eta = n_below / n_above. It goes to both sides: by average transmittances, less where the other side
/// loses less, as reciprocity demands.
struct DielectricCompensation {
    float eta;
    float lost_o;                // 1 - R - T at wo
    float average_o, average_t;  // 1 - average of R + T, on the side of wo and on the other
    float through;               // part of the lobe that is transmitted
};
DielectricCompensation dielectric_compensation(Microfacets const& m, float eta, Vec3 wo);
float evaluate(DielectricCompensation const& c, Microfacets const& m, Vec3 wo, Vec3 wi, Mode mode);

}  // namespace nephroid
