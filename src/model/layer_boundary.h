// The dielectric boundary of a layered surface, as a walk between the layers meets it: one direction in, one out. Unlike the
// scattering models, a walk asks for one of the two ways alone (PBRT 4th ed., 14.3: "ReflTransFlags"), and for what remains of the
// light rather than for f: weight = f |cos| / pdf.
// Light that enters a layered surface leaves it again, and the two factors of n^2 cancel: nothing here has one (Mode::Importance).
#pragma once

#include "model/fresnel.h"
#include "model/microfacet.h"

#include <optional>

namespace nephroid {

struct BoundaryStep {
    Vec3 w;
    float weight = 0;  // f |cos| / pdf
    float pdf = 0;     // by solid angle, where the boundary is rough
    bool transmitted = false;
};

class LayerBoundary {
  public:
    LayerBoundary(float eta, Microfacets const& facets)
        : eta_(eta), smooth_(facets.smooth()), facets_(facets) {}
    [[nodiscard]] bool smooth() const { return smooth_; }
    [[nodiscard]] float eta() const { return eta_; }

    // --- steps: nothing where the direction would end up on the wrong side ------------------------------------------------
    [[nodiscard]] std::optional<BoundaryStep> reflect(Vec3 w, Vec2 u) const {
        Vec3 const wm = normal(w, u);
        return reflected(w, wm, fresnel_dielectric(dot(w, wm), eta_), 1.0f);
    }
    [[nodiscard]] std::optional<BoundaryStep> transmit(Vec3 w, Vec2 u) const {
        Vec3 const wm = normal(w, u);
        return refracted(w, wm, 1.0f - fresnel_dielectric(dot(w, wm), eta_), 1.0f);
    }
    /// Chooses by the Fresnel reflectance at the drawn microfacet.
    [[nodiscard]] std::optional<BoundaryStep> either(Vec3 w, float uc, Vec2 u) const {
        Vec3 const wm = normal(w, u);
        float const r = fresnel_dielectric(dot(w, wm), eta_);
        return uc < r ? reflected(w, wm, 1.0f, r) : refracted(w, wm, 1.0f, 1.0f - r);
    }

    // --- values; 0 where the boundary is smooth ---------------------------------------------------------------------------
    /// wo and wi outside.
    [[nodiscard]] float f_reflect(Vec3 wo, Vec3 wi) const {
        if (smooth_ || wo.z == 0.0f || wi.z == 0.0f) return 0.0f;
        Reflection const r = reflection(wo, wi);
        return fresnel_dielectric(r.cosine, eta_) * 0.25f * microfacet_d(facets_, r.wm) *
               microfacet_g_over_cosines(facets_, wo, wi);
    }
    /// wo and wi on different sides. f(in -> out) = f(out -> in) / eta^2.
    [[nodiscard]] float f_transmit(Vec3 wo, Vec3 wi) const {
        Refraction const t = refraction(wo, wi);
        if (!t.possible) return 0.0f;
        return (1.0f - fresnel_dielectric(dot(wo, t.wm), eta_)) * microfacet_d(facets_, t.wm) *
               microfacet_g(facets_, wo, wi) * t.jacobian * std::abs(dot(wo, t.wm) / (wo.z * wi.z));
    }
    /// Fresnel's reflectance at the microfacet that reflects wo into wi, both outside.
    [[nodiscard]] float reflectance(Vec3 wo, Vec3 wi) const {
        return fresnel_dielectric(smooth_ ? wo.z : reflection(wo, wi).cosine, eta_);
    }
    /// The density with which `reflect` reflects wo into wi.
    [[nodiscard]] float pdf_reflect(Vec3 wo, Vec3 wi) const {
        if (smooth_) return 0.0f;
        Reflection const r = reflection(wo, wi);
        return r.cosine > 0.0f ? microfacet_pdf(facets_, wo, r.wm) / (4.0f * r.cosine) : 0.0f;
    }
    /// The density with which `transmit` refracts wo into wi.
    [[nodiscard]] float pdf_transmit(Vec3 wo, Vec3 wi) const {
        Refraction const t = refraction(wo, wi);
        return t.possible ? microfacet_pdf(facets_, wo, t.wm) * t.jacobian : 0.0f;
    }

