// Rough conductor (PBRT 4th ed., 9.4 with 9.6) and rough dielectric (Walter et al. 2007; PBRT 4th ed., 9.7).
// The normal wm is computed from the pair of directions in one order, whichever is wo: reciprocity then holds to the last bits
// even for lobes that are narrower than the rounding of wm would allow.
#include "make_bsdf.h"
#include "model/fresnel.h"

namespace nephroid {

namespace {

Vec3 upward(Vec3 w) { return w.z < 0.0f ? -w : w; }
Vec3 reflect(Vec3 wo, Vec3 wm) { return 2.0f * dot(wo, wm) * wm - wo; }

/// The normal that mirrors wo to wi, both on one side; upward.
Vec3 half_vector(Vec3 wo, Vec3 wi) { return upward(normalize(wo + wi)); }

/// D G / (4 |cos_o cos_i|), Walter et al. 2007, eq. 20 without F.
float torrance_sparrow(Microfacets const& m, Vec3 wo, Vec3 wi, Vec3 wm) {
    return 0.25f * microfacet_d(m, wm) * microfacet_g_over_cosines(m, wo, wi);
}
/// The density of wi when wm is drawn for wo and mirrors it: dwm / dwi = 1 / (4 wo.wm) (Walter et al. 2007, eq. 14).
float reflection_pdf(Microfacets const& m, Vec3 wo, Vec3 wm) {
    float const seen = abs_dot(wo, wm);
    return seen > 0.0f ? microfacet_pdf(m, wo, wm) / (4.0f * seen) : 0.0f;
}

/// What a refracting pair of directions has: Walter et al. 2007, eq. 16, n_o wo + n_i wi, with n = 1 above and eta below.
struct Refraction {
    bool possible = false;
    Vec3 wm;
    float above = 0, below = 0;  // |cosines| with wm
    float length2 = 0;           // |n_o wo + n_i wi|^2 = (n_o wo.wm + n_i wi.wm)^2
};
Refraction refraction(float eta, Vec3 wo, Vec3 wi) {
    Vec3 const up = wo.z > 0.0f ? wo : wi, down = wo.z > 0.0f ? wi : wo;
    Vec3 const h = up + eta * down;
    Refraction r;
    r.length2 = length_squared(h);
    if (!(r.length2 > 0.0f)) return r;
    r.wm = upward(h / std::sqrt(r.length2));
    r.above = dot(up, r.wm);
    r.below = -dot(down, r.wm);
    // No light from behind a facet.
    r.possible = r.above > 0.0f && r.below > 0.0f;
    return r;
}

}  // namespace

// --- conductor ------------------------------------------------------------------------------------------------------------
Spectrum evaluate(RoughConductorBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    if (!same_hemisphere(wo, wi)) return {};
    Vec3 const wm = half_vector(wo, wi);
    return fresnel_conductor(abs_dot(wo, wm), b.eta, b.k) * torrance_sparrow(b.facets, wo, wi, wm);
}

float pdf(RoughConductorBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (!same_hemisphere(wo, wi)) return 0.0f;
    return reflection_pdf(b.facets, wo, half_vector(wo, wi));
}

std::optional<BsdfSample> sample(RoughConductorBsdf const& b, Vec3 wo, float, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    Vec3 const wi = reflect(wo, sample_microfacet(b.facets, wo, u));
    float const density = pdf(b, wo, wi, how);  // 0 below the horizon
    if (!(density > 0.0f)) return result;
    BsdfSample& s = result.emplace();
    s.wi = wi;
    s.pdf = density;
    s.f = evaluate(b, wo, wi, mode);
    return result;
}

Spectrum albedo(RoughConductorBsdf const& b, Vec3 wo) {
    return fresnel_conductor(abs_cos_theta(wo), b.eta, b.k);
}

// --- dielectric -----------------------------------------------------------------------------------------------------------
Spectrum evaluate(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi, Mode mode) {
    if (wo.z == 0.0f || wi.z == 0.0f) return {};
    if (same_hemisphere(wo, wi)) {
        Vec3 const wm = half_vector(wo, wi);
        return Spectrum(fresnel_dielectric(std::copysign(dot(wo, wm), wo.z), b.eta) *
                        torrance_sparrow(b.facets, wo, wi, wm));
    }
    Refraction const r = refraction(b.eta, wo, wi);
    if (!r.possible) return {};
    // Walter et al. 2007, eq. 21: with n_i^2 for importance, n_o^2 for radiance.
    float const n_i = wi.z > 0.0f ? 1.0f : b.eta, n_o = wi.z > 0.0f ? b.eta : 1.0f;
    float const f = (1.0f - fresnel_dielectric(r.above, b.eta)) * microfacet_d(b.facets, r.wm) * r.above *
                    r.below * microfacet_g_over_cosines(b.facets, wo, wi) / r.length2;
    return Spectrum(f * sqr(n_i) * refraction_scale(mode, n_i / n_o));
}

float pdf(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (wo.z == 0.0f || wi.z == 0.0f) return 0.0f;
    if (same_hemisphere(wo, wi)) {
        Vec3 const wm = half_vector(wo, wi);
        return fresnel_dielectric(std::copysign(dot(wo, wm), wo.z), b.eta) * reflection_pdf(b.facets, wo, wm);
    }
    Refraction const r = refraction(b.eta, wo, wi);
    if (!r.possible) return 0.0f;
    // dwm / dwi = n_i^2 |wi.wm| / (n_o wo.wm + n_i wi.wm)^2, Walter et al. 2007, eq. 17.
    float const n_i = wi.z > 0.0f ? 1.0f : b.eta, cos_i = wi.z > 0.0f ? r.above : r.below;
    return (1.0f - fresnel_dielectric(r.above, b.eta)) * microfacet_pdf(b.facets, wo, r.wm) * sqr(n_i) *
           cos_i / r.length2;
}

std::optional<BsdfSample> sample(RoughDielectricBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    if (b.eta == 1.0f) {  // nothing bends, however rough; of a dispersive glass's hero
        BsdfSample& s = result.emplace();
        s.wi = -wo;
        s.f = Spectrum(1.0f / abs_cos_theta(wo));
        s.pdf = 1.0f;
        s.delta = s.transmitted = true;
        return result;
    }
    Vec3 const wm = sample_microfacet(b.facets, wo, u);
    float const cos_o = std::copysign(abs_dot(wo, wm), wo.z);
    bool const reflected = uc < fresnel_dielectric(cos_o, b.eta);
    float const relative = wo.z > 0.0f ? b.eta : 1.0f / b.eta;
    Vec3 wi;
    if (reflected) {
        wi = reflect(wo, wm);
    } else {
        // Snell's law about wm: wi = -wo / eta + (|wo.wm| / eta - cos_t) n, n being wm on wo's side.
        float const sin2_t = max(0.0f, 1.0f - sqr(cos_o)) / sqr(relative);
        if (sin2_t >= 1.0f) return result;
        float const c = std::abs(cos_o) / relative - std::sqrt(1.0f - sin2_t);
        wi = normalize(wo * (-1.0f / relative) + wm * (wo.z > 0.0f ? c : -c));
    }
    if (same_hemisphere(wo, wi) != reflected) return result;
    float const density = pdf(b, wo, wi, how);
    if (!(density > 0.0f)) return result;
    BsdfSample& s = result.emplace();
    s.wi = wi;
    s.pdf = density;
    s.f = evaluate(b, wo, wi, mode);
    s.transmitted = !reflected;
    if (!reflected) s.eta = relative;
    return result;
}

Spectrum albedo(RoughDielectricBsdf const&, Vec3) { return Spectrum(1.0f); }

}  // namespace nephroid
