// Smooth boundaries: nothing but delta parts.
#pragma once

#include "model/bsdf_sample.h"

namespace nephroid {

/// Smooth dielectric boundary, eta = n_inside / n_outside; lanes differ where it is dispersive.
struct DielectricBsdf {
    Spectrum eta;
    bool dispersive = false;
};
struct ThinDielectricBsdf {
    Spectrum eta;
};
/// Smooth conductor, eta + i k relative to outside.
struct ConductorBsdf {
    Spectrum eta, k;
};

inline BsdfTraits traits(DielectricBsdf const&) {
    return {.delta = true, .chooses = true, .near_specular = true};
}
inline BsdfTraits traits(ThinDielectricBsdf const&) {
    return {.delta = true, .chooses = true, .near_specular = true};
}
inline BsdfTraits traits(ConductorBsdf const&) { return {.delta = true, .near_specular = true}; }
#define NEPHROID_DELTA_BSDF(B)                                                         \
    inline Spectrum evaluate(B const&, Vec3, Vec3, Mode) { return {}; }                \
    inline float pdf(B const&, Vec3, Vec3, HemisphereSampling) { return 0.0f; }        \
    std::optional<BsdfSample> sample(B const& b, Vec3 wo, float uc, Vec2 u, Mode mode, \
                                     HemisphereSampling how);                          \
    Spectrum albedo(B const& b, Vec3 wo)
NEPHROID_DELTA_BSDF(DielectricBsdf);
NEPHROID_DELTA_BSDF(ThinDielectricBsdf);
NEPHROID_DELTA_BSDF(ConductorBsdf);
#undef NEPHROID_DELTA_BSDF
static_assert(ScatteringModel<DielectricBsdf>);
static_assert(ScatteringModel<ThinDielectricBsdf>);
static_assert(ScatteringModel<ConductorBsdf>);

/// The deterministic branches of smooth parts, for Whitted's tree; pdf = 1 each.
struct DeltaBranches {
    std::optional<BsdfSample> reflected, transmitted;
};
/// A mirror that reflects so much of each lane, and nothing beside it.
inline DeltaBranches mirror_branch(Spectrum reflectance, Vec3 wo) {
    if (wo.z == 0.0f) return {};
    DeltaBranches d;
    BsdfSample& s = d.reflected.emplace();
    s.wi = {-wo.x, -wo.y, wo.z};
    s.f = reflectance / abs_cos_theta(wo);
    s.pdf = 1.0f;
    s.delta = true;
    return d;
}
DeltaBranches delta_branches(DielectricBsdf const& b, Vec3 wo, Mode mode);
DeltaBranches delta_branches(ThinDielectricBsdf const& b, Vec3 wo, Mode mode);
DeltaBranches delta_branches(ConductorBsdf const& b, Vec3 wo, Mode mode);

}  // namespace nephroid
