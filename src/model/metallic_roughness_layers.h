// The parts of glTF's layered surface (model/bsdf_metallic_roughness.h) as one direction wo sees them: what a
// facet reflects and lets through, what coat and sheen leave, and the albedos of the base.
//
// Everything is in the facets' frame with wo above: directions are turned, and mirrored at the surface where
// wo is below.
#pragma once

#include "model/bsdf_metallic_roughness.h"
#include "model/schlick.h"
#include "model/sheen.h"

#include <cmath>

namespace nephroid::gltf {

inline constexpr float kCoatF0 = 0.04f;

inline Vec3 mirrored(Vec3 w) { return {-w.x, -w.y, w.z}; }
inline Vec3 flipped(Vec3 w) { return {w.x, w.y, -w.z}; }
inline Spectrum at_least(Spectrum s, float floor) {
    for (int i = 0; i < 4; ++i) s.set(i, max(s[i], floor));
    return s;
}

/// The model as wo sees it.
struct View {
    MetallicRoughnessBsdf const& b;
    Vec3 wo;        // in the facets' frame, above
    bool below;     // it was below
    bool inside;    // ... and that is inside a solid
    float eta = 1;  // n_transmitted / n_incident

    View(MetallicRoughnessBsdf const& model, Vec3 w)
        : b(model), wo(turned(w)), below(w.z < 0.0f), inside(below && model.solid) {
        if (below) wo = flipped(wo);
        if (b.solid) eta = inside ? 1.0f / b.eta : b.eta;
    }
    [[nodiscard]] Vec3 turned(Vec3 w) const {
        return {b.axis_x * w.x + b.axis_y * w.y, b.axis_x * w.y - b.axis_y * w.x, w.z};
    }
    [[nodiscard]] Vec3 to_local(Vec3 w) const {
        Vec3 const v = turned(w);
        return below ? flipped(v) : v;
    }
    [[nodiscard]] Vec3 from_local(Vec3 w) const {
        return {b.axis_x * w.x - b.axis_y * w.y, b.axis_x * w.y + b.axis_y * w.x, below ? -w.z : w.z};
    }
    /// Is w on the side that coat and sheen are on? Thin walls have them on both.
    [[nodiscard]] bool outside(Vec3 w) const { return !b.solid || (w.z > 0.0f) == !inside; }
};

// --- Fresnel -----------------------------------------------------------------------------------------------
/// What one facet does with white light.
struct Split {
    Spectrum reflected, transmitted;
};
/// c = wo.wm > 0.
inline Split split(View const& v, float c) {
    MetallicRoughnessBsdf const& b = v.b;
    float const metal_edge = schlick_weight(c);
    Spectrum const metal = schlick(b.base_color, Spectrum(1.0f), metal_edge);
    float edge = metal_edge;
    bool total = false;
    if (v.inside) {
        float const sin2_out = (1.0f - sqr(c)) * sqr(b.eta);
        total = sin2_out >= 1.0f;
        edge = schlick_weight(safe_sqrt(1.0f - sin2_out));
    }
    Spectrum const f90(b.f90);
    Spectrum const glass = total ? Spectrum(1.0f) : schlick(b.f0, f90, edge);
    // From inside, what does not transmit has no boundary.
    float const share = v.inside ? b.transmitting() : 1.0f - b.metallic;
    Split s{glass * share + metal * b.metallic, {}};
    if (b.transmission > 0.0f && !total) {
        Spectrum const top = at_least(b.f0, b.f0_top);
        s.transmitted = (Spectrum(1.0f) - schlick(top, f90, edge)) * b.base_color * b.transmitting();
    }
    return s;
}
/// How likely a facet's light is taken as reflected.
inline float reflect_probability(Split const& s) {
    float const r = s.reflected.max();
    float const t = s.transmitted.max();
    return r + t > 0.0f ? r / (r + t) : 1.0f;
}

// --- layers ------------------------------------------------------------------------------------------------
inline float coat_albedo(MetallicRoughnessBsdf const& b, float mu) {
    return b.clearcoat > 0.0f ? b.clearcoat * schlick_albedo(mu, b.clearcoat_alpha).of(kCoatF0, 1.0f) : 0.0f;
}
/// What the sheen leaves to the base.
inline Spectrum past_sheen(MetallicRoughnessBsdf const& b, float mu) {
    if (!b.has_sheen()) return Spectrum(1.0f);
    return Spectrum(1.0f) - at_least(b.sheen_color, b.sheen_top) * sheen_albedo(b.sheen_alpha, mu);
}
/// What the layers leave of light between wo and wi: first of the coat, then of both.
struct Passed {
    float coat = 1;
    Spectrum both{1.0f};
};
inline Passed passed(View const& v, Vec3 wi) {
    Passed p;
    Vec3 const w[2] = {v.wo, wi};
    Spectrum sheen(1.0f);
    for (Vec3 const x : w) {
        if (!v.outside(x)) continue;
        p.coat = min(p.coat, 1.0f - coat_albedo(v.b, abs_cos_theta(x)));
        Spectrum const s = past_sheen(v.b, abs_cos_theta(x));
        for (int i = 0; i < 4; ++i) sheen.set(i, min(sheen[i], s[i]));
    }
    p.both = sheen * p.coat;
    return p;
}

// --- multiple reflection and refraction in a solid's boundary ----------------------------------------------
/// Kulla & Conty's idea for both sides of a boundary: what one encounter loses of light from w, L(w), comes
/// out in shares like L(w') cos, `through` of it on the other side. Reciprocity holds where through_out mean
/// L_out = through_in mean L_in index^2; of all such pairs this is the one whose sum is 1.
struct SolidLoss {
    SolidBoundary boundary;
    float mean[2];     // outside, inside
    float through[2];  // from outside, from inside

