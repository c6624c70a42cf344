// Smooth boundaries: dielectric (PBRT 4th ed., 9.5), thin dielectric (9.5.1), conductor (9.4).
// Nothing but delta parts: a direction is either the mirrored or the refracted one.
#include "make_bsdf.h"
#include "model/fresnel.h"

namespace nephroid {

namespace {

Vec3 mirrored(Vec3 wo) { return {-wo.x, -wo.y, wo.z}; }

/// Reflected part: f = R / |cos|. Its direction is the same for every wavelength, so all lanes go on, each with its own R.
BsdfSample reflection(Spectrum reflectance, Vec3 wo, float probability) {
    BsdfSample s;
    s.wi = mirrored(wo);
    s.f = reflectance / abs_cos_theta(s.wi);
    s.pdf = probability;
    s.delta = true;
    return s;
}

/// Refracted part at the hero's index; nothing at total reflection.
std::optional<BsdfSample> refraction(DielectricBsdf const& b, float hero_transmittance, Vec3 wo,
                                     float probability, Mode mode) {
    BsdfSample s;
    s.eta = b.eta[0];
    if (!refract(wo, s.eta, s.wi)) return std::nullopt;
    s.f = Spectrum(hero_transmittance / abs_cos_theta(s.wi) * refraction_scale(mode, s.eta));
    s.pdf = probability;
    s.delta = true;
    s.transmitted = true;
    s.keep_hero = b.dispersive;
    return s;
}

/// All orders of reflection between the two sides of a thin slab: R' = R + T^2 R / (1 - R^2), PBRT 4th ed., eq. 9.10.
float thin_reflectance(float r) { return r < 1.0f ? r + sqr(1.0f - r) * r / (1.0f - r * r) : 1.0f; }

Spectrum thin_reflectance(ThinDielectricBsdf const& b, Vec3 wo) {
    Spectrum r = fresnel_dielectric(abs_cos_theta(wo), b.eta);
    for (int i = 0; i < 4; ++i) r.set(i, thin_reflectance(r[i]));
    return r;
}

BsdfSample straight_through(Spectrum transmittance, Vec3 wo, float probability) {
    BsdfSample s;
    s.wi = -wo;
    s.f = transmittance / abs_cos_theta(s.wi);
    s.pdf = probability;
    s.delta = true;
    s.transmitted = true;
    return s;
}

}  // namespace

// --- dielectric ---------------------------------------------------------------------------------------------------------
std::optional<BsdfSample> sample(DielectricBsdf const& b, Vec3 wo, float uc, Vec2, Mode mode,
                                 HemisphereSampling) {
    if (wo.z == 0.0f) return std::nullopt;
    // Choose by the hero's Fresnel reflectance.
    Spectrum const r = fresnel_dielectric(wo.z, b.eta);
    float const hero = r[0];
    if (uc < hero) return reflection(r, wo, hero);
    return refraction(b, 1.0f - hero, wo, 1.0f - hero, mode);
}
Spectrum albedo(DielectricBsdf const&, Vec3) { return Spectrum(1.0f); }

// --- thin dielectric ------------------------------------------------------------------------------------------------------
std::optional<BsdfSample> sample(ThinDielectricBsdf const& b, Vec3 wo, float uc, Vec2, Mode,
                                 HemisphereSampling) {
    if (wo.z == 0.0f) return std::nullopt;
    Spectrum const r = thin_reflectance(b, wo);
    float const hero = r[0];
    if (uc < hero) return reflection(r, wo, hero);
    return straight_through(Spectrum(1.0f) - r, wo, 1.0f - hero);
}
Spectrum albedo(ThinDielectricBsdf const&, Vec3) { return Spectrum(1.0f); }

// --- conductor ------------------------------------------------------------------------------------------------------------
std::optional<BsdfSample> sample(ConductorBsdf const& b, Vec3 wo, float, Vec2, Mode, HemisphereSampling) {
    if (wo.z == 0.0f) return std::nullopt;
    return reflection(fresnel_conductor(abs_cos_theta(wo), b.eta, b.k), wo, 1.0f);
}
Spectrum albedo(ConductorBsdf const& b, Vec3 wo) { return fresnel_conductor(abs_cos_theta(wo), b.eta, b.k); }

// --- Whitted's branches -----------------------------------------------------------------------------------------------------
DeltaBranches delta_branches(DielectricBsdf const& b, Vec3 wo, Mode mode) {
    if (wo.z == 0.0f) return {};
    Spectrum const r = fresnel_dielectric(wo.z, b.eta);
    return {reflection(r, wo, 1.0f), refraction(b, 1.0f - r[0], wo, 1.0f, mode)};
}
DeltaBranches delta_branches(ThinDielectricBsdf const& b, Vec3 wo, Mode) {
    if (wo.z == 0.0f) return {};
    Spectrum const r = thin_reflectance(b, wo);
    return {reflection(r, wo, 1.0f), straight_through(Spectrum(1.0f) - r, wo, 1.0f)};
}
DeltaBranches delta_branches(ConductorBsdf const& b, Vec3 wo, Mode) {
    if (wo.z == 0.0f) return {};
    return {reflection(albedo(b, wo), wo, 1.0f), std::nullopt};
}

// --- from materials ----------------------------------------------------------------------------------------------------------
void make(DielectricMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    RuntimeSpectrum const& eta = p.data().eta;
    Spectrum const lanes = p.index(eta);
    Microfacets const facets = p.facets(m.roughness);
    // Nothing bends where the indices are the same: microfacets would not be seen (pbrt-v4).
    if (facets.smooth() || (lanes[0] == 1.0f && !p.disperses(eta)))
        bsdf.emplace<DielectricBsdf>(DielectricBsdf{lanes, p.disperses(eta)});
    else
        bsdf.emplace<RoughDielectricBsdf>(RoughDielectricBsdf{lanes[0], p.disperses(eta), facets});
}

void make(ThinDielectricMaterial const&, MaterialPoint const& p, Bsdf& bsdf) {
    bsdf.emplace<ThinDielectricBsdf>(ThinDielectricBsdf{p.index(p.data().eta)});
}

ComplexIndex complex_index(ConductorMaterial const& m, MaterialPoint const& p) {
    // Beyond, Fresnel's formula leaves the floats; it is a mirror long before.
    constexpr float kMostIndex = 1e4f;
    auto const within = [&](TextureId id) { return clamp(p.spectrum(id, {}), 0.0f, kMostIndex); };
    if (!m.reflectance.valid()) return {within(m.eta), within(m.k)};
    // The k that gives reflectance r at normal incidence with eta = 1: k = 2 sqrt(r / (1 - r)) (pbrt-v4).
    Spectrum const r = clamp(p.spectrum(m.reflectance, {}), 0.0f, 0.9999f);
    return {Spectrum(1.0f), 2.0f * sqrt(r / (Spectrum(1.0f) - r))};
}

void make(ConductorMaterial const& m, MaterialPoint const& p, Bsdf& bsdf) {
    auto const [eta, k] = complex_index(m, p);
    Microfacets const facets = p.facets(m.roughness);
    if (facets.smooth())
        bsdf.emplace<ConductorBsdf>(ConductorBsdf{eta, k});
    else
        bsdf.emplace<RoughConductorBsdf>(RoughConductorBsdf{eta, k, facets});
}

}  // namespace nephroid
