// Smooth boundaries: dielectric (PBRT 4th ed., 9.5), thin dielectric (9.5.1), conductor (9.4).
// Nothing but delta parts: a direction is either the mirrored or the refracted one.
#include "model/bsdf.h"

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
    float t = hero_transmittance / abs_cos_theta(s.wi);
    // Radiance is squeezed into (or out of) the denser medium's smaller solid angle: Veach 1997, eq. 5.2.
    if (mode == Mode::Radiance) t /= sqr(s.eta);
    s.f = Spectrum(t);
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
DeltaBranches delta_branches(Bsdf const& bsdf, Vec3 wo, Mode mode) {
    DeltaBranches out;
    if (wo.z == 0.0f) return out;
    match(
        bsdf, [](DiffuseBsdf const&) {},
        [&](DielectricBsdf const& b) {
            Spectrum const r = fresnel_dielectric(wo.z, b.eta);
            out.reflected = reflection(r, wo, 1.0f);
            out.transmitted = refraction(b, 1.0f - r[0], wo, 1.0f, mode);
        },
        [&](ThinDielectricBsdf const& b) {
            Spectrum const r = thin_reflectance(b, wo);
            out.reflected = reflection(r, wo, 1.0f);
            out.transmitted = straight_through(Spectrum(1.0f) - r, wo, 1.0f);
        },
        [&](ConductorBsdf const& b) { out.reflected = reflection(albedo(b, wo), wo, 1.0f); });
    return out;
}

}  // namespace nephroid
