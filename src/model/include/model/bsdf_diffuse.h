// Lambert's law, and its two-sided relative.
#pragma once

#include "model/bsdf_sample.h"
#include "sampling/warp.h"

namespace nephroid {

/// Lambertian reflection on the side(s) where both directions lie together.
struct DiffuseBsdf {
    Spectrum reflectance;
};
inline BsdfTraits traits(DiffuseBsdf const&) { return {}; }
inline Spectrum evaluate(DiffuseBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    return same_hemisphere(wo, wi) ? b.reflectance * kInvPi : Spectrum{};
}
inline float pdf(DiffuseBsdf const&, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    if (!same_hemisphere(wo, wi)) return 0.0f;
    return how == HemisphereSampling::Cosine ? cosine_hemisphere_pdf(abs_cos_theta(wi))
                                             : kUniformHemispherePdf;
}
std::optional<BsdfSample> sample(DiffuseBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how);
inline Spectrum albedo(DiffuseBsdf const& b, Vec3) { return b.reflectance; }
static_assert(ScatteringModel<DiffuseBsdf>);

/// Lambertian reflection and transmission; the two sum to at most 1.
struct DiffuseTransmissionBsdf {
    Spectrum reflectance, transmittance;
};
inline BsdfTraits traits(DiffuseTransmissionBsdf const&) {
    return {.spreads_through = true, .chooses = true};
}
NEPHROID_BSDF(DiffuseTransmissionBsdf);
static_assert(ScatteringModel<DiffuseTransmissionBsdf>);

}  // namespace nephroid
