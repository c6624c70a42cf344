// The lobes of energy compensation.
#include "model/energy_compensation.h"

#include "model/microfacet_albedo.h"
#include "model/schlick.h"

namespace nephroid {

namespace {

constexpr float kLeast = 1e-6f;  // of average losses: below it there is nothing to make up for

float isotropic_alpha(Microfacets const& m) { return std::sqrt(m.ax * m.ay); }

/// Has a table of its own for roughnesses that differ along x and y.
bool is_anisotropic_ggx(Microfacets const& m) {
    return m.kind == Distribution::TrowbridgeReitz && m.ax != m.ay;
}
/// Of perfect mirrors: E, what one encounter reflects of light from w.
float reflected(Microfacets const& m, Vec3 w) {
    if (!is_anisotropic_ggx(m)) return microfacet_albedo(m.kind, abs_cos_theta(w), isotropic_alpha(m));
    w.z = abs_cos_theta(w);
    if (m.ax > m.ay) return schlick_albedo(m, w).one;
    return schlick_albedo(Microfacets{m.ay, m.ax, m.kind}, {w.y, w.x, w.z}).one;
}
float reflected_average(Microfacets const& m) {
    if (!is_anisotropic_ggx(m)) return microfacet_albedo_average(m.kind, isotropic_alpha(m));
    return schlick_mean(Microfacets{max(m.ax, m.ay), min(m.ax, m.ay), m.kind}).one;
}
float lost(Microfacets const& m, Vec3 w) { return max(0.0f, 1.0f - reflected(m, w)); }
/// eta = n on the other side / n on the side of w.
float lost(Microfacets const& m, float eta, Vec3 w) {
    float const alpha = isotropic_alpha(m), mu = abs_cos_theta(w);
    return max(0.0f, 1.0f - dielectric_reflection_albedo(m.kind, mu, alpha, eta) -
                         dielectric_transmission_albedo(m.kind, mu, alpha, eta));
}

/// Average Fresnel reflectance, 2 integral F mu dmu, for 1 <= eta <= 3: Kulla & Conty 2017's fit, within 0.003.
float average_fresnel(float eta) { return (eta - 1.0f) / (4.08567f + 1.00071f * eta); }

}  // namespace

ReflectionCompensation reflection_compensation(Microfacets const& m, Vec3 wo) {
    return {lost(m, wo), max(kLeast, 1.0f - reflected_average(m))};
}

float evaluate(ReflectionCompensation const& c, Microfacets const& m, Vec3 wi) {
    return c.lost_o * lost(m, wi) * kInvPi / c.average;
}

Spectrum compensation_tint(Spectrum f, Microfacets const& m) {
    return multiscatter_fresnel(f, reflected_average(m));
}

DielectricCompensation dielectric_compensation(Microfacets const& m, float eta, Vec3 wo) {
    float const relative = wo.z > 0.0f ? eta : 1.0f / eta;  // n on the other side / n on the side of wo
    float const alpha = isotropic_alpha(m);
    DielectricCompensation c{};
    c.eta = eta;
    c.lost_o = lost(m, relative, wo);
    c.average_o = max(kLeast, 1.0f - dielectric_albedo_average(m.kind, alpha, relative));
    c.average_t = max(kLeast, 1.0f - dielectric_albedo_average(m.kind, alpha, 1.0f / relative));
    // Average transmittances of the two sides differ by the squared index, as those of every refraction do.
    float const transmittance = relative >= 1.0f ? 1.0f - average_fresnel(relative)
                                                 : (1.0f - average_fresnel(1.0f / relative)) * sqr(relative);
    c.through = transmittance * min(1.0f, c.average_t / c.average_o);
    return c;
}

float evaluate(DielectricCompensation const& c, Microfacets const& m, Vec3 wo, Vec3 wi, Mode mode) {
    float const relative = wo.z > 0.0f ? c.eta : 1.0f / c.eta;
    if (same_hemisphere(wo, wi))
        return (1.0f - c.through) * c.lost_o * lost(m, relative, wi) * kInvPi / c.average_o;
    // Symmetric but for n_i^2: through / average_t = n_t^2 / n_o^2 times the same from the other side.
    return c.through * c.lost_o * lost(m, 1.0f / relative, wi) * kInvPi / c.average_t *
           refraction_scale(mode, relative);
}

}  // namespace nephroid