    static bool wanted(MetallicRoughnessBsdf const& b) {
        return b.solid && b.facets.multiscatter && b.transmitting() > 0.0f && !b.facets.smooth() &&
               !b.unbent() && b.facets.ax == b.facets.ay && SolidBoundary{0, b.eta, 0, 0}.known();
    }
    explicit SolidLoss(MetallicRoughnessBsdf const& b) : boundary{b.facets.ax, b.eta, b.f0_top, b.f90} {
        mean[0] = max(boundary.lost_mean(false), 1e-6f);
        mean[1] = max(boundary.lost_mean(true), 1e-6f);
        float const k = mean[0] / (mean[1] * sqr(b.eta));
        through[0] = 1.0f / (1.0f + k);
        through[1] = k / (1.0f + k);
    }
    /// pi f of white light from wo; the squeezing of radiance is not in it.
    [[nodiscard]] float value(View const& v, Vec3 wi) const {
        bool const passes = wi.z < 0.0f;
        bool const end = passes ? !v.inside : v.inside;
        float const share = passes ? through[v.inside] : 1.0f - through[v.inside];
        return share * boundary.lost(v.wo.z, v.inside) * boundary.lost(abs_cos_theta(wi), end) / mean[end];
    }
};

// --- the base ----------------------------------------------------------------------------------------------
/// Albedos of the facets from one direction; what one reflection loses is 1 - single.one.
struct BaseAlbedo {
    SchlickAlbedo single;
    Spectrum specular;  // of the dielectric's specular part, by its largest components
};
struct Base {
    MetallicRoughnessBsdf const& b;
    SchlickAlbedo mean;
    Spectrum top;       // the dielectric's f0, largest components
    Spectrum glass_ms;  // multiple reflection: of the dielectric,
    Spectrum ms;        // ... and of all
    Spectrum specular_mean;

    explicit Base(MetallicRoughnessBsdf const& model)
        : b(model), mean(schlick_mean(b.facets)), top(at_least(b.f0, b.f0_top)) {
        if (makes_up()) {
            auto const lost_and_found = [&](Spectrum f0, float f90) {
                return multiscatter_fresnel(schlick(f0, Spectrum(f90), 1.0f / 21.0f), mean.one);
            };
            glass_ms = lost_and_found(top, b.f90);
            float const reflecting = SolidLoss::wanted(b) ? b.diffusing() : 1.0f - b.metallic;
            ms = lost_and_found(b.f0, b.f90) * reflecting + lost_and_found(b.base_color, 1.0f) * b.metallic;
        }
        specular_mean = mean.of(top, Spectrum(b.f90)) + glass_ms * (1.0f - mean.one);
    }
    [[nodiscard]] bool makes_up() const { return b.facets.multiscatter && mean.one < 1.0f; }
    [[nodiscard]] BaseAlbedo albedo(Vec3 w) const {
        SchlickAlbedo const a = schlick_albedo(b.facets, w);
        return {a, a.of(top, Spectrum(b.f90)) + glass_ms * (1.0f - a.one)};
    }
    /// (1 - R(wo)) (1 - R(wi)) / (1 - mean R), whose mean over wi is 1 - R(wo).
    [[nodiscard]] Spectrum under_specular(BaseAlbedo const& o, BaseAlbedo const& i) const {
        Spectrum const one(1.0f);
        return (one - o.specular) * (one - i.specular) / at_least(one - specular_mean, 1e-6f);
    }
    [[nodiscard]] float lost(BaseAlbedo const& o, BaseAlbedo const& i) const {
        return (1.0f - o.single.one) * (1.0f - i.single.one) / (1.0f - mean.one);
    }
};

// --- facets ------------------------------------------------------------------------------------------------
/// GGX without F: D G / (4 cos cos), wo and wi above.
inline float facet_brdf(Microfacets const& m, Vec3 wo, Vec3 wi, Vec3 wm) {
    return 0.25f * microfacet_d(m, wm) * microfacet_g_over_cosines(m, wo, wi);
}
inline Microfacets coat_facets(MetallicRoughnessBsdf const& b) {
    return {b.clearcoat_alpha, b.clearcoat_alpha};
}

/// Half the way between wo and wi, above; wi is refracted by eta, or, above, reflected. 0 where there is no
/// such facet.
struct Facet {
    Vec3 wm{0, 0, 0};
    float across_o = 0, across_i = 0;  // wo.wm > 0, wi.wm
};
inline Facet refracting_facet(View const& v, Vec3 wi) {
    // In one order, whichever is wo, so that both ways round to the same facet.
    Vec3 wm = v.inside ? wi + v.wo * v.b.eta : v.wo + wi * v.b.eta;
    float const len2 = length_squared(wm);
    if (!(len2 > 0.0f)) return {};
    wm = wm / std::sqrt(len2);
    if (wm.z < 0.0f) wm = -wm;
    Facet const f{wm, dot(v.wo, wm), dot(wi, wm)};
    return f.across_o > 0.0f && f.across_i < 0.0f ? f : Facet{};
}
/// dwm / dwi of refraction (PBRT 4th ed., eq. 9.36).
inline float refraction_jacobian(Facet const& f, float eta) {
    return std::abs(f.across_i) / sqr(f.across_i + f.across_o / eta);
}

/// f towards wi, both in the facets' frame (bsdf_metallic_roughness.cpp).
Spectrum value(View const& v, Vec3 wi, Mode mode);

}  // namespace nephroid::gltf
