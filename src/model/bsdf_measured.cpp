// Measured reflection, as its tables have it (measured_tables.h), on either side of the surface.
//
// The tables are f(k, l), k being the direction that measuring started from, and only nearly f(l, k). So that radiance and
// importance still carry the same light, k is always the direction towards the camera: wo for radiance, wi for importance. Then
// evaluate(wo, wi, Importance) is evaluate(wi, wo, Radiance) to the last bit, and each scene has one answer.
#include "make_bsdf.h"
#include "measured_tables.h"

namespace nephroid {

namespace {

/// Seen from below the surface is what it is from above, turned over about its centre (pbrt-v4).
bool turn_up(Vec3& wo, Vec3& wi) {
    if (!same_hemisphere(wo, wi)) return false;
    if (wo.z < 0.0f) {
        wo = -wo;
        wi = -wi;
    }
    return true;
}

}  // namespace

Spectrum evaluate(MeasuredBsdf const& b, Vec3 wo, Vec3 wi, Mode mode) {
    if (!turn_up(wo, wi)) return {};
    if (mode == Mode::Importance) std::swap(wo, wi);
    return b.tables->evaluate(wo, wi, b.lambda, true, false).f;
}

float pdf(MeasuredBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (!turn_up(wo, wi)) return 0.0f;
    return b.tables->evaluate(wo, wi, b.lambda, false, true).pdf;
}

std::optional<BsdfSample> sample(MeasuredBsdf const& b, Vec3 wo, float, Vec2 u, Mode mode,
                                 HemisphereSampling) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    Vec3 const up = wo.z < 0.0f ? -wo : wo;
    auto const wi = b.tables->sample(up, u);
    if (!wi) return result;
    // From the direction as it was rounded, as pdf() and evaluate() will see it.
    bool const radiance = mode == Mode::Radiance;
    auto const v = b.tables->evaluate(up, *wi, b.lambda, radiance, true);
    if (!(v.pdf > 0.0f)) return result;
    BsdfSample& s = result.emplace();
    s.wi = wo.z < 0.0f ? -*wi : *wi;
    s.pdf = v.pdf;
    s.f = radiance ? v.f : b.tables->evaluate(*wi, up, b.lambda, true, false).f;
    return result;
}

Spectrum albedo(MeasuredBsdf const& b, Vec3 wo) { return b.tables->albedo(wo.z < 0.0f ? -wo : wo, b.lambda); }

void make(MeasuredMaterial const&, MaterialPoint const& p, Bsdf& bsdf) {
    bsdf.emplace<MeasuredBsdf>(MeasuredBsdf{p.data().measured.get(), p.lambda});
}

}  // namespace nephroid
