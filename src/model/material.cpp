#include "model/material.h"

#include "make_bsdf.h"

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

float spreading_share(Assets const& assets, MaterialId id, TexturePoint const& at,
                      Wavelengths const& lambda) {
    if (auto const* m = std::get_if<MixMaterial>(&assets.scene()[id].kind)) {
        float const amount = clamp(evaluate_float(assets, m->amount, at), 0.0f, 1.0f);
        return (1.0f - amount) * spreading_share(assets, m->a, at, lambda) +
               amount * spreading_share(assets, m->b, at, lambda);
    }
    Bsdf bsdf;
    return make_bsdf(assets, id, at, lambda, bsdf) && !traits(bsdf).near_specular ? 1.0f : 0.0f;
}

Microfacets MaterialPoint::facets(Roughness const& r) const {
    Microfacets m;
    m.kind = r.distribution;
    m.multiscatter = r.multiscatter;
    if (!r.u.valid() && !r.v.valid()) return m;
    // alpha = sqrt(roughness) spreads the visible range of roughness evenly (pbrt-v4). Beyond 1 the surface is no height field
    // that anyone has seen, and a texture may hold anything.
    auto const alpha = [&](float roughness) {
        float const x = clamp(roughness, 0.0f, 1.0f);
        return r.remap ? std::sqrt(x) : x;
    };
    float const u = number(r.u.valid() ? r.u : r.v, 0.0f);
    m.ax = alpha(u);
    m.ay = r.v.valid() && r.u.valid() ? alpha(number(r.v, 0.0f)) : m.ax;
    // Where one of the two is not smooth the other must not be a line.
    if (!m.smooth()) {
        m.ax = max(m.ax, 1e-4f);
        m.ay = max(m.ay, 1e-4f);
    }
    return m;
}

bool make_bsdf(Assets const& assets, MaterialId id, TexturePoint const& at, Wavelengths const& lambda,
               Bsdf& bsdf) {
    MaterialPoint const p{assets, id, at, lambda};
    return match(
        assets.scene()[id].kind, [](InterfaceMaterial const&) { return false; },
        [](MixMaterial const&) { return false; },
        [&](auto const& m) {
            make(m, p, bsdf);
            return true;
        });
}

}  // namespace nephroid
