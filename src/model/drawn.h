// What the models that draw from their densities share.
#pragma once

#include "model/bsdf_sample.h"
#include "sampling/warp.h"

namespace nephroid {

/// A direction about +z, as diffuse parts draw it.
inline Vec3 square_to_hemisphere(Vec2 u, HemisphereSampling how) {
    return how == HemisphereSampling::Cosine ? square_to_cosine_hemisphere(u)
                                             : square_to_uniform_hemisphere(u);
}

/// Fills `result`, where the caller wants it, with a direction that was drawn by pdf(b, …) and its value; leaves it empty where
/// there is no density.
template <class B>
void complete(std::optional<BsdfSample>& result, B const& b, Vec3 wo, Vec3 wi, Mode mode,
              HemisphereSampling how) {
    float const density = pdf(b, wo, wi, how);
    if (!(density > 0.0f)) return;
    BsdfSample& s = result.emplace();
    s.wi = wi;
    s.pdf = density;
    s.f = evaluate(b, wo, wi, mode);
}

}  // namespace nephroid
