// Lambert's law on both sides of a thin sheet, paper or a leaf (PBRT 4th ed., 9.2): f = R / pi where wo and wi lie together,
// T / pi where they do not. The same from either side, and for radiance and importance: nothing refracts.
#include "drawn.h"
#include "make_bsdf.h"
#include "sampling/warp.h"

namespace nephroid {

namespace {

/// The chance that reflection is drawn: by the lanes' largest values, as in pbrt-v4. 0 / 0 where the sheet is black.
float reflection_chance(DiffuseTransmissionBsdf const& b) {
    float const r = b.reflectance.max();
    float const t = b.transmittance.max();
    return r + t > 0.0f ? r / (r + t) : 0.0f;
}

float hemisphere_pdf(float cos_t, HemisphereSampling how) {
    return how == HemisphereSampling::Cosine ? cosine_hemisphere_pdf(cos_t) : kUniformHemispherePdf;
}

}  // namespace

Spectrum evaluate(DiffuseTransmissionBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    float const side = wo.z * wi.z;
    if (side > 0.0f) return b.reflectance * kInvPi;
    return side < 0.0f ? b.transmittance * kInvPi : Spectrum{};
}

float pdf(DiffuseTransmissionBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling how) {
    float const side = wo.z * wi.z;
    if (side == 0.0f || (b.reflectance + b.transmittance).is_black()) return 0.0f;
    float const chance = reflection_chance(b);
    return (side > 0.0f ? chance : 1.0f - chance) * hemisphere_pdf(abs_cos_theta(wi), how);
}

std::optional<BsdfSample> sample(DiffuseTransmissionBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    bool const through = !(uc < reflection_chance(b));
    Vec3 wi = square_to_hemisphere(u, how);
    if ((wo.z < 0.0f) != through) wi.z = -wi.z;
    complete(result, b, wo, wi, mode, how);
    if (result) result->transmitted = through;
    return result;
}

Spectrum albedo(DiffuseTransmissionBsdf const& b, Vec3) { return b.reflectance + b.transmittance; }

/// pbrt-v4 scales and clamps each to [0, 1] and lets them add up to 2. Here a lane whose sum is above 1 has both divided by it:
/// what a sheet makes out of light keeps its two colours, and a path between two sheets ends.
void make(DiffuseTransmissionMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    Spectrum r = clamp(m.scale * p.spectrum(m.reflectance, {}), 0.0f, 1.0f);
    Spectrum t = clamp(m.scale * p.spectrum(m.transmittance, {}), 0.0f, 1.0f);
    for (int i = 0; i < 4; ++i) {
        float const sum = r[i] + t[i];
        if (!(sum > 1.0f)) continue;
        r.set(i, r[i] / sum);
        t.set(i, t[i] / sum);
    }
    bsdf.emplace<DiffuseTransmissionBsdf>(DiffuseTransmissionBsdf{r, t});
}

}  // namespace nephroid
