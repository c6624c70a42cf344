// The table behind closed forms of coats, as tools/coat_table.cpp writes it and coat_table.cpp reads it: for boundaries of Trowbridge-
// Reitz microfacets of isotropic alpha.
#pragma once

#include "model/fresnel.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid {

struct CoatTable {
    static constexpr std::size_t kEtas = 7, kAlphas = 13, kMus = 16, kDepths = 5;

    // Nodes: cosines and alphas more densely near 0; eta by the amplitude it reflects, (eta - 1) / (eta + 1); depths by factors of 4.
    static constexpr float kEtaLo = 1.1f, kEtaHi = 2.5f, kDepthLo = 0.01f;
    static float mu(std::size_t i) { return max(sqr(static_cast<float>(i) / (kMus - 1)), 1e-3f); }
    static float alpha(std::size_t i) { return sqr(static_cast<float>(i) / (kAlphas - 1)); }
    static float amplitude(float eta) { return (eta - 1.0f) / (eta + 1.0f); }
    static float eta(std::size_t i) {
        float const r = lerp(static_cast<float>(i) / (kEtas - 1), amplitude(kEtaLo), amplitude(kEtaHi));
        return (1.0f + r) / (1.0f - r);
    }
    static float depth(std::size_t i) { return kDepthLo * std::exp2(2.0f * static_cast<float>(i)); }
    // … and where a value lies among them, from 0 to n - 1.
    static float mu_place(float x) { return std::sqrt(x) * (kMus - 1); }
    static float alpha_place(float x) { return std::sqrt(x) * (kAlphas - 1); }
    static float eta_place(float x) {
        return (amplitude(x) - amplitude(kEtaLo)) / (amplitude(kEtaHi) - amplitude(kEtaLo)) * (kEtas - 1);
    }
    static float depth_place(float x) { return 0.5f * std::log2(x / kDepthLo); }

    /// Mean ways through a layer of optical depth d, as -ln(transmittance) / d: of light that enters from mu; of diffuse light
    /// from the base that is reflected back to it; and of what gets out.
    float down[kEtas][kAlphas][kMus][kDepths];
    float back[kEtas][kAlphas][kDepths];
    float out[kEtas][kAlphas][kDepths];

    /// A rough coat (first alpha) over a perfect mirror of microfacets (second alpha), for light from mu that met the base once
    /// ([0]) and twice ([1]).
    struct Lobes {
        float g
            [2];  // scales the lobe (bsdf_coated_closed.cpp) to the right albedo, together with that of the other direction
        float albedo[2];
        float way[2];     // mean way through the coat, as above, at the least depth
        float slant[2];   // mean (1 - cos)^5 at the base's microfacets, Schlick's weight …
        float excess[2];  // … and how much more that is than in the lobe
        float tail;       // what part of the light is left from one meeting to the next, from the second on
        float unused;
    };
    Lobes lobes[kEtas][kAlphas][kAlphas][kMus];
};

/// A direction outside (above) as it is inside a coat.
inline Vec3 inside_coat(Vec3 w, float eta) {
    Vec3 const in{w.x / eta, w.y / eta, 0};
    return {in.x, in.y, safe_sqrt(1.0f - in.x * in.x - in.y * in.y)};
}
/// The roughness of the lobe that stands for light that met the base n times. Refraction turns a ray by 1 - 1/eta times the tilt of
/// a microfacet, as seen from inside, and reflection by twice the tilt. Belcour 2018 adds variances, that is squares; slopes of
/// Trowbridge-Reitz have none, their tails being too long, and the power 3/2 was fitted to walks (decision 7).
inline float coat_lobe_alpha(float coat, float base, float eta, int n) {
    auto const meetings = static_cast<float>(n);
    auto const p = [](float x) { return x * std::sqrt(x); };
    float const refracted = 2.0f * p(0.5f * std::abs(1.0f - 1.0f / eta) * coat);
    float const sum = meetings * p(base) + (meetings - 1.0f) * p(coat) + refracted;
    return clamp(std::cbrt(sum * sum), 1e-3f, 1.0f);
}
/// Roughly what a coat lets through from mu: a factor of the lobes, which g1 and g2 make right.
inline float coat_lobe_passing(float mu, float coat, float eta) {
    return 1.0f - fresnel_dielectric((mu + coat) / (1.0f + coat), eta);
}

}  // namespace nephroid