  private:
    /// What joins two directions by refraction.
    struct Refraction {
        Vec3 wm;
        float jacobian = 0;  // dwm / dwi (PBRT 4th ed., eq. 9.36)
        bool possible = false;
    };

    /// What joins two directions by reflection: the same for both, to the last bit.
    struct Reflection {
        Vec3 wm;
        float cosine = 0;
    };
    static Reflection reflection(Vec3 wo, Vec3 wi) {
        Vec3 const sum = wo + wi;
        float const l = length(sum);
        return {l > 0.0f ? sum / l : Vec3{0, 0, 1}, 0.5f * l};
    }
    static Vec3 half(Vec3 sum) {
        Vec3 const wm = normalize(sum);
        return wm.z < 0.0f ? -wm : wm;
    }
    [[nodiscard]] Vec3 normal(Vec3 w, Vec2 u) const {
        return smooth_ ? Vec3{0, 0, 1} : sample_microfacet(facets_, w, u);
    }
    /// n_transmitted / n_incident for light from w.
    [[nodiscard]] float relative(Vec3 w) const { return w.z > 0.0f ? eta_ : 1.0f / eta_; }

    [[nodiscard]] Refraction refraction(Vec3 wo, Vec3 wi) const {
        if (smooth_ || !(wo.z * wi.z < 0.0f)) return {};
        float const eta = relative(wo);
        Vec3 const sum = wi * eta + wo;  // eq. 9.34
        if (!(length_squared(sum) > 0.0f)) return {};
        Vec3 const wm = half(sum);
        // Microfacets that are seen from behind take no part.
        if (dot(wm, wi) * wi.z <= 0.0f || dot(wm, wo) * wo.z <= 0.0f) return {};
        return {wm, std::abs(dot(wi, wm)) / sqr(dot(wi, wm) + dot(wo, wm) / eta), true};
    }
    /// f |cos| / pdf without Fresnel's factor: what shadowing leaves. Visible normals have the density G1 D |w.wm| / |w.z|.
    [[nodiscard]] float unshadowed(Vec3 w, Vec3 wm, Vec3 wi, float density) const {
        return microfacet_d(facets_, wm) * microfacet_g(facets_, w, wi) * std::abs(dot(w, wm) / w.z) /
               density;
    }
    [[nodiscard]] std::optional<BoundaryStep> reflected(Vec3 w, Vec3 wm, float weight,
                                                        float probability) const {
        if (smooth_) return BoundaryStep{{-w.x, -w.y, w.z}, weight, probability, false};
        Vec3 const wi = wm * (2.0f * dot(w, wm)) - w;
        if (!same_hemisphere(w, wi)) return std::nullopt;
        float const density = microfacet_pdf(facets_, w, wm);
        if (!(density > 0.0f)) return std::nullopt;
        return BoundaryStep{wi, weight * unshadowed(w, wm, wi, density),
                            probability * density / (4.0f * std::abs(dot(w, wm))), false};
    }
    [[nodiscard]] std::optional<BoundaryStep> refracted(Vec3 w, Vec3 wm, float weight,
                                                        float probability) const {
        float const eta = relative(w);
        float const c = dot(w, wm);
        if (!(c * w.z > 0.0f)) return std::nullopt;
        float const sin2_t = (1.0f - c * c) / sqr(eta);
        if (sin2_t >= 1.0f) return std::nullopt;  // total reflection
        float const cos_t = std::sqrt(1.0f - sin2_t);
        Vec3 const wi = normalize(wm * (c / eta - std::copysign(cos_t, c)) - w / eta);
        if (!(w.z * wi.z < 0.0f)) return std::nullopt;
        if (smooth_) return BoundaryStep{wi, weight, probability, true};
        float const density = microfacet_pdf(facets_, w, wm);
        if (!(density > 0.0f)) return std::nullopt;
        float const jacobian = std::abs(dot(wi, wm)) / sqr(dot(wi, wm) + c / eta);
        return BoundaryStep{wi, weight * unshadowed(w, wm, wi, density), probability * density * jacobian,
                            true};
    }

    float eta_;
    bool smooth_;
    Microfacets facets_;
};

}  // namespace nephroid
