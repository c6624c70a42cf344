// Rough conductor (PBRT 4th ed., 9.4 with 9.6) and rough dielectric (Walter et al. 2007; PBRT 4th ed., 9.7).
// The normal wm is computed from the pair of directions in one order, whichever is wo: reciprocity then holds to the last bits
// even for lobes that are narrower than the rounding of wm would allow.
// With energy compensation a cosine lobe joins them, chosen as often as it is bright: see model/energy_compensation.h.
#include "drawn.h"
#include "make_bsdf.h"
#include "model/energy_compensation.h"
#include "model/fresnel.h"
#include "model/microfacet_albedo.h"
#include "sampling/warp.h"

namespace nephroid {

namespace {

Vec3 upward(Vec3 w) { return w.z < 0.0f ? -w : w; }
Vec3 reflect(Vec3 wo, Vec3 wm) { return 2.0f * dot(wo, wm) * wm - wo; }

/// The normal that mirrors wo to wi, both on one side, upward; and the cosine that both have with it, by the length of their
/// sum so that it is the same for both. 0 where they are opposite.
struct Reflection {
    Vec3 wm;
    float cosine;
};
Reflection reflection(Vec3 wo, Vec3 wi) {
    Vec3 const h = wo + wi;
    float const l = length(h);
    return {l > 0.0f ? upward(h / l) : Vec3{0, 0, 0}, 0.5f * l};
}

/// D G / (4 |cos_o cos_i|), Walter et al. 2007, eq. 20 without F.
float torrance_sparrow(Microfacets const& m, Vec3 wo, Vec3 wi, Vec3 wm) {
    return 0.25f * microfacet_d(m, wm) * microfacet_g_over_cosines(m, wo, wi);
}
/// The density of wi when wm is drawn for wo and mirrors it: dwm / dwi = 1 / (4 wo.wm) (Walter et al. 2007, eq. 14).
float reflection_pdf(Microfacets const& m, Vec3 wo, Reflection const& r) {
    return r.cosine > 0.0f ? microfacet_pdf(m, wo, r.wm) / (4.0f * r.cosine) : 0.0f;
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
namespace {

/// 2 integral F mu dmu by Gauss' rule in mu^2, 3 points: within 0.003.
Spectrum average_fresnel(RoughConductorBsdf const& b) {
    return (5.0f * fresnel_conductor(0.33571069f, b.eta, b.k) +
            8.0f * fresnel_conductor(0.70710678f, b.eta, b.k) +
            5.0f * fresnel_conductor(0.94196515f, b.eta, b.k)) /
           18.0f;
}

/// Single encounters: Torrance-Sparrow.
Spectrum single(RoughConductorBsdf const& b, Vec3 wo, Vec3 wi) {
    auto const [wm, cosine] = reflection(wo, wi);
    return fresnel_conductor(cosine, b.eta, b.k) * torrance_sparrow(b.facets, wo, wi, wm);
}

}  // namespace

Spectrum evaluate(RoughConductorBsdf const& b, Vec3 wo, Vec3 wi, Mode) {
    if (!same_hemisphere(wo, wi)) return {};
    if (!b.facets.multiscatter) return single(b, wo, wi);
    float const lobe = evaluate(reflection_compensation(b.facets, wo), b.facets, wi);
    return single(b, wo, wi) + compensation_tint(average_fresnel(b), b.facets) * lobe;
}

float pdf(RoughConductorBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (!same_hemisphere(wo, wi)) return 0.0f;
    float const density = reflection_pdf(b.facets, wo, reflection(wo, wi));
    if (!b.facets.multiscatter) return density;
    return lerp(reflection_compensation(b.facets, wo).lost_o, density,
                cosine_hemisphere_pdf(abs_cos_theta(wi)));
}

std::optional<BsdfSample> sample(RoughConductorBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    Vec3 wi;
    if (b.facets.multiscatter && uc < reflection_compensation(b.facets, wo).lost_o) {
        wi = square_to_cosine_hemisphere(u);
        wi.z = std::copysign(wi.z, wo.z);
    } else {
        wi = reflect(wo, sample_microfacet(b.facets, wo, u));
    }
    complete(result, b, wo, wi, mode, how);  // nothing below the horizon
    return result;
}

Spectrum albedo(RoughConductorBsdf const& b, Vec3 wo) {
    // What a perfect mirror of each facet reflects, times Fresnel's mean over four of the normals that wo sees.
    Spectrum f;
    for (Vec2 const u : {Vec2{0.125f, 0.125f}, {0.375f, 0.625f}, {0.625f, 0.375f}, {0.875f, 0.875f}})
        f += 0.25f * fresnel_conductor(abs_dot(wo, sample_microfacet(b.facets, wo, u)), b.eta, b.k);
    float const alpha = std::sqrt(b.facets.ax * b.facets.ay);
    f *= microfacet_albedo(b.facets.kind, abs_cos_theta(wo), alpha);
    if (b.facets.multiscatter)
        f += reflection_compensation(b.facets, wo).lost_o * compensation_tint(average_fresnel(b), b.facets);
    return clamp(f, 0.0f, 1.0f);
}

// --- dielectric -----------------------------------------------------------------------------------------------------------
namespace {

float single(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi, Mode mode) {
    if (same_hemisphere(wo, wi)) {
        auto const [wm, cosine] = reflection(wo, wi);
        return fresnel_dielectric(std::copysign(cosine, wo.z), b.eta) *
               torrance_sparrow(b.facets, wo, wi, wm);
    }
    Refraction const r = refraction(b.eta, wo, wi);
    if (!r.possible) return 0.0f;
    // Walter et al. 2007, eq. 21: with n_i^2 for importance, n_o^2 for radiance.
    float const n_i = wi.z > 0.0f ? 1.0f : b.eta, n_o = wi.z > 0.0f ? b.eta : 1.0f;
    float const f = (1.0f - fresnel_dielectric(r.above, b.eta)) * microfacet_d(b.facets, r.wm) * r.above *
                    r.below * microfacet_g_over_cosines(b.facets, wo, wi) / r.length2;
    return f * sqr(n_i) * refraction_scale(mode, n_i / n_o);
}

float single_pdf(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi) {
    if (same_hemisphere(wo, wi)) {
        Reflection const r = reflection(wo, wi);
        return fresnel_dielectric(std::copysign(r.cosine, wo.z), b.eta) * reflection_pdf(b.facets, wo, r);
    }
    Refraction const r = refraction(b.eta, wo, wi);
    if (!r.possible) return 0.0f;
    // dwm / dwi = n_i^2 |wi.wm| / (n_o wo.wm + n_i wi.wm)^2, Walter et al. 2007, eq. 17.
    float const n_i = wi.z > 0.0f ? 1.0f : b.eta, cos_i = wi.z > 0.0f ? r.above : r.below;
    return (1.0f - fresnel_dielectric(r.above, b.eta)) * microfacet_pdf(b.facets, wo, r.wm) * sqr(n_i) *
           cos_i / r.length2;
}

/// Reflects about a normal or refracts through it, as Fresnel's equation and uc say; nothing where that leads to the wrong side.
std::optional<Vec3> sample_single(RoughDielectricBsdf const& b, Vec3 wo, float uc, Vec2 u) {
    Vec3 const wm = sample_microfacet(b.facets, wo, u);
    float const cosine = abs_dot(wo, wm);
    if (uc < fresnel_dielectric(std::copysign(cosine, wo.z), b.eta)) {
        Vec3 const wi = reflect(wo, wm);
        return same_hemisphere(wo, wi) ? std::optional(wi) : std::nullopt;
    }
    // Snell's law about wm: wi = -wo / eta + (|wo.wm| / eta - cos_t) n, n being wm on wo's side.
    float const relative = wo.z > 0.0f ? b.eta : 1.0f / b.eta;
    float const sin2_t = max(0.0f, 1.0f - sqr(cosine)) / sqr(relative);
    if (sin2_t >= 1.0f) return std::nullopt;
    float const c = cosine / relative - std::sqrt(1.0f - sin2_t);
    Vec3 const wi = normalize(wo * (-1.0f / relative) + wm * (wo.z > 0.0f ? c : -c));
    return same_hemisphere(wo, wi) ? std::nullopt : std::optional(wi);
}

}  // namespace

Spectrum evaluate(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi, Mode mode) {
    if (wo.z == 0.0f || wi.z == 0.0f || b.eta == 1.0f) return {};
    float f = single(b, wo, wi, mode);
    if (b.facets.multiscatter)
        f += evaluate(dielectric_compensation(b.facets, b.eta, wo), b.facets, wo, wi, mode);
    return Spectrum(f);
}

float pdf(RoughDielectricBsdf const& b, Vec3 wo, Vec3 wi, HemisphereSampling) {
    if (wo.z == 0.0f || wi.z == 0.0f || b.eta == 1.0f) return 0.0f;
    float const density = single_pdf(b, wo, wi);
    if (!b.facets.multiscatter) return density;
    auto const c = dielectric_compensation(b.facets, b.eta, wo);
    float const side = same_hemisphere(wo, wi) ? 1.0f - c.through : c.through;
    return lerp(c.lost_o, density, side * cosine_hemisphere_pdf(abs_cos_theta(wi)));
}

std::optional<BsdfSample> sample(RoughDielectricBsdf const& b, Vec3 wo, float uc, Vec2 u, Mode mode,
                                 HemisphereSampling how) {
    std::optional<BsdfSample> result;
    if (wo.z == 0.0f) return result;
    if (b.eta ==
        1.0f) {  // nothing bends, however rough: the hero of a dispersive glass may have such an index
        BsdfSample& s = result.emplace();
        s.wi = -wo;
        s.f = Spectrum(1.0f / abs_cos_theta(wo));
        s.pdf = 1.0f;
        s.delta = s.transmitted = true;
        return result;
    }
    std::optional<Vec3> wi;
    float lost = 0.0f;
    if (b.facets.multiscatter) {
        auto const c = dielectric_compensation(b.facets, b.eta, wo);
        lost = c.lost_o;
        if (uc < lost) {
            wi = square_to_cosine_hemisphere(u);
            wi->z = std::copysign(wi->z, uc < lost * c.through ? -wo.z : wo.z);
        }
    }
    if (!wi) wi = sample_single(b, wo, min((uc - lost) / (1.0f - lost), kOneMinusEpsilon), u);
    if (!wi) return result;
    float const density = pdf(b, wo, *wi, how);
    if (!(density > 0.0f)) return result;
    BsdfSample& s = result.emplace();
    s.wi = *wi;
    s.pdf = density;
    s.f = evaluate(b, wo, *wi, mode);
    s.transmitted = !same_hemisphere(wo, *wi);
    if (s.transmitted) s.eta = wo.z > 0.0f ? b.eta : 1.0f / b.eta;
    return result;
}

Spectrum albedo(RoughDielectricBsdf const& b, Vec3 wo) {
    if (b.facets.multiscatter || b.eta == 1.0f) return Spectrum(1.0f);
    float const alpha = std::sqrt(b.facets.ax * b.facets.ay), mu = abs_cos_theta(wo);
    float const relative = wo.z > 0.0f ? b.eta : 1.0f / b.eta;
    return Spectrum(min(1.0f, dielectric_reflection_albedo(b.facets.kind, mu, alpha, relative) +
                                  dielectric_transmission_albedo(b.facets.kind, mu, alpha, relative)));
}

}  // namespace nephroid
