#include "model/material.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {
constexpr double kBelowOne = 1.0 - 0x1p-53;
}

MaterialId resolve_mix(Assets const& assets, MaterialId id, TexturePoint const& at, double& u) {
    while (auto const* mix = std::get_if<MixMaterial>(&assets.scene()[id].kind)) {
        double const amount = static_cast<double>(clamp(evaluate_float(assets, mix->amount, at), 0.0f, 1.0f));
        if (u < amount) {
            id = mix->b;
            u = std::min(u / amount, kBelowOne);
        } else {
            id = mix->a;
            u = std::min((u - amount) / (1.0 - amount), kBelowOne);
        }
    }
    return id;
}

float interface_share(Assets const& assets, MaterialId id, TexturePoint const& at) {
    return match(
        assets.scene()[id].kind, [](InterfaceMaterial const&) { return 1.0f; },
        [&](MixMaterial const& m) {
            float const amount = clamp(evaluate_float(assets, m.amount, at), 0.0f, 1.0f);
            return (1.0f - amount) * interface_share(assets, m.a, at) +
                   amount * interface_share(assets, m.b, at);
        },
        [](auto const&) { return 0.0f; });
}

namespace {

/// Indices of refraction by lane. In rgb mode one index serves all lanes, the middle one: a glass has no colour of its own.
Spectrum index_lanes(RuntimeSpectrum const& eta, Wavelengths const& lambda) {
    if (lambda.is_rgb()) return Spectrum(eta.rgb().y);
    return eta.sample(lambda);
}

}  // namespace

bool make_bsdf(Assets const& assets, MaterialId id, TexturePoint const& at, Wavelengths const& lambda,
               Bsdf& bsdf) {
    return match(
        assets.scene()[id].kind,
        [&](DiffuseMaterial const& m) {
            bsdf.emplace<DiffuseBsdf>(
                DiffuseBsdf{clamp(evaluate_spectrum(assets, m.reflectance, at, lambda), 0.0f, 1.0f)});
            return true;
        },
        [&](DielectricMaterial const&) {
            RuntimeSpectrum const& eta = assets.data(id).eta;
            bsdf.emplace<DielectricBsdf>(
                DielectricBsdf{index_lanes(eta, lambda), !lambda.is_rgb() && !eta.is_constant()});
            return true;
        },
        [&](ThinDielectricMaterial const&) {
            bsdf.emplace<ThinDielectricBsdf>(ThinDielectricBsdf{index_lanes(assets.data(id).eta, lambda)});
            return true;
        },
        [&](ConductorMaterial const& m) {
            if (m.reflectance.valid()) {
                // The k that gives reflectance r at normal incidence with eta = 1: k = 2 sqrt(r / (1 - r)) (pbrt-v4).
                Spectrum const r = clamp(evaluate_spectrum(assets, m.reflectance, at, lambda), 0.0f, 0.9999f);
                bsdf.emplace<ConductorBsdf>(
                    ConductorBsdf{Spectrum(1.0f), 2.0f * sqrt(r / (Spectrum(1.0f) - r))});
            } else {
                bsdf.emplace<ConductorBsdf>(ConductorBsdf{evaluate_spectrum(assets, m.eta, at, lambda),
                                                          evaluate_spectrum(assets, m.k, at, lambda)});
            }
            return true;
        },
        [](InterfaceMaterial const&) { return false; }, [](MixMaterial const&) { return false; });
}

}  // namespace nephroid
