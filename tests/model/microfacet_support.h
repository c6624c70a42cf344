// What the tests of microfacets share: the surfaces they look at, and their albedos by a lattice.
#pragma once

#include "bsdf_checks.h"

namespace nephroid::test {

struct NamedDistribution {
    std::string name;
    Distribution kind;
};
inline NamedDistribution const kDistributions[] = {{"trowbridge-reitz", Distribution::TrowbridgeReitz},
                                                   {"beckmann", Distribution::Beckmann},
                                                   {"blinn", Distribution::Blinn}};
/// From nearly smooth to 1, and two anisotropic ones.
inline Vec2 const kRoughness[] = {{0.001f, 0.001f}, {0.01f, 0.01f}, {0.05f, 0.05f},
                                  {0.1f, 0.1f},     {0.3f, 0.3f},   {0.5f, 0.5f},
                                  {1, 1},           {0.02f, 0.4f},  {0.4f, 0.05f}};

/// Facets that are perfect mirrors, F = 1: a conductor of vanishing index.
inline RoughConductorBsdf mirrors(Microfacets const& m) { return {Spectrum(0), Spectrum(0), m}; }

struct Parts {
    double reflected = 0, transmitted = 0;
};
/// Reflected and transmitted power of single encounters by a lattice of the samplers' own numbers; eta = 0: mirrors().
inline Parts albedo_by_lattice(Microfacets const& m, Vec3 wo, float eta, int n = 987, int step = 610) {
    Bsdf const metal = mirrors(m), glass = RoughDielectricBsdf{eta, false, m};
    Parts p;
    for (int i = 0; i < n; ++i) {
        Vec2 const u{(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                     (static_cast<float>(i * step % n) + 0.5f) / static_cast<float>(n)};
        auto const get = [&](Bsdf const& b, float uc, bool through, double& sum) {
            auto const s = sample(b, wo, uc, u, Mode::Importance, HemisphereSampling::Cosine);
            if (!s || s->transmitted != through) return;
            // Both choices are looked at, each weighs its probability.
            double f = 1;
            if (eta != 0) {
                float const relative = wo.z > 0 ? eta : 1 / eta;
                Vec3 const wm = normalize(through ? relative * s->wi + wo : s->wi + wo);
                f = static_cast<double>(fresnel_dielectric(std::abs(dot(wo, wm)), relative));
            }
            sum += throughput(*s) * (through ? 1 - f : f) / n;
        };
        if (eta == 0) {
            get(metal, 0.5f, false, p.reflected);
        } else {
            get(glass, 0, false, p.reflected);
            get(glass, kOneMinusEpsilon, true, p.transmitted);
        }
    }
    return p;
}

}  // namespace nephroid::test
