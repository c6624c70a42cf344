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
/// By the cosines of both directions, without a branch: lanes use it as well.
inline float diffuse_pdf(float cos_wo, float cos_wi) {
    float const density = cosine_hemisphere_pdf(std::abs(cos_wi));
    return cos_wo * cos_wi > 0.0f ? density : 0.0f;
}
inline float pdf(DiffuseBsdf const&, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    if (how == HemisphereSampling::Cosine) return diffuse_pdf(cos_theta(wo), cos_theta(wi));
    return same_hemisphere(wo, wi) ? kUniformHemispherePdf : 0.0f;
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
