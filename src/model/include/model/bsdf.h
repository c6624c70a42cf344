// Scattering at a point: a small value, one of the models below. What they share is said in model/bsdf_sample.h.
#pragma once

#include "model/bsdf_ashikhmin_shirley.h"
#include "model/bsdf_coated.h"
#include "model/bsdf_coated_closed.h"
#include "model/bsdf_diffuse.h"
#include "model/bsdf_measured.h"
#include "model/bsdf_metallic_roughness.h"
#include "model/bsdf_microfacet.h"
#include "model/bsdf_plastic.h"
#include "model/bsdf_smooth.h"

#include <variant>

namespace nephroid {

using Bsdf = std::variant<DiffuseBsdf, DielectricBsdf, ThinDielectricBsdf, ConductorBsdf, RoughConductorBsdf,
                          RoughDielectricBsdf, DiffuseTransmissionBsdf, CoatedDiffuseBsdf,
                          CoatedConductorBsdf, ClosedCoatedConductorBsdf, PlasticBsdf, AshikhminShirleyBsdf,
                          MeasuredBsdf, MetallicRoughnessBsdf>;
static_assert(sizeof(Bsdf) <= 144, "a Bsdf is made at every hit, in place: keep it small");

inline BsdfTraits traits(Bsdf const& bsdf) {
    return match(bsdf, [](auto const& b) { return traits(b); });
}
/// Nothing but delta parts: no light can be sampled towards.
inline bool is_delta(Bsdf const& bsdf) { return traits(bsdf).delta; }

inline Spectrum evaluate(Bsdf const& bsdf, Vec3 wo, Vec3 wi, Mode mode) {
    return match(bsdf, [&](auto const& b) { return evaluate(b, wo, wi, mode); });
}
inline float pdf(Bsdf const& bsdf, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    return match(bsdf, [&](auto const& b) { return pdf(b, wo, wi, how); });
}
/// uc chooses among parts, u a direction. Nothing where no light is scattered.
inline std::optional<BsdfSample> sample(Bsdf const& bsdf, Vec3 wo, float uc, Vec2 u, Mode mode,
                                        HemisphereSampling how) {
    return match(bsdf, [&](auto const& b) { return sample(b, wo, uc, u, mode, how); });
}
/// Directional albedo: what part of light from wo is scattered at all.
inline Spectrum albedo(Bsdf const& bsdf, Vec3 wo) {
    return match(bsdf, [&](auto const& b) { return albedo(b, wo); });
}
/// The deterministic branches of its smooth parts, for Whitted's tree. (A template, lest a model without any turn into a sum.)
template <std::same_as<Bsdf> Sum>
DeltaBranches delta_branches(Sum const& bsdf, Vec3 wo, Mode mode) {
    return match(bsdf, [&](auto const& b) {
        if constexpr (requires { delta_branches(b, wo, mode); })
            return delta_branches(b, wo, mode);
        else
            return DeltaBranches{};
    });
}

}  // namespace nephroid
